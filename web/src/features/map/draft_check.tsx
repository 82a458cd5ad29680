// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import * as calls from '../../api/calls';
import { sentence } from '../../api/problem';
import { connection } from '../../api/server';
import type { Draft, Graph, Job, ReplayCheck, WorseSpot } from '../../api/types';
import { Bar, Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { indexOf } from '../../lib/graph_index';
import { useLoaded } from '../../lib/loaded';
import { percent } from '../../lib/words';
import { countWords, verdictWords, worseWords } from './check_words';
import { fileOf } from './tour_order';

const kPictures = 6; // of a spot
const kActive: readonly Job['state'][] = ['queued', 'running'];

interface Props {
  draft: Draft;
  before: Graph;
  after: Graph;
  mayEdit: boolean;
  onChoose: (place: string) => void;
}

/** Tries a draft on the pictures of the tours: how far that is, and what it found. */
export function DraftCheck({ draft, before, after, mayEdit, onChoose }: Props) {
  const { busy, problem, run, forget } = useCommand();
  const asked = draft.check;
  const job = connection.value.server?.jobs.find((one) => one.id === asked?.job) ?? null;
  const active = job !== null && kActive.includes(job.state);
  const ended = job?.state === 'done' ? 2 : 1; // a result is there, or another one than before
  const { value: check, problem: unloaded } = useLoaded(
    () => calls.draftCheck(draft).catch(noneYet),
    ended + 2 * (asked?.version ?? 0),
  );
  useEffect(forget, [draft.version]); // eslint-disable-line react-hooks/exhaustive-deps
  return (
    <div class="stack" role="group" aria-label="Check on the tours">
      {mayEdit && !active && (
        <div class="row">
          <button
            type="button"
            class="button main"
            disabled={busy || draft.changes === 0}
            onClick={() => run(() => calls.checkDraft(draft))}
          >
            {check ? 'Check it again on the tours' : 'Check it on the tours'}
          </button>
          <span class="soft small">Tries whether all pictures of the tours are still recognised.</span>
        </div>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
      {unloaded && <Notice tone="warn">The result could not be loaded. {unloaded.message}</Notice>}
      {active && <Progress job={job} mayCancel={mayEdit} />}
      {job?.state === 'failed' && (
        <Notice tone="bad">
          It could not be checked. {sentence(job.error?.detail ?? job.error?.title ?? '')}
        </Notice>
      )}
      {job?.state === 'cancelled' && <Notice tone="warn">The check was cancelled.</Notice>}
      {check && !active && (
        <Result check={check} draft={draft} before={before} after={after} onChoose={onChoose} />
      )}
    </div>
  );
}

/** No check has ended yet. */
function noneYet(thrown: unknown): null {
  if (thrown instanceof Error && 'status' in thrown && thrown.status === 404) return null;
  throw thrown;
}

function Progress({ job, mayCancel }: { job: Job; mayCancel: boolean }) {
  const { busy, run } = useCommand();
  return (
    <div class="stack tight">
      <Bar share={job.progress.share} label="Checking the draft" />
      <div class="row apart">
        <span class="soft" role="status">
          {job.state === 'queued' ? 'Waiting for its turn' : 'Looking for each picture of the tours'}
        </span>
        <span class="row">
          <strong>{percent(job.progress.share)}</strong>
          {mayCancel && (
            <button
              type="button"
              class="button small"
              disabled={busy}
              onClick={() => run(() => calls.cancelJob(job.id))}
            >
              Cancel the check
            </button>
          )}
        </span>
      </div>
    </div>
  );
}

type ResultProps = Omit<Props, 'mayEdit'> & { check: ReplayCheck };

function Result({ check, draft, before, after, onChoose }: ResultProps) {
  const old = check.draft_version !== draft.version || check.revision !== draft.revision;
  return (
    <>
      {old && (
        <Notice tone="warn" still>
          This was found before the latest change. Check again to be sure.
        </Notice>
      )}
      <Notice tone={check.harmless ? 'plain' : 'warn'}>
        <p>
          <strong>{verdictWords(check)}</strong>
        </p>
        <p class="small">{countWords(check)}</p>
      </Notice>
      {check.worse.length > 0 && (
        <ul class="list worse">
          {check.worse.map((spot, i) => (
            <Spot key={i} spot={spot} map={draft.map} before={before} after={after} onChoose={onChoose} />
          ))}
        </ul>
      )}
    </>
  );
}

interface SpotProps {
  spot: WorseSpot;
  map: string;
  before: Graph;
  after: Graph;
  onChoose: (place: string) => void;
}

function Spot({ spot, map, before, after, onChoose }: SpotProps) {
  const words = worseWords(spot, before, after);
  const there =
    [spot.place, spot.other].find((one) => one !== null && indexOf(after).places.has(one)) ?? null;
  return (
    <li>
      <span>{words}</span>
      {there !== null && (
        <button
          type="button"
          class="button small"
          aria-label={`Show on the map: ${words}`}
          onClick={() => onChoose(there)}
        >
          Show
        </button>
      )}
      {spot.images.length > 0 && (
        <ul class="concerned whole-row">
          {spot.images.slice(0, kPictures).map((image) => (
            <li key={image}>
              <img
                src={calls.imageThumbnailUrl(map, image)}
                alt={`Picture ${fileOf(image)}`}
                loading="lazy"
              />
            </li>
          ))}
        </ul>
      )}
    </li>
  );
}
