// SPDX-License-Identifier: Apache-2.0
// The house of the mock server: a drawn floor plan, pictures of its places, and ways between them.

/** Rooms and ways: id, x, y in [0, 1], name (empty: none), colour of the walls, what stands there. */
const kPlaces = [
  ['p1', 0.08, 0.5, 'hall', '#c9b48c', 'door'],
  ['p2', 0.2, 0.5, '', '#cdbb97', 'plain'],
  ['p3', 0.34, 0.5, '', '#d3c3a4', 'plain'],
  ['p4', 0.34, 0.28, '', '#b9c7b2', 'plain'],
  ['p5', 0.34, 0.08, 'kitchen', '#a9c3a0', 'stove'],
  ['p6', 0.5, 0.5, '', '#d6c9ae', 'plain'],
  ['p7', 0.66, 0.5, '', '#d0c0a8', 'plain'],
  ['p8', 0.66, 0.28, '', '#a8bccf', 'plain'],
  ['p9', 0.66, 0.08, 'bedroom', '#8fadc9', 'bed'],
  ['p10', 0.82, 0.5, '', '#d9b9a2', 'plain'],
  ['p11', 0.94, 0.5, 'living_room', '#d8a889', 'sofa'],
  ['p12', 0.5, 0.72, '', '#b7cfd0', 'plain'],
  ['p13', 0.5, 0.92, 'bathroom', '#9ecbcf', 'bath'],
];
const kWays = [
  'p1-p2',
  'p2-p3',
  'p3-p4',
  'p4-p5',
  'p3-p6',
  'p6-p7',
  'p7-p8',
  'p8-p9',
  'p7-p10',
  'p10-p11',
  'p6-p12',
  'p12-p13',
];

const kThings = {
  door: '<rect x="60" y="46" width="40" height="62" rx="2" fill="#7a5230"/><circle cx="93" cy="80" r="3" fill="#e9c46a"/>',
  stove:
    '<rect x="30" y="66" width="100" height="42" fill="#f3efe6"/><rect x="96" y="72" width="26" height="26" fill="#39424a"/><circle cx="52" cy="62" r="9" fill="#39424a"/>',
  bed: '<rect x="36" y="76" width="92" height="26" rx="4" fill="#f6f1e7"/><rect x="36" y="60" width="12" height="48" fill="#6b4a2f"/><rect x="50" y="70" width="24" height="12" rx="5" fill="#fff"/>',
  sofa: '<rect x="34" y="72" width="92" height="30" rx="9" fill="#8c3f3a"/><rect x="26" y="80" width="16" height="26" rx="6" fill="#73302c"/><rect x="118" y="80" width="16" height="26" rx="6" fill="#73302c"/>',
  bath: '<rect x="34" y="80" width="92" height="24" rx="12" fill="#fff"/><path d="M44 80V58h14" stroke="#77808a" stroke-width="4" fill="none"/>',
  plain: '<rect x="66" y="56" width="28" height="34" rx="2" fill="#ffffff88" stroke="#00000033"/>',
};

