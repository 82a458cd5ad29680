// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import { useEffect, useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { connection, graphs, me, wantGraph } from '../../api/server';
import { asProblem } from '../../api/problem';
import type { Edit, Graph, MapInfo } from '../../api/types';
import { Notice, Waiting } from '../../components/notice';
import { chosen, chosenMap, connected, maps } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { indexOf } from '../../lib/graph_index';
import { atLeast } from '../../lib/roles';
import { navigate } from '../../lib/router';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { send } from '../go/driving';
import { hindrance, isActive } from '../go/journey';
import { DriveNews } from '../tours/drive_news';
import { GraphView } from './graph_view';
import { Inspector } from './inspector';
import { LookAlikes } from './look_alikes';
import { MapHistory } from './map_history';
import type { OutcomeOf } from './outcome';
import { PlaceList } from './place_list';
import { Shortcuts } from './shortcuts';

const wantedMap = signal<string | null>(null);
const wantedPlace = signal<string | null>(null);

export function MapPage() {
  const map =
    maps.value.find((one) => one.id === wantedMap.value) ?? chosenMap.value ?? maps.value[0] ?? null;
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
          onClick={() => (wantedMap.value = one.id)}
        >
          {one.name}
        </button>
      ))}
    </div>
  );
}

function ShownMap({ map }: { map: MapInfo }) {
  const entry = graphs.value[map.id];
  if (entry?.graph)
    return (
      <>
        {entry.error && (
          <Notice tone="warn">This may be an older state of the map. {entry.error.message}</Notice>
        )}
        <Drawn map={map} graph={entry.graph} />
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

/** The part of the page in which a change was asked for, and where what became of it is said. */
type Part = 'place' | 'shortcuts' | 'history';

function Drawn({ map, graph }: { map: MapInfo; graph: Graph }) {
  const command = useCommand();
  const [latest, setLatest] = useState<{ part: Part; done: string | null } | null>(null);
  const robot = chosen.value?.map === map.id ? chosen.value : null;
  const belief = robot?.online ? robot.belief : null;
  const mission = robot?.mission && isActive(robot.mission.state) ? robot.mission : null;
  // Each event brings a new mission that mostly says the same.
  const ahead = mission?.path.slice(Math.max(0, mission.path_index - 1)).join('\n') ?? '';
  const way = useMemo(() => (ahead === '' ? [] : ahead.split('\n')), [ahead]);
  const place = indexOf(graph).places.get(wantedPlace.value ?? '') ?? null;
  const mayEdit = atLeast(me.value?.role, 'installer');
  const barrier = robot ? hindrance(robot, connected.value, atLeast(me.value?.role, 'rider')) : 'none';

  const change = (part: Part, ask: () => Promise<unknown>, said: string) => {
    setLatest({ part, done: null });
    command.run(async () => {
      try {
        await ask();
        setLatest({ part, done: said });
      } catch (thrown) {
        if (asProblem(thrown).code !== 'stale_revision') throw thrown;
        wantGraph(map, true);
        throw thrown;
      }
      wantGraph(map, true);
    });
  };
  const editIn = (part: Part) => (edits: Edit[], said: string) =>
    change(part, () => calls.edit(map.id, graph.revision, edits), said);
  const outcomeIn = (part: Part): OutcomeOf | null =>
    latest?.part === part && !command.busy ? { done: latest.done, problem: command.problem } : null;
  const choose = (id: string) => {
    wantedPlace.value = id;
    setLatest(null);
    command.forget();
  };
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
              graph={graph}
              place={place}
              mayEdit={mayEdit}
              busy={command.busy}
              outcome={outcomeIn('place')}
              onEdit={editIn('place')}
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
      <Shortcuts
        graph={graph}
        place={null}
        mayEdit={mayEdit}
        busy={command.busy}
        outcome={outcomeIn('shortcuts')}
        onEdit={editIn('shortcuts')}
      />
      <LookAlikes graph={graph} />
      <MapHistory
        graph={graph}
        busy={command.busy}
        outcome={outcomeIn('history')}
        onUndo={
          mayEdit
            ? () =>
                change(
                  'history',
                  () => calls.undo(map.id, graph.revision),
                  'The newest change was taken back.',
                )
            : null
        }
        onRedo={
          mayEdit
            ? () => change('history', () => calls.redo(map.id, graph.revision), 'The change was made again.')
            : null
        }
      />
      <p>
        <a class="button" href={calls.exportUrl(map.id)} download>
          Save this map as a file
        </a>
      </p>
    </>
  );
}
