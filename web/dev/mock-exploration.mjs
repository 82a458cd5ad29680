// SPDX-License-Identifier: Apache-2.0
// A robot of the mock server that maps a small made-up house by itself: its report grows with each step.
import { needLease } from './mock-routes.mjs';
import { Refusal } from './mock-refusal.mjs';
import { kCamera } from './mock-state.mjs';

const kCell_m = 0.1;
const kCorner = [-2.5, -4]; // of the house, in the frame in which the robot begins at the origin
const kSize = [140, 100]; // cells
const kReach_m = 3.2; // of the laser
const kCover_m = 1.1; // around a picture
const kStands = 12; // pictures after which a robot that waits for its test goes no further; tests may set `stands` of the house

/** Walls and furniture in metres: left, bottom, right, top. */
const kThings = [
  ...[
    [-2.2, -3.8, 11.2, -3.6],
    [-2.2, 5.6, 11.2, 5.8],
    [-2.2, -3.8, -2, 5.8],
    [11, -3.8, 11.2, 5.8],
  ],
  ...[
    [-2, -1.2, 1.2, -1.1],
    [2.2, -1.2, 7.2, -1.1],
    [8.2, -1.2, 11, -1.1],
    [4.6, -3.6, 4.7, -1.1],
  ],
  ...[
    [-2, 1.2, 2.6, 1.3],
    [3.7, 1.2, 8.8, 1.3],
    [9.9, 1.2, 11, 1.3],
    [6.2, 1.3, 6.3, 5.6],
  ],
  ...[
    [-1.2, -3.2, 0.6, -2.4],
    [0.4, 3.4, 2, 4.4],
    [9.6, 4, 11, 5.6],
    [8.8, -3.6, 9.6, -3],
  ],
];

/** The corners of the robot's way; it comes back to where it began. */
const kWay = [
  [0, 0],
  [1.7, 0],
  [1.7, -2.6],
  [3.6, -2.6],
  [1.7, -2.4],
  [1.8, 0.1],
  [3.1, 0],
  [3.1, 2.6],
  [5.2, 3.4],
  [4.6, 4.8],
  [3.2, 3],
  [3.2, 0.2],
  [7.7, 0],
  [7.7, -2.4],
  [6, -2.6],
  [7.6, -2.2],
  [7.8, 0.1],
  [9.4, 0.1],
  [9.3, 2.6],
  [7.4, 4.2],
  [9.3, 2.4],
  [9.2, 0],
  [4, 0.1],
  [0.2, 0.1],
];

function stops() {
  const way = [kWay[0]];
  for (const [x, y] of kWay.slice(1)) {
    const [fromX, fromY] = way.at(-1);
    const parts = Math.max(1, Math.round(Math.hypot(x - fromX, y - fromY) / 0.75));
    for (let n = 1; n <= parts; n += 1)
      way.push([fromX + ((x - fromX) * n) / parts, fromY + ((y - fromY) * n) / parts]);
  }
  return way;
}
const kStops = stops();

const cellOf = ([x, y]) => [
  Math.floor((x - kCorner[0]) / kCell_m + 1e-6),
  Math.floor((y - kCorner[1]) / kCell_m + 1e-6),
];
const isThing = (x, y) => kThings.some(([l, b, r, t]) => x >= l && x < r && y >= b && y < t);

/** What the laser sees from a point, and what a picture there covers. */
function look(cells, [x, y]) {
  for (let n = 0; n < 720; n += 1) {
    const [dx, dy] = [Math.cos((n * Math.PI) / 360), Math.sin((n * Math.PI) / 360)];
    for (let far = 0; far < kReach_m; far += kCell_m / 2) {
      const at = [x + far * dx, y + far * dy];
      const [column, row] = cellOf(at);
      const cell = row * kSize[0] + column;
      const thing = isThing(...[column, row].map((n, axis) => kCorner[axis] + (n + 0.5) * kCell_m));
      cells[cell] = thing ? 2 : far < kCover_m ? 3 : Math.max(cells[cell], 1);
      if (thing) break;
    }
  }
}

function runsOf(cells) {
  const runs = [];
  for (let from = 0, to = 1; to <= cells.length; to += 1)
    if (to === cells.length || cells[to] !== cells[from]) {
      runs.push(4 * (to - from) + cells[from]);
      from = to;
    }
  return runs;
}

const explorations = new WeakMap(); // of each robot: the report, what it saw, and its timer