/** A drawn picture of a place (SVG), as an installer's camera would have taken it on a good day. */
export function pictureOf(place) {
  const [, , , , wall, thing] = kPlaces.find(([id]) => id === place) ?? kPlaces[1];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="-40 0 240 120" width="480" height="240"><rect x="-40" width="240" height="120" fill="${wall}"/>
<path d="M-40 120 0 92h160l40 28z" fill="#8a6f52"/><path d="M-40 0 0 22v70l-40 28zM200 0l-40 22v70l40 28z" fill="#00000018"/>
<path d="M-40 0 0 22h160L200 0z" fill="#ffffff55"/>${kThings[thing]}</svg>`;
}

export function neighboursOf(graph, place) {
  return graph.edges.filter((one) => !one.blocked && one.from === place).map((one) => one.to);
}

/** What a job tells of the kitchen. */
export function kitchenNote(code) {
  return {
    code,
    parameters: { place: { code: 'place_named', parameters: { label: 'kitchen' } }, appearances: 2 },
  };
}

/** And of the place beside it, which nobody has named. */
export function unnamedNote(code) {
  return {
    code,
    parameters: { place: { code: 'place_numbered', parameters: { place: 'p4' } }, appearances: 1 },
  };
}

/** What a build says of a tour in which two pictures were taken out of their order. */
export const kJumpNote = {
  code: 'warning_at',
  parameters: {
    warning: {
      code: 'tour_jumps',
      parameters: {
        jumps: 1,
        steps: 25,
        pictures: [{ code: 'jump', parameters: { from: 'p5.jpg', to: 'p11.jpg' } }],
      },
    },
    image: 't1/p11.jpg',
  },
};

/** The shortest way in numbers of places, breadth first; null when there is none. */
export function wayBetween(graph, from, to) {
  const before = new Map([[from, null]]);
  for (const place of before.keys())
    for (const next of neighboursOf(graph, place)) if (!before.has(next)) before.set(next, place);
  if (!before.has(to)) return null;
  const way = [];
  for (let place = to; place !== null; place = before.get(place)) way.unshift(place);
  return way;
}

const named = ({ id, label }) => (label === '' ? id : `${id} (${label})`);

/** Why no way leads from one place to another, as the real server says it. */
export function noWayText(graph, from, to) {
  const name = (id) => named(graph.places.find((one) => one.id === id));
  const ways = `from ${name(from)} to ${name(to)}`;
  const open = { ...graph, edges: graph.edges.map((one) => ({ ...one, blocked: false })) };
  const freest = wayBetween(open, from, to);
  if (!freest)
    return `No way ${ways} was seen on a tour: the two are in parts of the map that are not connected.`;
  const blocked = (a, b) => graph.edges.some((one) => one.from === a && one.to === b && one.blocked);
  const items = freest.slice(1).flatMap((place, i) => {
    const before = freest[i];
    if (!blocked(before, place)) return [];
    const words = blocked(place, before) ? 'blocked' : 'blocked in this direction';
    return [`the way from ${name(before)} to ${name(place)}, which is ${words}`];
  });
  const listed = items.length > 1 ? `${items.slice(0, -1).join(', ')} and ${items.at(-1)}` : items[0];
  return `There is no way ${ways}: the freest leads over ${listed}.`;
}

export function newGraph(map) {
  const places = kPlaces.map(([id, x, y, label]) => ({
    id,
    label,
    name: label || id, // as where nothing tells it from others
    prototype: `t1/${id}.jpg`,
    members: [`t1/${id}.jpg`, `t1/${id}b.jpg`],
    features: 180 + 7 * Number(id.slice(1)),
    brightness: 0.41,
    ...(label === 'kitchen'
      ? {
          learnt: [
            { image: `t1/${id}b.jpg`, brightness: 0.18 },
            { image: null, brightness: 0.06 },
          ],
        }
      : {}),
    x,
    y,
  }));
  const edges = kWays.flatMap((way, i) => {
    const [a, b] = way.split('-');
    return [
      [a, b],
      [b, a],
    ].map(([from, to]) => ({
      from,
      to,
      bearing_rad: 0.1 * i,
      turn_rad: 0,
      length_m: 1.2,
      length_from: 'odometry',
      confidence: 0.9,
      inliers: 40,
      weak: way === 'p12-p13',
      blocked: false,
      shortcut: false,
      by: 'method',
    }));
  });
  const destinations = places
    .filter((one) => one.label)
    .map((one) => ({ id: one.label, place: one.id, image: one.prototype, label: one.label, pictogram: '' }));
  const masses = (yes, no) => ({ true: yes, false: no, unknown: Math.round(1e3 * (1 - yes - no)) / 1e3 });
  return {
    format: 'homeward-graph',
    version: 1,
    map,
    revision: 1,
    places,
    edges,
    destinations,
    hypotheses: [
      {
        prototype_a: 't1/p2.jpg',
        prototype_b: 't1/p6.jpg',
        masses_before: masses(0.2, 0.1),
        masses_after: masses(0.05, 0.85),
        support: 0.05,
        plausibility: 0.15,
        decision: 'rejected',
        by: 'method',
      },
      {
        // Beside each other, and so much alike that nothing but the tour's own steps keeps them apart.
        prototype_a: 't1/p2.jpg',
        prototype_b: 't1/p3.jpg',
        masses_before: masses(0.95, 0),
        masses_after: masses(1, 0),
        support: 1,
        plausibility: 1,
        decision: 'undecided',
        by: 'method',
      },
      {
        prototype_a: 't1/p4.jpg',
        prototype_b: 't1/p12.jpg',
        masses_before: masses(0.6, 0.1),
        masses_after: masses(0.55, 0.2),
        support: 0.55,
        plausibility: 0.8,
        decision: 'undecided',
        by: 'method',
      },
    ],
    shortcuts: [
      {
        image_a: 't1/p2.jpg',
        image_b: 't1/p6.jpg',
        place_a: 'p2',
        place_b: 'p6',
        bearing_rad: 1.2,
        turn_rad: 0.1,
        length_m: 2.6,
        way_m: 9.4,
        clear_m: 1.3,
        confidence: 0.93,
        inliers: 71,
        state: 'proposed',
        by: 'method',
      },
    ],
  };
}

/** How missions fared: often between hall and kitchen, once not into the bathroom, and never elsewhere. */
export function newDrives() {
  const day_us = 86_400e6;
  const now_us = Date.now() * 1000;
  const way = (from, to, driven, failed, ...ago) => {
    const [last_driven_us, last_failed_us] = ago.map((days) =>
      days === null ? null : now_us - days * day_us,
    );
    return { from, to, driven, failed, last_driven_us, last_failed_us };
  };
  const path = ['p1', 'p2', 'p3', 'p4', 'p5'];
  return [
    ...path.slice(1).map((place, i) => way(path[i], place, 12, 1, 2, 20)),
    ...path.slice(1).map((place, i) => way(place, path[i], 9, 0, 1, null)),
    way('p12', 'p13', 0, 1, null, 3),
  ];
}
