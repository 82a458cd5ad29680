// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { me, socket } from '../../api/server';
import type { MapInfo, Tour } from '../../api/types';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { SureButton } from '../../components/sure_button';
import { maps, robots } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { explorePath } from '../../lib/explore_address';
import { useLoaded } from '../../lib/loaded';
import { atLeast } from '../../lib/roles';
import { follow, path } from '../../lib/router';
import { count, dateText } from '../../lib/words';
import { PlansCard } from '../plan/plans_card';
import { BuildMap } from './build_map';
import { DriveNews, RefineSetting } from './drive_news';
import { BuildProgress } from './jobs';
import { NewTour } from './new_tour';
import { tourListVersion } from './upload';

export function ToursPage() {
  const tours = useLoaded(calls.tours, tourListVersion.value);
  const mayInstall = atLeast(me.value?.role, 'installer');
  const wanted = path.value.split('/')[2] ?? null; // /tours/t7: build a map of this one
  return (
    <>
      <h1>Tours and maps</h1>
      <Loading of={tours} what="The tours">
        {(answer) => (
          <div class="two-columns">
            <div class="stack">
              <TourList tours={answer.tours} />
              <Maps mayInstall={mayInstall} />
              <PlansCard mayInstall={mayInstall} />
            </div>
            <div class="stack">
              {mayInstall ? (
                <>
                  <NewTour tours={answer.tours} />
                  <LetExplore />
                  <BuildMap
                    key={wanted ?? ''}
                    tours={answer.tours}
                    maps={maps.value}
                    wanted={answer.tours.some((one) => one.id === wanted) ? wanted : null}
                  />
                </>
              ) : (
                <Notice still>Somebody who may install things adds tours and builds maps.</Notice>
              )}
            </div>
          </div>
        )}
      </Loading>
    </>
  );
}

/** A robot can make a tour by itself. */
function LetExplore() {
  if (robots.value.length === 0) return null;
  return (
    <section class="card stack" aria-labelledby="let-explore">
      <h2 id="let-explore">Let a robot map a building by itself</h2>
      <p class="soft">
        It drives through all rooms that it can get to while somebody walks with it, and its pictures become a
        tour.
      </p>
      <div class="row">
        {robots.value.map((one) => (
          <a key={one.id} class="button" href={explorePath(one.id)} onClick={follow}>
            With {one.name}
          </a>
        ))}
      </div>
    </section>
  );
}

function TourList({ tours }: { tours: readonly Tour[] }) {
  return (
    <section class="card stack" aria-labelledby="tour-list">
      <h2 id="tour-list">Tours</h2>
      {tours.length === 0 && <p class="soft">There is no tour yet.</p>}
      <ul class="list">
        {tours.map((one) => (
          <li key={one.id}>
            <div>
              <strong>{one.name}</strong>
              <p class="soft small">
                {count(one.images, 'picture')}, {dateText(one.created_us)}
              </p>
            </div>
            <span class={one.state === 'complete' ? 'pill good' : 'pill warn'}>
              {one.state === 'complete' ? 'Complete' : 'Not complete'}
            </span>
          </li>
        ))}
      </ul>
    </section>
  );
}

function Maps({ mayInstall }: { mayInstall: boolean }) {
  return (
    <section class="card stack" aria-labelledby="map-list">
      <h2 id="map-list">Maps</h2>
      {maps.value.length === 0 && <p class="soft">There is no map yet.</p>}
      <ul class="list">
        {maps.value.map((one) => (
          <MapRow key={one.id} map={one} mayInstall={mayInstall} />
        ))}
      </ul>
    </section>
  );
}

const kStates: Readonly<Record<MapInfo['state'], { word: string; tone: string }>> = {
  building: { word: 'Being built', tone: 'warn' },
  ready: { word: 'Ready', tone: 'good' },
  failed: { word: 'Not built', tone: 'bad' },
};

function MapRow({ map, mayInstall }: { map: MapInfo; mayInstall: boolean }) {
  const { busy, problem, run } = useCommand();
  const remove = () =>
    run(async () => {
      await calls.removeMap(map.id);
      socket.reconnect(); // the events tell what is there, not what has gone
    });
  return (
    <li>
      <div>
        <strong>{map.name}</strong>
        <p class="soft small">
          {map.state === 'ready'
            ? `${count(map.places, 'place')} from ${count(map.images, 'picture')}`
            : 'No places yet'}
        </p>
      </div>
      <div class="row">
        <span class={`pill ${kStates[map.state].tone}`}>{kStates[map.state].word}</span>
        {mayInstall && map.state !== 'building' && (
          <SureButton
            label="Remove"
            about={map.name}
            question="Remove this map?"
            disabled={busy}
            onSure={remove}
          />
        )}
      </div>
      <BuildProgress map={map} mayCancel={mayInstall} />
      <DriveNews map={map} mayTake={mayInstall} />
      {mayInstall && map.state === 'ready' && <RefineSetting map={map} />}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </li>
  );
}
