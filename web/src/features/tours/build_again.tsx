// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { connection } from '../../api/server';
import type { MapInfo } from '../../api/types';
import { Notice } from '../../components/notice';
import { SureButton } from '../../components/sure_button';
import { useCommand } from '../../lib/command';
import { BuildProgress, newestJob } from './jobs';

/** Builds a map anew from the kept pictures of its tours, and tells how that goes and what could not be kept. */
export function BuildAgain({ map }: { map: MapInfo }) {
  const { busy, problem, run } = useCommand();
  const job = newestJob(connection.value.server?.jobs ?? [], map.id);
  const at_work = job?.state === 'queued' || job?.state === 'running';
  if (map.tours.length === 0) return null; // imported
  return (
    <section class="card stack" aria-labelledby="build-again">
      <h2 id="build-again">Build it again</h2>
      <p class="soft">
        From the kept pictures of its tours. What people changed is kept; a change that the new map cannot
        take is told here, with the reason. Until it is done the chair drives by the map as it is.
      </p>
      {!at_work && (
        <p>
          <SureButton
            label="Build again"
            about={map.name}
            question={`Build ${map.name} again?`}
            disabled={busy}
            plain
            onSure={() => run(() => calls.rebuildMap(map.id))}
          />
        </p>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
      <BuildProgress map={map} mayCancel />
    </section>
  );
}
