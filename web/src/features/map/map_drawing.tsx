// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo } from 'preact/hooks';
import * as calls from '../../api/calls';
import { me } from '../../api/server';
import { draftsOf } from '../../api/drafts';
import type { Difference, Draft, Graph, MapInfo } from '../../api/types';
import { chosen, connected } from '../../lib/chosen';
import { indexOf } from '../../lib/graph_index';
import { atLeast } from '../../lib/roles';
import { navigate } from '../../lib/router';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { send } from '../go/driving';
import { hindrance, isActive } from '../go/journey';
import { DriveNews } from '../tours/drive_news';
import { CoverageCard } from './coverage_card';
import { DifferenceList, ToneLegend } from './difference_list';
import { marksOf } from './difference_marks';
import { DraftBar } from './draft_bar';
import { DraftsCard } from './drafts_card';
import { draftsAt } from './draft_words';
import { useEditor } from './editor';
import { GraphView } from './graph_view';
import { Inspector } from './inspector';
import { LookAlikes } from './look_alikes';
import { mapAddress, show } from './map_address';
import { MapHistory } from './map_history';
import { picking } from './picking';
import { PlaceList } from './place_list';
import { Shortcuts } from './shortcuts';

/** A draft that is open, and what it makes other. */
export interface OpenDraft {
  draft: Draft;
  before: Graph; // the map as the chair uses it
  difference: Difference | null; // null while it is on its way
}

interface Props {
  map: MapInfo;
  graph: Graph; // with the draft that is open
  open: OpenDraft | null;
  mayEdit: boolean;
}

/** The map as a drawing and as a list, the chosen place, and what there is to decide and to take back. */
export function MapDrawing({ map, graph, open, mayEdit }: Props) {
  const robot = chosen.value?.map === map.id ? chosen.value : null;
  const belief = robot?.online ? robot.belief : null;
  const mission = robot?.mission && isActive(robot.mission.state) ? robot.mission : null;
  // Each event brings a new mission that mostly says the same.
  const ahead = mission?.path.slice(Math.max(0, mission.path_index - 1)).join('\n') ?? '';
  const way = useMemo(() => (ahead === '' ? [] : ahead.split('\n')), [ahead]);
  const place = indexOf(graph).places.get(mapAddress.value.place ?? '') ?? null;
  const barrier = robot ? hindrance(robot, connected.value, atLeast(me.value?.role, 'rider')) : 'none';
  const editor = useEditor(map, graph, open?.draft ?? null, mayEdit, (id) => show(map.id, { place: id }));
  const choose = (id: string) => {
    if (picking.value) {
      picking.value.pick(id);
      return;
    }
    show(map.id, { place: id });
    editor.forget();
  };
  useEffect(() => () => void (picking.value = null), []);
  const difference = open?.difference ?? null;
  const before = open?.before ?? null;
  const marks = useMemo(
    () => (difference && before ? marksOf(difference, before, graph) : null),
    [difference, before, graph],
  );
  const others = place ? draftsAt(place.id, draftsOf(map.id).drafts ?? [], open?.draft ?? null) : [];
  const onMap = place !== null && (!before || indexOf(before).places.has(place.id));
  return (
    <>
      {open ? (
        <DraftBar
          map={map}
          before={open.before}
          after={graph}
          draft={open.draft}
          mayEdit={mayEdit}
          onChoose={choose}
        />
      ) : (
        <DriveNews map={map} mayTake={mayEdit} />
      )}
      <p class="soft">
        {count(graph.places.length, 'place')} from {count(map.images, 'picture')}. Choose one in the drawing
        or in the list.
        {robot && ' The yellow ring shows where the chair believes to be.'}
      </p>
      {marks && marks.places.size + marks.lines.size > 0 && <ToneLegend />}
      <div class="map-layout">
        <GraphView
          graph={graph}
          belief={belief}
          way={way}
          chosen={place?.id ?? null}
          marks={marks}
          onChoose={choose}
        />
        <div class="map-side">
          {place && (
            <Inspector
              editor={editor}
              place={place}
              others={others}
              onChoose={choose}
              onGo={
                robot && barrier === null && onMap
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
      {open?.difference && (
        <DifferenceList difference={open.difference} before={open.before} after={graph} onChoose={choose} />
      )}
      {open ? <MapHistory editor={editor} /> : <DraftsCard map={map} graph={graph} mayEdit={mayEdit} />}
      <Shortcuts editor={editor} place={null} />
      <CoverageCard graph={graph} onChoose={choose} />
      <LookAlikes graph={graph} />
      {!open && (
        <>
          <MapHistory editor={editor} />
          <p>
            <a class="button" href={calls.exportUrl(map.id)} download>
              Save this map as a file
            </a>
          </p>
        </>
      )}
    </>
  );
}
