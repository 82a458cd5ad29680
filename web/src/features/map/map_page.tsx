// SPDX-License-Identifier: Apache-2.0
import type { ComponentType } from 'preact';
import { useEffect } from 'preact/hooks';
import * as calls from '../../api/calls';
import { draftsOf, wantDrafts } from '../../api/drafts';
import { connection, graphs, me, wantGraph } from '../../api/server';
import type { Draft, Graph, MapInfo } from '../../api/types';
import { Loading } from '../../components/loading';
import { Notice, Waiting } from '../../components/notice';
import { chosenMap, maps } from '../../lib/chosen';
import { useLoaded } from '../../lib/loaded';
import { atLeast } from '../../lib/roles';
import { follow } from '../../lib/router';
import { FloorPlanPage } from '../plan/floor_plan_page';
import { ChangesPage } from './changes_page';
import { EvidencePage } from './evidence_page';
import { ReportPage } from './report_page';
import { SimilarityPage } from './similarity_page';
import { mapAddress, pathOf, show, type MapPageName } from './map_address';
import { MapDrawing, type OpenDraft } from './map_drawing';

const kVersions = 1e6; // of a draft at most, on one revision of its map

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

interface OfMap {
  map: MapInfo;
  graph: Graph;
  mayEdit: boolean;
}

/** The map itself, or the draft of it that the address names. */
function MapOrDraft({ map, graph, mayEdit }: OfMap) {
  const since = connection.value.server?.since;
  useEffect(() => wantDrafts(map.id), [map.id, since]);
  const { draft: wanted } = mapAddress.value;
  const { drafts, problem } = draftsOf(map.id);
  const draft = drafts?.find((one) => one.id === wanted) ?? null;
  if (draft) return <WithDraft key={draft.id} map={map} graph={graph} mayEdit={mayEdit} draft={draft} />;
  if (wanted !== null && !drafts && !problem) return <Waiting what="Loading the draft …" />;
  return (
    <>
      {wanted !== null && (
        <Notice tone="warn">
          <div class="row apart">
            <span>This draft is gone: it was published or discarded. This is the map itself.</span>
            <button type="button" class="button" onClick={() => show(map.id, { draft: null })}>
              Understood
            </button>
          </div>
        </Notice>
      )}
      <Shown map={map} graph={graph} open={null} mayEdit={mayEdit} />
    </>
  );
}

function WithDraft({ map, graph, mayEdit, draft }: OfMap & { draft: Draft }) {
  const state = kVersions * draft.revision + draft.version;
  // Together: to draw thousands of places takes a while, and is not to be done for each of the two.
  const ask = () => Promise.all([calls.draftGraph(draft), calls.draftDifference(draft)]);
  const made = useLoaded(ask, state);
  return (
    <Loading of={made} what="The draft">
      {([after, other]) => (
        <Shown map={map} graph={after} open={{ draft, before: graph, difference: other }} mayEdit={mayEdit} />
      )}
    </Loading>
  );
}

const kPages: readonly (readonly [MapPageName, string])[] = [
  ['drawing', 'Places'],
  ['plan', 'Floor plan'],
  ['evidence', 'Evidence'],
  ['changes', 'Changes'],
  ['report', 'Report'],
  ['similarity', 'Similarity'],
];

/** Pages about the map itself, whatever draft is open. */
const kOwnPages: Readonly<Partial<Record<MapPageName, ComponentType<OfMap>>>> = {
  plan: FloorPlanPage,
  changes: ChangesPage,
  report: ReportPage,
  similarity: SimilarityPage,
};

/** The page that the address names, with the way to the other ones. */
function Shown(props: OfMap & { open: OpenDraft | null }) {
  const address = mapAddress.value;
  const Page = address.page === 'evidence' ? EvidencePage : MapDrawing;
  const Own = kOwnPages[address.page];
  return (
    <>
      <nav class="segments map-parts" aria-label="Of this map">
        {kPages.map(([page, words]) => (
          <a
            key={page}
            href={pathOf({ ...address, map: props.map.id, page, of: [], place: null })}
            aria-current={page === address.page ? 'page' : undefined}
            onClick={follow}
          >
            {words}
          </a>
        ))}
      </nav>
      {Own ? (
        <>
          {props.open && (
            <Notice tone="warn" still>
              You are working on a draft. What is here is of the map itself, as the chair uses it.
            </Notice>
          )}
          <Own map={props.map} graph={props.open?.before ?? props.graph} mayEdit={props.mayEdit} />
        </>
      ) : (
        <Page {...props} />
      )}
    </>
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
        <MapOrDraft key={map.id} map={map} graph={entry.graph} mayEdit={mayEdit} />
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
