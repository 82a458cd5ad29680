// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Doubt, Doubts, Edit, Graph, MapInfo } from '../../api/types';
import { Choice } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { useLoaded } from '../../lib/loaded';
import { indexOf } from '../../lib/graph_index';
import { placeTitle, titlesApart } from '../../lib/whereabouts';
import { count, percent } from '../../lib/words';
import { DoubtCard } from './doubt_card';
import { allSeenWords, answeredBy, keyOf, kDoubtKinds, setAsideWords } from './doubt_words';
import { useEditor, type Editor } from './editor';
import { mapAddress, show } from './map_address';
import type { OpenDraft } from './map_drawing';
import { Outcome } from './outcome';
import { placeViews } from './place_views';

const kPage = 20;
const kPart = 'doubt';

const kAbout = [
  { value: 'undecided', label: 'Left open' },
  { value: 'close', label: 'Decided, but it was close' },
  { value: 'decided', label: 'Decided by somebody' },
  { value: 'all', label: 'All' },
];

interface Props {
  map: MapInfo;
  graph: Graph; // with the draft that is open
  open: OpenDraft | null;
  mayEdit: boolean;
}

/** What of a map a person should look at, most useful first, to be answered one after the other. */
export function EvidencePage({ map, graph, open, mayEdit }: Props) {
  const [about, setAbout] = useState('undecided');
  const [kind, setKind] = useState('');
  const [offset, setOffset] = useState(0);
  const editor = useEditor(map, graph, open?.draft ?? null, mayEdit, () => undefined);
  const place = mapAddress.value.place ?? '';
  const known = open?.before ?? graph; // doubts are about the map itself
  const named = placeViews(known).filter((one) => one.named);
  const own = place !== '' && indexOf(known).places.has(place) && !named.some((one) => one.id === place);
  const filter = { about, kind, place, offset, limit: kPage };
  const outcome = editor.outcomeIn(kPart);
  const from = (set: (value: string) => void) => (value: string) => {
    set(value);
    setOffset(0);
  };
  return (
    <>
      {open && (
        <Notice tone="warn" still>
          You are working on a draft; the chair does not use it yet. Your answers go to the draft. The doubts
          are those of the map itself.
        </Notice>
      )}
      <p class="soft">Where the map may be wrong. What is most worth a look comes first.</p>
      <div class="form-columns">
        <Choice label="Show" value={about} onChange={from(setAbout)} options={kAbout} />
        <Choice
          label="Kind"
          value={kind}
          onChange={from(setKind)}
          options={[
            { value: '', label: 'All kinds' },
            ...Object.entries(kDoubtKinds).map(([value, label]) => ({ value, label })),
          ]}
        />
        <Choice
          label="At the place"
          value={place}
          onChange={from((value) => show(map.id, { place: value === '' ? null : value }))}
          options={[
            { value: '', label: 'All places' },
            ...(own ? [{ value: place, label: placeTitle(known, place) }] : []),
            ...named.map((one) => ({ value: one.id, label: one.title })),
          ]}
        />
      </div>
      {outcome && <Outcome of={outcome} />}
      <DoubtPages
        key={Object.values(filter).join('\n')}
        filter={filter}
        editor={editor}
        version={known.revision}
        onPage={setOffset}
      />
    </>
  );
}

interface PagesProps {
  filter: Parameters<typeof calls.doubts>[1];
  editor: Editor;
  version: number;
  onPage: (offset: number) => void;
}

function DoubtPages({ filter, editor, version, onPage }: PagesProps) {
  const loaded = useLoaded(() => calls.doubts(editor.map.id, filter), version);
  return (
    <Loading of={loaded} what="What to look at">
      {(page) => <DoubtPage page={page} editor={editor} onPage={onPage} />}
    </Loading>
  );
}

/** Whether an edit of the draft that is open has answered a doubt. */
function answeredIn({ draft }: Editor, doubt: Doubt): boolean {
  return draft !== null && answeredBy(draft.edits, doubt);
}

