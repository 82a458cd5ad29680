// SPDX-License-Identifier: Apache-2.0
import type { Graph, ReplayCheck, WorseSpot } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeInWords, placeTitle } from '../../lib/whereabouts';
import { titleIn } from './difference_words';

/** Where a place is, to begin a sentence with: "In the kitchen", "At “Third from the hall”". */
function whereWords(after: Graph, before: Graph, place: string): string {
  const graph = indexOf(after).places.has(place) ? after : before;
  const title = placeTitle(graph, place);
  const words = placeInWords(graph, place);
  const plain = words !== null && (title.startsWith('Near ') || words.startsWith('in '));
  if (!plain) return `At “${title}”`;
  return words.charAt(0).toUpperCase() + words.slice(1);
}

function pictures(n: number, of: number): string {
  return n === of ? `all ${of} pictures` : `${n} of ${of} pictures`;
}

/** What gets worse at a spot, in one sentence. */
export function worseWords(spot: WorseSpot, before: Graph, after: Graph): string {
  const { kind, place, other, of, distance_m } = spot;
  const title = titleIn(after, before);
  const some = pictures(spot.times, of);
  const to = other === null ? 'another place' : title(other);
  switch (kind) {
    case 'localisation': {
      const taken = other === null ? '' : ` Most of them would be taken for ${to}.`;
      return `${whereWords(after, before, place)} the chair would be lost on ${some}.${taken}`;
    }
    case 'pictures':
      return `Of what came to ${title(place)}, ${some} do not show it.`;
    case 'places':
      return `Of what came to ${title(place)}, ${some} were taken ${distance_m.toFixed(1)} m away from it.`;
    case 'way':
      return `No picture sees the new way from ${title(place)} to ${to}.`;
    case 'far_way':
      return `The new way from ${title(place)} to ${to} is about ${distance_m.toFixed(1)} m: too long to be seen along.`;
    case 'route':
      return `The chair could not drive from ${title(place)} to ${to} any more.`;
    case 'drives': {
      const taken = other === null ? '' : ` Most of it would be taken for ${to}.`;
      return `On its drives the chair would not have known ${title(place)} on ${some}.${taken}`;
    }
    case 'destination':
      return `The destination at ${title(place)} would go with its place.`;
  }
}

/** What a check found in all. */
export function verdictWords({ harmless, pictures: all, sights, worse }: ReplayCheck): string {
  const drives = sights > 0 ? ` and ${sights} of drives` : '';
  if (harmless) return `Nothing gets worse on the ${all} pictures of the tours${drives}.`;
  return worse.length === 1
    ? 'One thing gets worse. Look at it before you publish.'
    : `${worse.length} things get worse. Look at them before you publish.`;
}

export function countWords(check: ReplayCheck): string {
  const {
    pictures: all,
    right_before,
    right_after,
    lost_before,
    lost_after,
    routes_before,
    routes_after,
  } = check;
  return (
    `Recognised where they were taken: ${right_before} of ${all} pictures as the map is, ${right_after} with the draft. ` +
    `Not recognised at all: ${lost_before}, and ${lost_after} with the draft. ` +
    `Drives between destinations that are possible: ${routes_before}, and ${routes_after} with the draft.`
  );
}
