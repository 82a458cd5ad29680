// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Graph, Job, MapInfo } from '../../api/types';
import { placeTitle } from '../../lib/whereabouts';
import { jumpsOf, unnamedPlaces } from './notes';

const kShown = 4;

/** The pictures that the notes of a job tell of: pairs between which a tour jumps, and places that have no name. */
export function NotePictures({ job, map, graph }: { job: Job; map: MapInfo; graph: Graph | null }) {
  const jumps = jumpsOf(job).slice(0, kShown);
  const places = unnamedPlaces(job, graph).slice(0, kShown);
  if (jumps.length + places.length === 0) return null;
  return (
    <ul class="pairs note-pictures">
      {jumps.map(({ from, to }) => (
        <li key={to}>
          <div class="pair">
            {[from, to].map((image) => (
              <img
                key={image}
                class="picture whole"
                src={calls.imageThumbnailUrl(map.id, image)}
                alt={image.slice(image.lastIndexOf('/') + 1)}
                loading="lazy"
              />
            ))}
          </div>
        </li>
      ))}
      {graph &&
        places.map((place) => (
          <li key={place}>
            <img
              class="picture whole"
              src={calls.placeThumbnailUrl(map.id, place, graph.revision)}
              alt={placeTitle(graph, place)}
              loading="lazy"
            />
          </li>
        ))}
    </ul>
  );
}