function DoubtPage({
  page,
  editor,
  onPage,
}: {
  page: Doubts;
  editor: Editor;
  onPage: (offset: number) => void;
}) {
  // Until the page comes anew; an answer that is what the map says already is not saved anywhere else.
  const [passed, setPassed] = useState<ReadonlySet<string>>(new Set());
  const [asked, setAsked] = useState<string | null>(null);
  const { doubts, total, offset } = page;
  const present =
    doubts.find((one) => keyOf(one) === asked) ??
    doubts.find((one) => one.set_aside_by === null && !passed.has(keyOf(one)) && !answeredIn(editor, one)) ??
    null;
  const pass = (one: Doubt) => {
    setPassed((before) => new Set([...before, keyOf(one)]));
    setAsked(null);
  };
  const answer = (one: Doubt, edits: Edit[]) => {
    if (edits.length === 0) pass(one);
    else editor.edit(kPart, edits, 'Saved.', { then: () => pass(one) });
  };
  if (total === 0) return <Notice still>There is nothing of this kind to look at.</Notice>;
  return (
    <div class="evidence-layout">
      {present ? (
        <DoubtCard
          key={keyOf(present)}
          editor={editor}
          doubt={present}
          answered={answeredIn(editor, present)}
          begun={asked !== null || passed.size > 0}
          onAnswer={(edits) => answer(present, edits)}
        />
      ) : (
        <Notice>{allSeenWords(doubts)}</Notice>
      )}
      <section class="card stack" aria-label="What to look at">
        <div class="row apart">
          <h2>What to look at</h2>
          <span class="soft small" role="status">
            {offset + 1} to {offset + doubts.length} of {total}
          </span>
        </div>
        <ol class="doubts">
          {doubts.map((one) => (
            <DoubtRow
              key={keyOf(one)}
              graph={editor.graph}
              doubt={one}
              done={passed.has(keyOf(one)) || answeredIn(editor, one)}
              answered={answeredIn(editor, one)}
              shown={present !== null && keyOf(one) === keyOf(present)}
              onShow={() => setAsked(keyOf(one))}
            />
          ))}
        </ol>
        {total > kPage && (
          <div class="row">
            <button
              type="button"
              class="button"
              disabled={offset === 0}
              onClick={() => onPage(Math.max(0, offset - kPage))}
            >
              Earlier ones
            </button>
            <button
              type="button"
              class="button"
              disabled={offset + doubts.length >= total}
              onClick={() => onPage(offset + kPage)}
            >
              Next {count(Math.min(kPage, total - offset - doubts.length), 'one')}
            </button>
          </div>
        )}
      </section>
    </div>
  );
}

interface RowProps {
  graph: Graph;
  doubt: Doubt;
  done: boolean;
  answered: boolean; // in the draft that is open
  shown: boolean;
  onShow: () => void;
}

function DoubtRow({ graph, doubt, done, answered, shown, onShow }: RowProps) {
  const [a, b] = titlesApart(graph, doubt.place_a, doubt.place_b);
  const pair = doubt.place_a === doubt.place_b ? a : `${a} – ${b}`;
  const left_open = setAsideWords(doubt);
  const open = left_open !== null && !answered;
  return (
    <li>
      <button type="button" class="place-row" aria-pressed={shown} onClick={onShow}>
        <span class="two-pictures">
          {[doubt.image_a, doubt.image_b].map((image) => (
            <img key={image} src={calls.imageThumbnailUrl(graph.map, image)} alt="" loading="lazy" />
          ))}
        </span>
        <span>
          {pair}
          <br />
          <span class="soft small">{kDoubtKinds[doubt.kind]}</span>
        </span>
        <span class={`pill ${open ? 'warn' : done ? 'good' : ''}`}>
          {open ? (
            <>
              <span aria-hidden="true">?</span> <span class="hidden-text">{left_open}</span>
            </>
          ) : done ? (
            <>
              <span aria-hidden="true">✓</span> <span class="hidden-text">looked at</span>
            </>
          ) : (
            <>
              <span class="hidden-text">wrong with a chance of</span> {percent(doubt.probability)}
            </>
          )}
        </span>
      </button>
    </li>
  );
}
