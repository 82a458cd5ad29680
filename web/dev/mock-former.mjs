// SPDX-License-Identifier: Apache-2.0
// How the mock server's map was after each change of its history.
import { difference } from './mock-difference.mjs';
import { apply } from './mock-edits.mjs';
import { Refusal } from './mock-refusal.mjs';

/** The map after a change, later ones left out; 0: as it was built. */
function formerGraph(house, map, change) {
  const own = house.edits.filter((one) => one.change === change);
  if (change !== 0 && (own.length === 0 || own[0].undone))
    throw new Refusal(
      'not_found',
      `No change of the map that stands has the number ${change}.`,
      `maps/${map}/history`,
    );
  const graph = { ...structuredClone(house.taught), map, revision: house.graph.revision };
  for (const one of house.edits) if (!one.undone && one.change <= change) apply(graph, one);
  return graph;
}

function former(house, { args: [map, change] }) {
  house.find('maps', map);
  return { body: formerGraph(house, map, Number(change)) };
}

function formerDifference(house, { args: [map, change], query }) {
  house.find('maps', map);
  const to = query.get('to');
  const after = to === null ? house.graph : formerGraph(house, map, Number(to));
  return { body: difference(formerGraph(house, map, Number(change)), after) };
}

export const kFormerRoutes = [
  [/^GET maps\/([^/]+)\/history\/(\d+)\/graph$/, 'viewer', former],
  [/^GET maps\/([^/]+)\/history\/(\d+)\/difference$/, 'viewer', formerDifference],
];
