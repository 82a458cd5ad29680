// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Edit, Graph, Place } from '../../api/types';
import { TextField } from '../../components/field';
import { useDraft } from '../../lib/draft';
import { nameOf, placeTitle } from '../../lib/whereabouts';
import { count, inSentence } from '../../lib/words';
import { Outcome, type OutcomeOf } from './outcome';
import { waysOut, type WayOut } from './place_views';
import { Shortcuts } from './shortcuts';

const kShownPictures = 5;

interface Props {
  graph: Graph;
  place: Place;
  mayEdit: boolean;
  busy: boolean; // an edit is under way
  outcome: OutcomeOf | null; // of the latest edit
  onEdit: (edits: Edit[], done: string) => void;
  onChoose: (place: string) => void;
  onGo: (() => void) | null;
}

/** One place: its name, its pictures, and the ways out of it. */
export function Inspector({ graph, place, mayEdit, busy, outcome, onEdit, onChoose, onGo }: Props) {
  const title = placeTitle(graph, place.id);
  const heading = useRef<HTMLHeadingElement>(null);
  // A place that was chosen further down the page comes into view, for eyes and for screen readers.
  useEffect(() => heading.current?.focus(), [place.id]);
  return (
    <section class="card stack inspector" aria-label={`Chosen place: ${title}`}>
      <div class="row apart">
        <h2 tabIndex={-1} ref={heading}>
          {title}
        </h2>
        {onGo && (
          <button type="button" class="button main" onClick={onGo}>
            Send the chair here
          </button>
        )}
      </div>
      <Pictures graph={graph} place={place} title={title} />
      {mayEdit && <Rename key={place.id} graph={graph} place={place} busy={busy} onEdit={onEdit} />}
      {outcome && <Outcome of={outcome} />}
      <Ways graph={graph} place={place} mayEdit={mayEdit} busy={busy} onEdit={onEdit} onChoose={onChoose} />
      <Shortcuts graph={graph} place={place.id} mayEdit={mayEdit} busy={busy} onEdit={onEdit} />
    </section>
  );
}

function Pictures({ graph, place, title }: { graph: Graph; place: Place; title: string }) {
  const shown = place.members.slice(0, kShownPictures);
  return (
    <div class="stack tight">
      <ul class="pictures">
        {shown.map((image, i) => (
          <li key={image}>
            <img
              class={i === 0 ? 'picture whole' : 'picture'}
              src={calls.imageThumbnailUrl(graph.map, image)}
              alt={`${title}, picture ${i + 1}`}
              loading="lazy"
            />
          </li>
        ))}
      </ul>
      <p class="soft small">
        {count(place.members.length, 'picture')}, {count(place.features, 'thing')} to recognise
      </p>
    </div>
  );
}

type RenameProps = Pick<Props, 'graph' | 'place' | 'onEdit' | 'busy'>;

function Rename({ graph, place, busy, onEdit }: RenameProps) {
  const present = nameOf(graph, place.id) ?? '';
  const { text, type, newer } = useDraft(present);
  const wanted = inSentence(text);
  return (
    <form
      class="rename"
      onSubmit={(event) => {
        event.preventDefault();
        if (wanted !== present)
          onEdit(
            [{ kind: 'rename', place: place.id, label: wanted }],
            wanted ? `Named ${wanted}.` : 'Name removed.',
          );
      }}
    >
      <TextField label="Name" value={text} onInput={type} required={false} />
      <button type="submit" class="button" disabled={busy || wanted === present}>
        {busy ? 'Saving …' : 'Save'}
      </button>
      <p class="rename-news soft small" role="status">
        {newer &&
          (present === ''
            ? 'Somebody has taken the name away meanwhile.'
            : `Somebody has named this place “${present}” meanwhile.`)}
      </p>
    </form>
  );
}

const kSaid: Readonly<Record<WayOut['closed'], { words: string; tone: string } | null>> = {
  no: null,
  one_way: { words: 'Closed in one direction', tone: 'warn' },
  both: { words: 'Closed', tone: 'bad' },
};

type WaysProps = Pick<Props, 'graph' | 'place' | 'mayEdit' | 'onEdit' | 'onChoose' | 'busy'>;

function Ways({ graph, place, mayEdit, busy, onEdit, onChoose }: WaysProps) {
  const ways = waysOut(graph, place.id);
  const setBlocked = (other: string, blocked: boolean) => {
    const edits = graph.edges
      .filter(
        (one) => (one.from === place.id && one.to === other) || (one.to === place.id && one.from === other),
      )
      .filter((one) => one.blocked !== blocked)
      .sort((a, b) => Number(b.from === place.id) - Number(a.from === place.id)) // told as a way from here
      .map((one) => ({ kind: 'block_edge' as const, from: one.from, to: one.to, blocked }));
    onEdit(edits, blocked ? 'This way is closed now.' : 'This way is open again.');
  };
  return (
    <div>
      <h3>Ways from here</h3>
      {ways.length === 0 && <p class="soft">None: the chair cannot drive to or from this place.</p>}
      <ul class="list">
        {ways.map((way) => {
          const title = placeTitle(graph, way.other);
          const said = kSaid[way.closed];
          return (
            <li key={way.other}>
              <button type="button" class="place-row compact" onClick={() => onChoose(way.other)}>
                <img
                  src={calls.placeThumbnailUrl(graph.map, way.other, graph.revision)}
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
                        onClick={() => setBlocked(way.other, verb === 'Close')}
                      >
                        {verb}
                      </button>
                    ))}
              </span>
            </li>
          );
        })}
      </ul>
    </div>
  );
}
