// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import * as calls from '../../api/calls';
import { connection, graphs, wantGraph } from '../../api/server';
import { sentence } from '../../api/problem';
import type { Graph, Job, MapInfo, RefineMode } from '../../api/types';
import { Choice } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { count } from '../../lib/words';
import { dismiss, isDismissed } from '../../lib/dismissed';
import { newestJob } from './jobs';
import { NotePictures } from './note_pictures';
import { noteWords } from './notes';

/** What is to be said of a job that refines a map; null when nothing is. `graph`: of the map, for the names of places. */
export function driveNews(job: Job, graph: Graph | null): string | null {
  const gained = count(job.gained, 'new appearance');
  switch (job.state) {
    case 'queued':
    case 'running':
      return 'Looking at what drives saw.';
    case 'offered':
      return `${gained} from drives. ${noteWords(job, graph)}`;
    case 'done':
      return job.notes.length > 0 ? noteWords(job, graph) : null;
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
  const graph = graphs.value[map.id]?.graph ?? null;
  const news = job && driveNews(job, graph);
  const named = (job?.notes.length ?? 0) > 0 && map.revision > 0;
  useEffect(() => {
    if (named) wantGraph(map);
  }, [named, map]);
  if (!job || !news || isDismissed(`${job.id} ${job.state}`)) return null;
  if (job.state === 'queued' || job.state === 'running') return <Notice>{news}</Notice>;
  if (job.state !== 'offered')
    return (
      <Notice tone={job.state === 'failed' ? 'bad' : 'plain'}>
        <div class="row apart">
          <span>{news}</span>
          <button
            type="button"
            class="button small"
            aria-label={`Hide what drives taught ${map.name}`}
            onClick={() => dismiss(`${job.id} ${job.state}`)}
          >
            Hide this
          </button>
        </div>
      </Notice>
    );
  return (
    <div class="build stack tight">
      <p aria-live="polite">{news}</p>
      <NotePictures job={job} map={map} graph={graph} />
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
