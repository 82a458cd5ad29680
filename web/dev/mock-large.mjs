// SPDX-License-Identifier: Apache-2.0
// A large building for the mock server: corridors in rows that one corridor joins, places along them.
import { newGraph } from './mock-house.mjs';

const kRows = 10;
const kNamedEach = 100;
const kWingNames = ['ward', 'office', 'ward', 'laboratory', 'workshop'];

/** A graph of so many places, p1 and on; every hundredth has a name: "ward 1", "office 2" and so on. */
export function largeGraph(map, places) {
  const small = newGraph(map);
  const inRow = Math.ceil(places / kRows);
  const at = (n) => ({ row: Math.floor(n / inRow), step: n % inRow });
  const named = [];
  const drawn = Array.from({ length: places }, (_, n) => {
    const { row, step } = at(n);
    const label = n % kNamedEach === 50 ? `${kWingNames[row % kWingNames.length]} ${named.length + 1}` : '';
    const id = `p${n + 1}`;
    const wave = 0.03 * Math.sin(step / 9);
    const place = { x: step / inRow, y: 0.05 + (0.9 * row) / kRows + wave };
    const one = {
      id,
      label,
      name: label || id,
      prototype: `t1/${id}.jpg`,
      members: [`t1/${id}.jpg`],
      features: 300,
      ...place,
    };
    if (label) named.push(one);
    return one;
  });
  const pairs = drawn.flatMap((_, n) => {
    const { row, step } = at(n);
    const next = step + 1 < inRow && n + 1 < places ? [[n, n + 1]] : [];
    return step === 0 && row > 0 ? [[n - inRow, n], ...next] : next;
  });
  const edges = pairs.flatMap(([a, b]) => [way(small, a, b), way(small, b, a)]);
  const destinations = named.map((one) => ({
    id: one.label.replace(' ', '_'),
    place: one.id,
    image: one.prototype,
    pictogram: '',
    label: one.label,
  }));
  return { ...small, places: drawn, edges, destinations, hypotheses: [], shortcuts: [] };
}

function way({ edges }, a, b) {
  return { ...edges[0], from: `p${a + 1}`, to: `p${b + 1}`, weak: false };
}
