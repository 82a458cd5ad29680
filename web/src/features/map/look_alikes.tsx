// SPDX-License-Identifier: Apache-2.0
import { useMemo } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { openBecause, openPairs } from './look_alike_words';

const kShown = 12;

/** Pairs of places that may be one and that nothing has decided: two pictures side by side, and why. */
export function LookAlikes({ graph }: { graph: Graph }) {
  const open = useMemo(() => openPairs(graph), [graph]);
  if (open.length === 0) return null;
  const titleOf = (image: string) => {
    const place = indexOf(graph).place_of_image.get(image);
    return place ? placeTitle(graph, place.id) : 'A place';
  };
  return (
    <section class="card stack" aria-label="Places that look alike">
      <h2>Places that look alike</h2>
      <p class="soft">
        {count(open.length, 'pair')} of pictures might show one place, and nothing that was seen decides it.
        The map keeps them apart. Where they do show one place, drive the way to it once more and add that
        tour.
      </p>
      <ul class="pairs">
        {open.slice(0, kShown).map((one) => (
          <li key={`${one.prototype_a}|${one.prototype_b}`}>
            <div class="pair">
              {[one.prototype_a, one.prototype_b].map((image) => (
                <img
                  key={image}
                  class="picture whole"
                  src={calls.imageThumbnailUrl(graph.map, image)}
                  alt={titleOf(image)}
                  loading="lazy"
                />
              ))}
            </div>
            <p class="small">
              <strong>
                {titleOf(one.prototype_a)} – {titleOf(one.prototype_b)}
              </strong>
            </p>
            <p class="soft small">{openBecause(one)}</p>
          </li>
        ))}
      </ul>
    </section>
  );
}