function begin(house, robot) {
  clearInterval(explorations.get(robot)?.timer);
  const report = {
    id: house.newId('e'),
    phase: 'exploring',
    reason: null,
    pictures: 0,
    driven_m: 0,
    explored_s: 0,
    unreached: 0,
    pose: { x_m: 0, y_m: 0, theta_rad: 0 },
    target: null,
    nodes: [],
    loops: [],
    floor: null,
    fences: [],
    uploaded: 0,
    tour: null,
    companion: null,
  };
  const one = { report, cells: new Uint8Array(kSize[0] * kSize[1]), timer: null };
  one.timer = setInterval(() => step(house, robot, one), house.step_ms);
  house.timers.add(one.timer);
  explorations.set(robot, one);
  return one;
}

function tell(house, robot, { report }) {
  house.tell({
    type: 'exploration',
    v: 1,
    seq: (house.seq += 1),
    robot: robot.id,
    exploration: structuredClone(report),
  });
}

/** The robot whose exploration a report names as the one that it is shared with. */
const companionOf = (house, { companion }) =>
  house.robots.find((one) => companion && explorations.get(one)?.report.id === companion.exploration);

/** What two that name each other and are connected hear of each other; with four pictures of each they find a place that
 *  both have seen. */
function hear(house, report) {
  const other = companionOf(house, report);
  const theirs = other?.online ? explorations.get(other).report : null;
  if (theirs?.companion?.exploration !== report.id) return;
  report.companion.pictures = theirs.pictures;
  report.companion.joined ||= Math.min(report.pictures, theirs.pictures) >= 4;
}

const isUnderWay = ({ mission }) =>
  mission?.kind === 'explore' && ['accepted', 'driving'].includes(mission.state);

function step(house, robot, one) {
  const { report } = one;
  if (report.phase === 'ended') return upload(house, robot, one);
  if (!robot.online) return;
  if (report.companion) hear(house, report);
  if (report.phase !== 'exploring') return report.companion ? tell(house, robot, one) : undefined;
  if (!isUnderWay(robot))
    Object.assign(report, { phase: 'paused', reason: robot.mission.reason, target: null });
  else if (!(robot.lease?.until_ms > Date.now()))
    house.halt(robot, { code: 'nobody_watching', parameters: {} });
  else if (house.goes_on || report.pictures < (house.stands ?? kStands)) drive(house, robot, one);
  tell(house, robot, one);
}

function drive(house, robot, { report, cells, limits }) {
  const [x, y] = kStops[report.pictures];
  const before = report.nodes.at(-1) ?? [0, 0];
  const next = kStops[report.pictures + 1] ?? null;
  const [toX, toY] = next ?? [x + 1, y];
  report.nodes.push([x, y]);
  report.pictures += 1;
  report.driven_m += Math.hypot(x - before[0], y - before[1]);
  report.explored_s += 6;
  report.pose = { x_m: x, y_m: y, theta_rad: Math.atan2(toY - y, toX - x) };
  report.target = next;
  report.unreached = report.pictures > 30 ? 1 : 0;
  const known = report.nodes.findIndex(
    (node, n) => n < report.pictures - 6 && Math.hypot(node[0] - x, node[1] - y) < 0.3,
  );
  if (known >= 0) report.loops.push([report.pictures - 1, known]);
  look(cells, [x, y]);
  report.floor = { cell_m: kCell_m, x_m: kCorner[0], y_m: kCorner[1], columns: kSize[0], rows: kSize[1] };
  report.floor.runs = runsOf(cells);
  robot.state = 'driving';
  robot.mission = { ...robot.mission, state: 'driving' };
  const { limit_m = Infinity, limit_s = Infinity } = limits;
  const full = report.driven_m >= limit_m || report.explored_s >= limit_s;
  if (next && !full) return house.tellRobot(robot);
  report.phase = 'ended';
  report.reason = full
    ? { code: 'exploration_limit', parameters: {} }
    : { code: 'exploration_unreached', parameters: { places: 1 } };
  report.target = null;
  robot.state = 'arrived';
  robot.mission = house.ended(robot.mission, 'arrived', report.reason);
  house.tellRobot(robot);
}

function upload(house, robot, one) {
  const { report, timer } = one;
  report.uploaded = Math.min(1, report.uploaded + 0.2);
  if (report.uploaded >= 1) {
    const tour = {
      id: house.newId('t'),
      name: `Explored by ${robot.name}`,
      state: 'complete',
      images: report.pictures,
      camera: kCamera,
      created_us: Date.now() * 1000,
      missing: [],
    };
    house.tours.push(tour);
    Object.assign(report, { phase: 'uploaded', tour: tour.id });
    clearInterval(timer);
  }
  tell(house, robot, one);
}

