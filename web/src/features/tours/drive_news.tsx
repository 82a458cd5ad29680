// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { connection } from '../../api/server';
import { sentence } from '../../api/problem';
import type { Job, MapInfo, RefineMode } from '../../api/types';
import { Choice } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { count } from '../../lib/words';
import { newestJob, noteWords } from './jobs';

/** What is to be said of a job that refines a map; null when nothing is. */
export function driveNews(job: Job): string | null {
  const gained = count(job.gained, 'new appearance');
  switch (job.state) {
    case 'queued':
    case 'running':
      return 'Looking at what drives saw.';
    case 'offered':
      return `${gained} from drives. ${noteWords(job)}`;
    case 'done':
      return job.notes.length > 0 ? noteWords(job) : null;
    case 'failed':
      return `Nothing was learnt from drives. ${sentence(job.error?.detail ?? job.error?.title ?? '')}`;
    case 'cancelled':
      return null;
  }
}

/** What drives would teach a map, to be taken or discarded, or what they taught it. */
export function DriveNews({ map, mayTake }: { map: MapInfo; mayTake: boolean }) {
  const job = newestJob(connection.value.server?.jobs ?? [], map.id, ['refine']);
  const { busy, problem, run } = useCommand();
  const news = job && driveNews(job);
  if (!job || !news) return null;
  if (job.state !== 'offered') return <Notice tone={job.state === 'failed' ? 'bad' : 'plain'}>{news}</Notice>;
  return (
    <div class="build stack tight">
      <p aria-live="polite">{news}</p>
      {mayTake && (
        <div class="row">
          <button
            type="button"
            class="button small main"
            disabled={busy}
            aria-label={`Take what drives saw into ${map.name}`}
            onClick={() => run(() => calls.takeJob(job.id))}
          >
            Take
          </button>
          <button
            type="button"
            class="button small"
            disabled={busy}
            aria-label={`Discard what drives saw for ${map.name}`}
            onClick={() => run(() => calls.cancelJob(job.id))}
          >
            Discard
          </button>
        </div>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </div>
  );
}

const kModes: readonly { value: RefineMode; label: string }[] = [
  { value: 'ask', label: 'Ask me' },
  { value: 'auto', label: 'Keep it at once' },
  { value: 'off', label: 'Forget it' },
];

/** What becomes of what drives see. */
export function RefineSetting({ map }: { map: MapInfo }) {
  const { busy, problem, run } = useCommand();
  return (
    <>
      <Choice
        label={`When a drive saw places of ${map.name} in a new light`}
        value={map.refine}
        disabled={busy}
        onChange={(value) => run(() => calls.setRefine(map.id, value as RefineMode))}
        options={kModes}
      />
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </>
  );
}
