// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { connection, graphs } from '../../api/server';
import { sentence } from '../../api/problem';
import type { Job, MapInfo } from '../../api/types';
import { Bar, Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { percent } from '../../lib/words';
import { dismiss, isDismissed } from '../../lib/dismissed';
import { NotePictures } from './note_pictures';
import { noteWords } from './notes';

/** The newest job of a map that is of one of these kinds; null when there is none. */
export function newestJob(
  jobs: readonly Job[],
  map: string,
  kinds: readonly Job['kind'][] = ['build', 'add'],
): Job | null {
  const own = jobs.filter((job) => job.map === map && kinds.includes(job.kind));
  return own.reduce<Job | null>((best, job) => (best && best.created_us > job.created_us ? best : job), null);
}

const kStages: Readonly<Record<string, string>> = {
  features: 'Looking at the pictures',
  compare: 'Comparing the pictures',
  cluster: 'Finding the places',
  places: 'Finding the places',
  thumbnails: 'Making small pictures',
  report: 'Writing the report',
};

/** What a build does now, for people; stages that this version does not know are shown as they are called. */
export function stageWords(job: Job): string {
  if (job.state === 'queued') return 'Waiting for its turn';
  const { stage } = job.progress;
  return kStages[stage] ?? sentence(stage).replace(/\.$/, '');
}

/** What is to be known of the map that a job made, until the reader puts it away. */
function BuildNotes({ job, map }: { job: Job; map: MapInfo }) {
  if (job.notes.length === 0 || isDismissed(job.id)) return null;
  const plain = job.kind === 'add' && job.skipped === 0;
  return (
    <Notice tone={plain ? 'plain' : 'warn'}>
      <div class="stack tight">
        <p>{noteWords(job, graphs.value[map.id]?.graph ?? null)}</p>
        <NotePictures job={job} map={map} graph={graphs.value[map.id]?.graph ?? null} />
        <div class="row">
          <button
            type="button"
            class="button small"
            aria-label={`Hide this: what is to be known of ${map.name}`}
            onClick={() => dismiss(job.id)}
          >
            Hide this
          </button>
        </div>
      </div>
    </Notice>
  );
}

/** How the building of a map goes, why it ended without one, or what is to be known of the one that it made. */
export function BuildProgress({ map, mayCancel }: { map: MapInfo; mayCancel: boolean }) {
  const job = newestJob(connection.value.server?.jobs ?? [], map.id);
  const { busy, problem, run } = useCommand();
  if (!job) return null;
  const adds = job.kind === 'add';
  if (job.state === 'done') return <BuildNotes job={job} map={map} />;
  if (job.state === 'failed')
    return (
      <Notice tone="bad">
        {adds ? 'The tours could not be added.' : 'It could not be built.'}{' '}
        {sentence(job.error?.detail ?? job.error?.title ?? '')}
      </Notice>
    );
  if (job.state === 'cancelled')
    return <Notice tone="warn">{adds ? 'Adding' : 'Building'} was cancelled.</Notice>;
  const words = stageWords(job);
  return (
    <div class="build stack tight">
      <Bar share={job.progress.share} label={`${adds ? 'Adding to' : 'Building'} ${map.name}`} />
      <div class="row apart">
        <span class="soft" aria-live="polite">
          {words}
        </span>
        <span class="row">
          <strong>{percent(job.progress.share)}</strong>
          {mayCancel && (
            <button
              type="button"
              class="button small"
              disabled={busy}
              aria-label={`Cancel ${adds ? 'adding to' : 'building'} ${map.name}`}
              onClick={() => run(() => calls.cancelJob(job.id))}
            >
              Cancel
            </button>
          )}
        </span>
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </div>
  );
}