/** A robot that somebody may order about now. */
function ordered(house, { body, args }) {
  const robot = house.find('robots', args[0]);
  const lease = needLease(robot, body.lease_id);
  if (!robot.online) throw new Refusal('robot_offline', 'The robot is not connected.', `robots/${robot.id}`);
  return { robot, lease };
}

function explore(house, call) {
  const { robot, lease } = ordered(house, call);
  const { exploration, limit_m, limit_s } = call.body;
  const had = explorations.get(robot);
  if (exploration !== undefined && (exploration !== had?.report.id || had.report.phase !== 'paused'))
    throw new Refusal(
      'conflict',
      'This robot has no such exploration to go on with.',
      `robots/${robot.id}/exploration`,
    );
  if (exploration === undefined) house.goes_on = !house.waits;
  const one = exploration === undefined ? begin(house, robot) : had;
  one.limits = { limit_m, limit_s };
  const mission = {
    format: 'homeward-mission',
    version: 2,
    id: house.newId('x'),
    robot: robot.id,
    kind: 'explore',
    exploration: one.report.id,
    map: null,
    revision: 0,
    destination: null,
    place: null,
    state: 'accepted',
    reason: null,
    epoch: lease.epoch,
    seq: 1,
    path: [],
    path_index: 0,
    arrival_probability: null,
    created_us: Date.now() * 1000,
    ended_us: null,
    by: call.user.name,
  };
  robot.mission = mission;
  Object.assign(one.report, { phase: 'exploring', reason: null });
  house.tellRobot(robot);
  return { status: 201, body: mission };
}

function explorationOf(house, { args }) {
  const robot = house.find('robots', args[0]);
  return { body: toldOf(robot).report };
}

/** What a robot has told of since it connected. */
function toldOf(robot) {
  const one = explorations.get(robot);
  if (!one || !robot.online)
    throw new Refusal('not_found', 'The robot has told of no exploration.', `robots/${robot.id}/exploration`);
  return one;
}

/** The robot hears of it, obeys, and says so a moment later. */
function obey(house, robot, one, change) {
  setTimeout(() => {
    change(one.report);
    tell(house, robot, one);
  }, 150);
  return { status: 202 };
}

function setFences(house, call) {
  const { robot } = ordered(house, call);
  const one = toldOf(robot);
  one.report.fences = call.body.fences;
  return obey(house, robot, one, () => undefined);
}

/** The exploration of a robot that can be shared. */
function shareable(robot) {
  const cannot = (why) => new Refusal('conflict', `${robot.name} ${why}`, `robots/${robot.id}/exploration`);
  if (!robot.online) throw cannot('is not connected, so its exploration cannot be shared.');
  const one = explorations.get(robot);
  if (!one) throw cannot('has no exploration that could be shared.');
  if (isUnderWay(robot) && robot.mission.exploration !== one.report.id)
    throw cannot('has not told of its exploration yet; try again in a moment.');
  if (['ended', 'uploaded'].includes(one.report.phase))
    throw cannot('has ended its exploration; there is nothing to share any more.');
  return one;
}

function setCompanion(house, call) {
  const robot = house.find('robots', call.args[0]);
  const { robot: other } = call.body;
  if (other === robot.id)
    throw new Refusal('invalid_input', 'A robot cannot share its exploration with itself.', 'body/robot');
  const exploration = other === null ? null : shareable(house.find('robots', other)).report.id;
  ordered(house, call);
  return obey(house, robot, shareable(robot), (report) => {
    if (report.companion?.exploration === exploration) return;
    report.companion = exploration && { exploration, joined: false, pictures: 0 };
  });
}

function finish(house, call) {
  const { robot } = ordered(house, call);
  const one = toldOf(robot);
  if (isUnderWay(robot))
    throw new Refusal(
      'conflict',
      'The robot explores just now; stop it first.',
      `robots/${robot.id}/exploration`,
    );
  if (one.report.phase === 'paused')
    Object.assign(one.report, {
      phase: 'ended',
      reason: { code: 'exploration_ended_by_hand', parameters: {} },
    });
  return { status: 202 };
}

export const kExplorationRoutes = [
  [/^POST robots\/([^/]+)\/explorations$/, 'installer', explore],
  [/^GET robots\/([^/]+)\/exploration$/, 'viewer', explorationOf],
  [/^PUT robots\/([^/]+)\/exploration\/fences$/, 'installer', setFences],
  [/^PUT robots\/([^/]+)\/exploration\/companion$/, 'installer', setCompanion],
  [/^POST robots\/([^/]+)\/exploration\/finish$/, 'installer', finish],
];
