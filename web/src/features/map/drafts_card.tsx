// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { draftsOf, learnDraft } from '../../api/drafts';
import type { Draft, Graph, MapInfo } from '../../api/types';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { count, dateText } from '../../lib/words';
import { changesOf, changeWords } from './changes';
import { draftTitle, touchedWords } from './draft_words';
import { show } from './map_address';

/** What became of the draft that was open. */
export const draftNews = signal<string | null>(null);

const kToldChanges = 3;

interface Props {
  map: MapInfo;
  graph: Graph; // of the map itself
  mayEdit: boolean;
}

/** The drafts of a map, everybody's, and a new one. */
export function DraftsCard({ map, graph, mayEdit }: Props) {
  const { drafts, problem } = draftsOf(map.id);
  if (!mayEdit && !drafts?.length) return null;
  return (
    <section class="card stack" aria-label="Drafts">
      <h2>Try changes first</h2>
      {draftNews.value !== null && <Notice>{draftNews.value}</Notice>}
      <p class="soft">
        In a draft you can change everything about the map. The chair uses it only once it is published.
      </p>
      {problem && <Notice tone="warn">The drafts could not be loaded. {problem.message}</Notice>}
      {mayEdit && <BeginDraft map={map} />}
      {drafts && drafts.length > 0 && (
        <ul class="list">
          {drafts.map((one) => (
            <OneDraft key={one.id} draft={one} graph={graph} />
          ))}
        </ul>
      )}
    </section>
  );
}

function BeginDraft({ map }: { map: MapInfo }) {
  const [name, setName] = useState('');
  const { busy, problem, run } = useCommand();
  return (
    <form
      class="rename"
      onSubmit={(event) => {
        event.preventDefault();
        run(async () => {
          const draft = await calls.beginDraft(map.id, name.trim());
          learnDraft(draft);
          draftNews.value = null;
          setName('');
          show(map.id, { draft: draft.id });
        });
      }}
    >
      <TextField
        label="What it is about"
        hint="May be left empty."
        value={name}
        onInput={setName}
        required={false}
      />
      <button type="submit" class="button main begin-draft" disabled={busy}>
        Begin a draft
      </button>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </form>
  );
}

function OneDraft({ draft, graph }: { draft: Draft; graph: Graph }) {
  const changes = changesOf(draft.edits).filter((one) => !one.undone);
  const told = changes.slice(-kToldChanges).map((one) => `${one.by} ${changeWords(one, graph)}`);
  const more = changes.length - told.length;
  return (
    <li>
      <span class="stack tight">
        <strong>{draftTitle(draft)}</strong>
        <span class="soft small">
          Begun by {draft.by}, {dateText(draft.created_us)}. {count(draft.changes, 'change')}
          {draft.touches.length > 0 && `, at ${touchedWords(draft.touches, graph)}`}.
        </span>
        {told.length > 0 && (
          <span class="soft small">
            {more > 0 && `${count(more, 'earlier change')}; `}
            {told.join('; ')}.
          </span>
        )}
      </span>
      <button
        type="button"
        class="button small"
        aria-label={`Open the draft ${draftTitle(draft)}`}
        onClick={() => {
          draftNews.value = null;
          show(draft.map, { draft: draft.id });
          scrollTo(0, 0);
        }}
      >
        Open
      </button>
    </li>
  );
}
