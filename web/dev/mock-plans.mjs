// SPDX-License-Identifier: Apache-2.0
// Drawn plans of the mock server. Any file that begins like an SVG or VRML is taken for the plan of its house.
import { Refusal } from './mock-refusal.mjs';

/** The house of mock-house.mjs in metres, x to the right and y up: its rooms as rectangles. */
const kScale_m = 15;
const kRooms = [
  [0.02, 0.42, 0.98, 0.58], // the corridor
  [0.24, 0.02, 0.44, 0.42],
  [0.56, 0.02, 0.76, 0.42],
  [0.4, 0.58, 0.6, 0.98],
];

/** Where a place of the graph is on the plan. */
const onPlan = ({ x, y }) => ({ x_m: round(kScale_m * x), y_m: round(kScale_m * (1 - y)) });
const round = (value) => Math.round(1000 * value) / 1000;

function segments() {
  return kRooms.flatMap(([left, top, right, bottom]) => {
    const [a, b, c, d] = [
      onPlan({ x: left, y: top }),
      onPlan({ x: right, y: top }),
      onPlan({ x: right, y: bottom }),
      onPlan({ x: left, y: bottom }),
    ];
    return [[a, b], [b, c], [c, d], [d, a]].map(([from, to]) => ({ x1_m: from.x_m, y1_m: from.y_m, x2_m: to.x_m, y2_m: to.y_m })); // prettier-ignore
  });
}

function findPlan(house, id) {
  const plan = house.plans.find((one) => one.id === id);
  if (!plan) throw new Refusal('not_found', 'There is no plan with this id.', `plans/${id}`);
  return plan;
}

const shown = (house, plan) => ({
  ...plan,
  maps: house.maps.filter((one) => one.plan?.id === plan.id).map((one) => one.id),
});

