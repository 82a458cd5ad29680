// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import { connection, graphs, me, wantGraph } from '../../api/server';
import type { MapInfo } from '../../api/types';
import { Notice, Waiting } from '../../components/notice';
import { chosenMap, maps } from '../../lib/chosen';
import { atLeast } from '../../lib/roles';
import { mapAddress, show } from './map_address';
import { MapDrawing } from './map_drawing';

export function MapPage() {
  const wanted = mapAddress.value.map;
  const map = maps.value.find((one) => one.id === wanted) ?? chosenMap.value ?? maps.value[0] ?? null;
  useEffect(() => {
    if (map && map.revision > 0) wantGraph(map);
  }, [map]);
  if (connection.value.server === null) return <Waiting what="Asking the server …" />;
  return (
    <>
      <div class="row apart">
        <h1>{map ? map.name : 'Map'}</h1>
        {maps.value.length > 1 && <MapPicker chosen={map} />}
      </div>
      {map ? (
        <ShownMap map={map} />
      ) : (
        <Notice still>There is no map yet. Build one from a tour, under Tours.</Notice>
      )}
    </>
  );
}

function MapPicker({ chosen: present }: { chosen: MapInfo | null }) {
  return (
    <div class="segments" role="group" aria-label="Map">
      {maps.value.map((one) => (
        <button
          key={one.id}
          type="button"
          aria-pressed={one.id === present?.id}
          onClick={() => show(one.id, {})}
        >
          {one.name}
        </button>
      ))}
    </div>
  );
}

function ShownMap({ map }: { map: MapInfo }) {
  const entry = graphs.value[map.id];
  const mayEdit = atLeast(me.value?.role, 'installer');
  if (entry?.graph)
    return (
      <>
        {entry.error && (
          <Notice tone="warn">This may be an older state of the map. {entry.error.message}</Notice>
        )}
        <MapDrawing key={map.id} map={map} graph={entry.graph} mayEdit={mayEdit} />
      </>
    );
  if (entry?.error)
    return (
      <Notice tone="bad">
        <div class="row apart">
          <span>The map could not be loaded. {entry.error.message}</span>
          <button type="button" class="button" onClick={() => wantGraph(map, true)}>
            Try again
          </button>
        </div>
      </Notice>
    );
  if (map.state === 'building')
    return <Waiting what="This map is being built. Its progress is under Tours." />;
  if (map.state === 'failed')
    return <Notice tone="bad">This map could not be built. The reason is under Tours.</Notice>;
  return <Waiting what="Loading the map …" />;
}
