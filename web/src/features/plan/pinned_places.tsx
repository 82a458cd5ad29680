// SPDX-License-Identifier: Apache-2.0
import type { Graph, MapPlan } from '../../api/types';
import { placeTitle } from '../../lib/whereabouts';
import { metres } from './plan_words';

const kFar_m = 1.5; // a pin so far off is told apart: it may be on the wrong spot

/** The places that somebody put onto the plan, and how far each is off. */
export function PinnedPlaces({ tie, graph }: { tie: MapPlan; graph: Graph }) {
  const pinned = tie.places.filter((one) => one.pinned);
  const lost = tie.pins.filter((one) => one.place === null).length;
  return (
    <>
      {pinned.length > 0 && (
        <ul class="list" aria-label="Pinned places">
          {pinned.map(({ place, x_m, y_m, residual_m }) => (
            <li key={place}>
              <span>
                <strong>{placeTitle(graph, place)}</strong>{' '}
                <span class="soft">
                  at {metres(x_m)}, {metres(y_m)}
                </span>
              </span>
              {residual_m !== null && (
                <span class={residual_m > kFar_m ? 'pill warn' : 'pill good'}>{metres(residual_m)} off</span>
              )}
            </li>
          ))}
        </ul>
      )}
      {lost > 0 && (
        <p class="soft">
          {lost === 1
            ? 'One pin counts no more: its picture is in no place of the map now.'
            : `${lost} pins count no more: their pictures are in no place of the map now.`}
        </p>
      )}
    </>
  );
}