function versionOf(number, { user, body, query }) {
  const text = String(body);
  const line = text.split('\n').findIndex((one) => one.includes('broken'));
  if (line >= 0)
    throw new Refusal(
      'invalid_input',
      `The file is no drawing: line ${line + 1} says 'broken'.`,
      `body:${line + 1}`,
    );
  if (!/^(<svg|<\?xml|#VRML)/.test(text))
    throw new Refusal('unsupported_format', 'The file is no plan that is read here.', 'body:1');
  const ends = segments().flatMap((one) => [
    [one.x1_m, one.y1_m],
    [one.x2_m, one.y2_m],
  ]);
  const [xs, ys] = [ends.map(([x]) => x), ends.map(([, y]) => y)];
  return {
    version: number,
    format: query.get('format'),
    created_us: Date.now() * 1000,
    by: user.name,
    bytes: body.length,
    metres_per_unit: query.has('metres_per_unit') ? Number(query.get('metres_per_unit')) : null,
    up: query.get('up'),
    wall_height_m: Number(query.get('wall_height_m') ?? 2.5),
    lines: 4 * kRooms.length,
    triangles: 0,
    extent: {
      min_x_m: Math.min(...xs),
      min_y_m: Math.min(...ys),
      min_z_m: 0,
      max_x_m: Math.max(...xs),
      max_y_m: Math.max(...ys),
      max_z_m: 2.5,
    },
  };
}

function addPlan(house, request) {
  const plan = {
    id: house.newId('plan'),
    name: request.query.get('name'),
    created_us: Date.now() * 1000,
    maps: [],
    versions: [versionOf(1, request)],
  };
  house.plans.push(plan);
  return { status: 201, body: plan };
}

function addVersion(house, request) {
  const plan = findPlan(house, request.args[0]);
  plan.versions.push(versionOf(plan.versions.length + 1, request));
  return { status: 201, body: shown(house, plan) };
}

function removePlan(house, { args }) {
  const plan = shown(house, findPlan(house, args[0]));
  if (plan.maps.length > 0)
    throw new Refusal('conflict', `The map ${plan.maps[0]} is tied to this plan.`, `plans/${plan.id}`);
  house.plans = house.plans.filter((one) => one.id !== plan.id);
  return { status: 204 };
}

function linesOf(house, { args, query }) {
  const plan = findPlan(house, args[0]);
  const version = Number(query.get('version') ?? plan.versions.length);
  if (!plan.versions.some((one) => one.version === version))
    throw new Refusal('not_found', `The plan has no version ${version}.`, `plans/${plan.id}`);
  return { body: { plan: plan.id, version, total: 4 * kRooms.length, segments: segments() } };
}

/** As the mock has the house to scale, every place lies where it does, and a pin is off what it is beside that. */
function mapPlan(house, { args }) {
  const map = house.find('maps', args[0]);
  const tie = house.ties.get(map.id);
  if (!tie) throw new Refusal('not_found', 'The map is tied to no plan.', `maps/${map.id}`);
  const placeOf = (image) => house.graph.places.find((one) => one.members.includes(image))?.id ?? null;
  const pins = tie.pins.map((one) => ({ ...one, place: placeOf(one.image) }));
  const places = house.graph.places.map((one) => {
    const own = onPlan(one);
    const pin = pins.find(({ place }) => place === one.id);
    const residual_m = pin ? Math.hypot(pin.x_m - own.x_m, pin.y_m - own.y_m) : null;
    const at = pin ?? own;
    return { place: one.id, x_m: at.x_m, y_m: at.y_m, theta_rad: 0, pinned: pin !== undefined, residual_m };
  });
  const off = places.flatMap(({ residual_m }) => (residual_m === null ? [] : [residual_m ** 2]));
  const body = {
    map: map.id,
    revision: house.graph.revision,
    plan: tie.plan,
    version: tie.version,
    newest_version: findPlan(house, tie.plan).versions.length,
    tied_us: tie.tied_us,
    by: tie.by,
    pins,
    rms_m: off.length < 2 ? null : Math.sqrt(off.reduce((a, b) => a + b, 0) / off.length),
    places: off.length < 2 ? [] : places,
    unplaced: off.length < 2 ? places.map((one) => one.place) : [],
  };
  return { body };
}

function tieMap(house, { user, body, args }) {
  const map = house.find('maps', args[0]);
  const plan = findPlan(house, body.plan);
  if (body.pins.length < 2)
    throw new Refusal('invalid_input', 'Say of at least two places where they are on the plan.', 'body/pins');
  const pins = body.pins.map(({ place, image, x_m, y_m, theta_rad = null }, i) => {
    const found = house.graph.places.find((one) => one.id === place || one.members.includes(image));
    if (!found) throw new Refusal('unknown_place', `The map has no place ${place}.`, `body/pins/${i}/place`);
    return { image: image ?? found.prototype, x_m, y_m, theta_rad };
  });
  const [a, b] = pins;
  if (pins.length === 2 && Math.hypot(a.x_m - b.x_m, a.y_m - b.y_m) < 0.5)
    throw new Refusal(
      'invalid_input',
      'Two pins have to be on one part of the map, whose places ways join, and at least half a metre apart.',
      'body/pins',
    );
  const version = body.version ?? plan.versions.length;
  const tied_us = Date.now() * 1000;
  house.ties.set(map.id, { plan: plan.id, version, tied_us, by: user.name, pins });
  map.plan = { id: plan.id, version, tied_us };
  house.send('map', map);
  return mapPlan(house, { args });
}

function untieMap(house, { args }) {
  const map = house.find('maps', args[0]);
  house.ties.delete(map.id);
  map.plan = null;
  house.send('map', map);
  return { status: 204 };
}

/** Tells dashboards where the plan has the first robot: a spot and what is said of it; particles lie around it. */
export function tellOnPlan(house, { x_m, y_m, theta_rad, lost = null, word = 'silent' }) {
  const [robot] = house.robots;
  const map = house.find('maps', robot.map);
  const around_m = lost ? 3 : 0.3;
  const known = (value) => (lost ? null : value);
  const particles = Array.from({ length: 200 }, (_, i) => {
    const reach_m = around_m * Math.sqrt((i + 0.5) / 200);
    const turn = 2.4 * i;
    return {
      x_m: round(x_m + reach_m * Math.cos(turn)),
      y_m: round(y_m + reach_m * Math.sin(turn)),
      theta_rad: lost ? round((turn % 6.28) - 3.14) : theta_rad,
    };
  });
  const pose = {
    robot: robot.id,
    map: map.id,
    plan: map.plan.id,
    version: map.plan.version,
    tied_us: map.plan.tied_us,
    t_us: Date.now() * 1000,
    x_m: known(x_m),
    y_m: known(y_m),
    theta_rad: known(theta_rad),
    spread_m: known(0.12),
    lost,
    place: robot.belief?.place ?? null,
    word,
    lines_expected: 31,
    lines_confirmed: 24,
    particles,
  };
  house.tell({ type: 'plan_pose', v: 1, seq: (house.seq += 1), pose });
}

export const kPlanRoutes = [
  [/^GET plans$/, 'viewer', (house) => ({ body: { plans: house.plans.map((one) => shown(house, one)) } })],
  [/^POST plans$/, 'installer', addPlan],
  [/^GET plans\/([^/]+)$/, 'viewer', (house, { args }) => ({ body: shown(house, findPlan(house, args[0])) })],
  [/^DELETE plans\/([^/]+)$/, 'installer', removePlan],
  [
    /^PUT plans\/([^/]+)\/name$/,
    'installer',
    (house, { args, body }) => ({
      body: shown(house, Object.assign(findPlan(house, args[0]), { name: body.name })),
    }),
  ],
  [/^POST plans\/([^/]+)\/versions$/, 'installer', addVersion],
  [/^GET plans\/([^/]+)\/lines$/, 'viewer', linesOf],
  [/^GET maps\/([^/]+)\/plan$/, 'viewer', mapPlan],
  [/^PUT maps\/([^/]+)\/plan$/, 'installer', tieMap],
  [/^DELETE maps\/([^/]+)\/plan$/, 'installer', untieMap],
];
