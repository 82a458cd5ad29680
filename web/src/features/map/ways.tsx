// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { now_ms } from '../../api/server';
import type { Edge, Graph, LoggedEdit, Place, WayDrives } from '../../api/types';
import { Section } from '../../components/section';
import { SureButton } from '../../components/sure_button';
import { indexOf } from '../../lib/graph_index';
import { useLoaded } from '../../lib/loaded';
import { placeTitle } from '../../lib/whereabouts';
import { kPlacePart, type Editor } from './editor';
import { waysOut, type WayOut } from './place_views';
import { drivesOf, drivesWords, isSlow } from './way_drives';
import { directionsOf, directionWords, type Direction } from './way_words';

const kSaid: Readonly<Record<WayOut['closed'], { words: string; tone: string } | null>> = {
  no: null,
  one_way: { words: 'Closed in one direction', tone: 'warn' },
  both: { words: 'Closed', tone: 'bad' },
};

interface Props {
  editor: Editor;
  place: Place;
  onChoose: (place: string) => void;
}

/** The ways out of a place: where they lead, and to close or open them, one direction or both. */
export function Ways({ editor, place, onChoose }: Props) {
  const { graph, draft } = editor;
  const ways = waysOut(graph, place.id);
  // The map's own: nothing of a draft was driven yet.
  const drives = useLoaded(() => calls.wayDrives(graph.map), graph.revision);
  const drawn = ways.some(({ other }) => directionsOf(graph, place.id, other).some(byPerson));
  const history = useLoaded(
    () => (drawn ? calls.history(graph.map) : noHistory()),
    drawn ? graph.revision : 0,
  );
  const driven: Driven | null =
    drives.value && history.value
      ? { ways: drives.value.ways, edits: [...history.value.edits, ...(draft?.edits ?? [])] }
      : null;
  return (
    <div class="stack tight">
      <h3>Ways from here</h3>
      {drives.problem && (
        <p class="soft small">How these were driven could not be loaded. {drives.problem.message}</p>
      )}
      {ways.length === 0 && <p class="soft">None: the chair cannot drive to or from this place.</p>}
      <ul class="list">
        {ways.map((way) => (
          <Way key={way.other} editor={editor} place={place} way={way} driven={driven} onChoose={onChoose} />
        ))}
      </ul>
    </div>
  );
}

function Way({ editor, place, way, driven, onChoose }: Props & { way: WayOut; driven: Driven | null }) {
  const { graph, busy, mayEdit } = editor;
  const title = placeTitle(graph, way.other);
  const said = kSaid[way.closed];
  const directions = directionsOf(graph, place.id, way.other);
  const setBlocked = (blocked: boolean) => {
    const edits = directions.flatMap(({ from, to, edge }) =>
      edge && edge.blocked !== blocked ? [{ kind: 'block_edge' as const, from, to, blocked }] : [],
    );
    editor.edit(kPlacePart, edits, blocked ? 'This way is closed now.' : 'This way is open again.');
  };
  return (
    <li>
      <button type="button" class="place-row compact" onClick={() => onChoose(way.other)}>
        <img
          src={calls.imageThumbnailUrl(graph.map, indexOf(graph).places.get(way.other)?.prototype ?? '')}
          alt=""
          loading="lazy"
        />
        <span>{title}</span>
      </button>
      <span class="row">
        {way.weak && <span class="pill warn">Hard to drive</span>}
        {way.shortcut && <span class="pill">Shortcut</span>}
        {said && <span class={`pill ${said.tone}`}>{said.words}</span>}
        {mayEdit &&
          (['Close', 'Open'] as const)
            .filter((verb) => (verb === 'Close' ? way.closed !== 'both' : way.closed !== 'no'))
            .map((verb) => (
              <button
                key={verb}
                type="button"
                class="button small"
                disabled={busy}
                aria-label={`${verb} the way to ${title}`}
                onClick={() => setBlocked(verb === 'Close')}
              >
                {verb}
              </button>
            ))}
      </span>
      <div class="whole-row">
        <Section title="Both directions" about={`of the way to ${title}`} heading={false}>
          <ul class="stack tight">
            {directions.map((one) => (
              <OneDirection
                key={one.from}
                editor={editor}
                direction={one}
                driven={driven}
                words={one.from === place.id ? 'From here' : 'Back to here'}
                other={title}
              />
            ))}
          </ul>
          {mayEdit && (
            <p>
              <SureButton
                label="Remove the way"
                about={`to ${title}`}
                question="Remove this way, in both directions?"
                disabled={busy}
                onSure={() =>
                  editor.edit(
                    kPlacePart,
                    [{ kind: 'remove_edge', from: place.id, to: way.other }],
                    `The way to ${title} was removed.`,
                  )
                }
              />
            </p>
          )}
        </Section>
      </div>
    </li>
  );
}

/** What was driven so far, and what people changed since. */
interface Driven {
  ways: readonly WayDrives[];
  edits: readonly LoggedEdit[];
}

const byPerson = ({ edge }: Direction) => edge?.by === 'person';
const noHistory = () => Promise.resolve<{ edits: LoggedEdit[] }>({ edits: [] });

function Drives({ graph, edge, driven }: { graph: Graph; edge: Edge; driven: Driven }) {
  const drives = drivesOf(driven.ways, edge.from, edge.to);
  return (
    <>
      <br />
      <span class="soft small">{drivesWords(drives, now_ms.value)}</span>
      {isSlow(edge, drives, graph, driven.edits) && (
        <>
          <br />
          <span class="small">Driven slowly until a drive has come to its end here.</span>
        </>
      )}
    </>
  );
}

interface DirectionProps {
  editor: Editor;
  direction: Direction;
  driven: Driven | null;
  words: string;
  other: string; // the title of the place at the other end
}

function OneDirection({ editor, direction, driven, words, other }: DirectionProps) {
  const { from, to, edge } = direction;
  const verb = edge?.blocked ? 'Open' : 'Close';
  const act = () =>
    editor.edit(
      kPlacePart,
      [{ kind: 'block_edge', from, to, blocked: verb === 'Close' }],
      verb === 'Close' ? 'This direction is closed now.' : 'This direction is open again.',
    );
  return (
    <li class="row apart">
      <span>
        <strong>{words}</strong>
        {edge?.blocked && (
          <>
            {' '}
            <span class="pill bad">Not to be driven</span>
          </>
        )}
        <br />
        <span class="soft small">{directionWords(edge)}</span>
        {edge && driven && <Drives graph={editor.graph} edge={edge} driven={driven} />}
      </span>
      {editor.mayEdit && edge && (
        <button
          type="button"
          class="button small"
          disabled={editor.busy}
          aria-label={`${verb} this direction, ${words.toLowerCase()}: ${other}`}
          onClick={act}
        >
          {verb} this direction
        </button>
      )}
    </li>
  );
}
