// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo } from 'preact/hooks';
import * as calls from '../../api/calls';
import { me } from '../../api/server';
import type { Graph, MapInfo } from '../../api/types';
import { chosen, connected } from '../../lib/chosen';
import { indexOf } from '../../lib/graph_index';
import { atLeast } from '../../lib/roles';
import { navigate } from '../../lib/router';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { send } from '../go/driving';
import { hindrance, isActive } from '../go/journey';
import { DriveNews } from '../tours/drive_news';
import { useEditor } from './editor';
import { GraphView } from './graph_view';
import { Inspector } from './inspector';
import { LookAlikes } from './look_alikes';
import { mapAddress, show } from './map_address';
import { MapHistory } from './map_history';
import { picking } from './picking';
import { PlaceList } from './place_list';
import { Shortcuts } from './shortcuts';

interface Props {
  map: MapInfo;
  graph: Graph;
  mayEdit: boolean;
}

/** The map as a drawing and as a list, the chosen place, and what there is to decide and to take back. */
export function MapDrawing({ map, graph, mayEdit }: Props) {
  const robot = chosen.value?.map === map.id ? chosen.value : null;
  const belief = robot?.online ? robot.belief : null;
  const mission = robot?.mission && isActive(robot.mission.state) ? robot.mission : null;
  // Each event brings a new mission that mostly says the same.
  const ahead = mission?.path.slice(Math.max(0, mission.path_index - 1)).join('\n') ?? '';
  const way = useMemo(() => (ahead === '' ? [] : ahead.split('\n')), [ahead]);
  const place = indexOf(graph).places.get(mapAddress.value.place ?? '') ?? null;
  const barrier = robot ? hindrance(robot, connected.value, atLeast(me.value?.role, 'rider')) : 'none';
  const editor = useEditor(map, graph, null, mayEdit, (id) => show(map.id, { place: id }));
  const choose = (id: string) => {
    if (picking.value) {
      picking.value.pick(id);
      return;
    }
    show(map.id, { place: id });
    editor.forget();
  };
  useEffect(() => () => void (picking.value = null), []);
  return (
    <>
      <DriveNews map={map} mayTake={mayEdit} />
      <p class="soft">
        {count(graph.places.length, 'place')} from {count(map.images, 'picture')}. Choose one in the drawing
        or in the list.
        {robot && ' The yellow ring shows where the chair believes to be.'}
      </p>
      <div class="map-layout">
        <GraphView graph={graph} belief={belief} way={way} chosen={place?.id ?? null} onChoose={choose} />
        <div class="map-side">
          {place && (
            <Inspector
              editor={editor}
              place={place}
              onChoose={choose}
              onGo={
                robot && barrier === null
                  ? () => {
                      void send(robot.id, { place: place.id, label: placeTitle(graph, place.id) });
                      navigate('/go');
                    }
                  : null
              }
            />
          )}
          <PlaceList graph={graph} belief={belief} chosen={place?.id ?? null} onChoose={choose} />
        </div>
      </div>
      <Shortcuts editor={editor} place={null} />
      <LookAlikes graph={graph} />
      <MapHistory editor={editor} />
      <p>
        <a class="button" href={calls.exportUrl(map.id)} download>
          Save this map as a file
        </a>
      </p>
    </>
  );
}
