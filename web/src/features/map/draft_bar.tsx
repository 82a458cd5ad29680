// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { draftsOf, learnDraft, learnGone } from '../../api/drafts';
import { asProblem } from '../../api/problem';
import { wantGraph } from '../../api/server';
import type { Draft, Graph, MapInfo } from '../../api/types';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { SureButton } from '../../components/sure_button';
import { useCommand } from '../../lib/command';
import { count } from '../../lib/words';
import { DraftCheck } from './draft_check';
import { draftNews } from './drafts_card';
import { draftTitle, overlapsWith, touchedWords } from './draft_words';
import { show } from './map_address';

interface Props {
  map: MapInfo;
  before: Graph; // the map as the chair uses it
  after: Graph;
  draft: Draft;
  mayEdit: boolean;
  onChoose: (place: string) => void;
}

/** That a draft is open, who else changes the same places, and what may become of it. */
export function DraftBar({ map, before, after, draft, mayEdit, onChoose }: Props) {
  const { busy, problem, run } = useCommand();
  const overlaps = overlapsWith(draft, draftsOf(map.id).drafts ?? []);
  const title = draftTitle(draft);
  const lost = draft.edits.filter((one) => one.lost !== null && !one.undone);
  const leave = (news: string | null) => {
    draftNews.value = news;
    show(map.id, { draft: null });
  };
  const end = (ask: () => Promise<unknown>, news: string) =>
    run(async () => {
      try {
        await ask();
      } catch (thrown) {
        if (asProblem(thrown).code === 'stale_revision') learnDraft(await calls.draft(draft));
        throw thrown;
      }
      leave(news);
      learnGone(draft.id);
      wantGraph(map, true);
    });
  return (
    <section class="card stack draft-bar" aria-label="Draft">
      <div class="row">
        <Icon name="info" />
        <h2>{title}</h2>
        <span class="soft small">
          by {draft.by}, {count(draft.changes, 'change')}
        </span>
      </div>
      <p>
        <strong>You are working on a draft; the chair does not use it yet.</strong>
      </p>
      {overlaps.map(({ draft: one, places }) => (
        <Notice key={one.id} tone="warn">
          {one.by} changes {touchedWords(places, before)} too, in the draft “{draftTitle(one)}”. Speak with
          each other before you publish.
        </Notice>
      ))}
      {lost.length > 0 && (
        <Notice tone="warn" still>
          The map has changed, and {count(lost.length, 'edit')} of this draft{' '}
          {lost.length === 1 ? 'does' : 'do'} not hold on it any more. The reasons are below, under Changes in
          this draft.
        </Notice>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
      <div class="row">
        <button type="button" class="button" onClick={() => leave(null)}>
          Leave it for now
        </button>
        {mayEdit && (
          <>
            <SureButton
              label="Publish"
              about={`the draft ${title}`}
              question={
                lost.length > 0
                  ? 'The chair uses it from then on, without what does not hold. Publish?'
                  : 'The chair uses it from then on. Publish?'
              }
              plain
              disabled={busy || draft.changes === 0}
              onSure={() =>
                end(
                  () => calls.publishDraft(draft, lost.length > 0),
                  `“${title}” was published: the chair uses it now.`,
                )
              }
            />
            <SureButton
              label="Discard"
              about={`the draft ${title}`}
              question="All its changes are lost. Discard?"
              disabled={busy}
              onSure={() => end(() => calls.discardDraft(draft), `“${title}” was discarded.`)}
            />
          </>
        )}
      </div>
      <DraftCheck draft={draft} before={before} after={after} mayEdit={mayEdit} onChoose={onChoose} />
    </section>
  );
}
