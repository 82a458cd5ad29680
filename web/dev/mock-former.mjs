// SPDX-License-Identifier: Apache-2.0
// How the mock server's map was after each change of its history.
import { difference } from './mock-difference.mjs';
import { apply } from './mock-edits.mjs';
import { Refusal, wholeNumber } from './mock-refusal.mjs';

const kLastChange = 1e9;

/** The map after a change, later ones left out; 0: as it was built. */
function formerGraph(house, map, change) {
  const own = house.edits.filter((one) => one.change === change);
  if (change !== 0 && (own.length === 0 || own[0].undone))
    throw new Refusal('not_found', `The map has no change ${change} that stands.`, 'change');
  const graph = { ...structuredClone(house.taught), map, revision: house.graph.revision };
  for (const one of house.edits) if (!one.undone && one.change <= change) apply(graph, one);
  return graph;
}

function former(house, { args: [map, change] }) {
  const number = wholeNumber(change, kLastChange, 'path/change');
  house.find('maps', map);
  return { body: formerGraph(house, map, number) };
}

function formerDifference(house, { args: [map, change], query }) {
  const from = wholeNumber(change, kLastChange, 'path/change');
  const to = query.has('to') ? wholeNumber(query.get('to'), kLastChange, 'query/to') : null;
  house.find('maps', map);
  const before = formerGraph(house, map, from);
  return { body: difference(before, to === null ? house.graph : formerGraph(house, map, to)) };
}

export const kFormerRoutes = [
  [/^GET maps\/([^/]+)\/history\/([^/]+)\/graph$/, 'viewer', former],
  [/^GET maps\/([^/]+)\/history\/([^/]+)\/difference$/, 'viewer', formerDifference],
];
