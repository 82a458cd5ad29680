// SPDX-License-Identifier: Apache-2.0
// The routes of the mock server: [method and path, least role, handler(house, {user, body, headers, args})].
import { kDoubtRoutes } from './mock-doubts.mjs';
import { kDraftRoutes } from './mock-drafts.mjs';
import { kExplorationRoutes } from './mock-exploration.mjs';
import { kFormerRoutes } from './mock-former.mjs';
import { edit, redo, undo } from './mock-edits.mjs';
import { kitchenNote, noWayText, wayBetween } from './mock-house.mjs';
import { Refusal } from './mock-refusal.mjs';
import { kPlanRoutes } from './mock-plans.mjs';
import { kReportRoutes } from './mock-report.mjs';
import { kSimilarityRoutes } from './mock-similarity.mjs';

const kLeaseMs = 10_000;

function leaseOf(robot) {
  return robot.lease && robot.lease.until_ms > Date.now() ? robot.lease : null;
}

const ofLease = (robot) => `robots/${robot.id}/lease`;

/** What is asked of a robot needs its lease. */
export function needLease(robot, lease_id) {
  const lease = leaseOf(robot);
  if (lease?.id === lease_id) return lease;
  const words = lease ? `${lease.holder} is driving.` : 'Take the lease first; this one is over.';
  throw new Refusal('lease_held', words, ofLease(robot));
}

/** The lease that is renewed or given back. */
function ownLease(robot, lease_id) {
  const lease = leaseOf(robot);
  if (lease?.id === lease_id) return lease;
  throw new Refusal('lease_held', 'This lease is over, or somebody else has taken it.', ofLease(robot));
}

function shownLease({ id, holder, epoch, until_ms }) {
  return { id, holder, epoch, expires_in_ms: until_ms - Date.now() };
}

function takeLease(house, { user, body, args }) {
  const robot = house.find('robots', args[0]);
  const now = leaseOf(robot);
  if (now && now.holder !== user.name && !body.take_over)
    throw new Refusal('lease_held', `${now.holder} is driving.`, ofLease(robot));
  const until_ms = Date.now() + kLeaseMs;
  // The same person again has the same one, in whichever window.
  if (now?.holder === user.name) now.until_ms = until_ms;
  else robot.lease = { id: house.newId('l'), holder: user.name, epoch: (now?.epoch ?? 0) + 1, until_ms };
  house.tellRobot(robot);
  return { body: { lease: shownLease(robot.lease) } };
}

function keepLease(house, { body, args }) {
  const lease = ownLease(house.find('robots', args[0]), body.lease_id);
  lease.until_ms = Date.now() + kLeaseMs;
  return { body: { lease: shownLease(lease) } };
}

function releaseLease(house, { body, args }) {
  const robot = house.find('robots', args[0]);
  ownLease(robot, body.lease_id);
  robot.lease = null;
  house.tellRobot(robot);
  return { status: 204 };
}

function startMission(house, { user, body, args }) {
  const robot = house.find('robots', args[0]);
  const lease = needLease(robot, body.lease_id);
  const where = `robots/${robot.id}`;
  if (!robot.online) throw new Refusal('robot_offline', 'The robot is not connected.', where);
  const from = robot.belief?.place ?? robot.belief?.top[0]?.place;
  if (!from) throw new Refusal('lost', 'The robot does not know where it is.', where);
  const destination = house.graph.destinations.find((one) => one.id === body.destination);
  const place = destination?.place ?? house.graph.places.find((one) => one.id === body.place)?.id;
  if (!place && body.destination)
    throw new Refusal(
      'unknown_place',
      `The map has no destination ${body.destination}.`,
      `maps/${robot.map}`,
    );
  if (!place) throw new Refusal('unknown_place', `The map has no place ${body.place}.`, 'to');
  const path = wayBetween(house.graph, from, place);
  if (!path) throw new Refusal('no_route', noWayText(house.graph, from, place), place);
  const mission = {
    format: 'homeward-mission',
    version: 2,
    id: house.newId('x'),
    robot: robot.id,
    kind: 'drive',
    exploration: null,
    map: robot.map,
    revision: house.graph.revision,
    destination: destination?.id ?? null,
    place,
    state: 'accepted',
    reason: robot.belief.lost ? { code: 'looks_around_first', parameters: {} } : null,
    epoch: lease.epoch,
    seq: 1,
    path,
    path_index: 0,
    arrival_probability: null,
    created_us: Date.now() * 1000,
    ended_us: null,
    by: user.name,
  };
  house.drive(robot, mission);
  return { status: 201, body: mission };
}

function answer(house, { user, body, args }) {
  const robot = house.find('robots', args[0]);
  const where = `missions/${args[1]}`;
  if (robot.mission?.id !== args[1])
    throw new Refusal('not_found', 'There is no mission with this id.', where);
  needLease(robot, body.lease_id);
  if (robot.question?.number !== body.question)
    throw new Refusal('conflict', 'The robot asks nothing on this mission now.', where);
  house.hear(robot, body.here, user.name);
  return { status: 202, body: robot.mission };
}

function stop(house, { user, args }) {
  const robot = house.find('robots', args[0]);
  setTimeout(() => house.halt(robot, { code: 'stopped_by', parameters: { by: user.name } }), 200);
  return { status: 202, body: { stop_id: house.newId('s') } };
}

function addTour(house, { body }) {
  if (body.camera?.format !== 'homeward-camera')
    throw new Refusal(
      'unsupported_format',
      `The format is '${body.camera?.format}'; 'homeward-camera' is wanted.`,
      'body/camera/format',
    );
  const tour = {
    id: house.newId('t'),
    name: body.name,
    state: 'open',
    images: 0,
    camera: body.camera,
    created_us: Date.now() * 1000,
    missing: [],
  };
  house.tours.push(tour);
  return { status: 201, body: tour };
}

function putImage(house, { body, args }) {
  const tour = house.find('tours', args[0]);
  if (body.length === 0)
    throw new Refusal('unsupported_image', 'The body is empty; it has to be a JPEG or PNG picture.', 'body');
  tour.images = Math.max(tour.images, Number(args[1]) + 1);
  return { status: 201, body: {} };
}

function putSweep(house, { body, args }) {
  const tour = house.find('tours', args[0]);
  if (Number(args[1]) >= tour.images)
    throw new Refusal('not_found', 'There is no such image.', `tours/${tour.id}/images/${args[1]}`);
  house.sweeps.push({ tour: tour.id, n: Number(args[1]), ...body });
  return { status: 204 };
}

function complete(house, { args }) {
  const tour = house.find('tours', args[0]);
  if (tour.images < 3)
    throw new Refusal(
      'conflict',
      `The tour has ${tour.images} picture${tour.images === 1 ? '' : 's'}; a map needs at least 3.`,
      `tours/${tour.id}`,
    );
  tour.state = 'complete';
  return { body: tour };
}

function addMap(house, { body }) {
  const map = house.mapInfo(house.newId('m'), body.name, 'building', 0, body.tours);
  house.maps.push(map);
  house.send('map', map);
  return { status: 202, body: { map, job: house.build(map) } };
}

function addToMap(house, { body, args }) {
  const map = house.find('maps', args[0]);
  const more = (body.tours ?? []).filter((one) => !map.tours.includes(one));
  return { status: 202, body: { job: house.build(map, body.kind ?? 'build', [...map.tours, ...more]) } };
}

function setRefine(house, { body, args }) {
  const map = Object.assign(house.find('maps', args[0]), { refine: body.refine });
  house.send('map', map);
  return { body: map };
}

function takeJob(house, { args }) {
  const job = house.find('jobs', args[0]);
  if (job.state !== 'offered')
    throw new Refusal('conflict', `The job offers nothing: it is ${job.state}.`, `jobs/${job.id}`);
  Object.assign(job, { state: 'done', notes: [kitchenNote('place_gained')] });
  house.send('job', job);
  return { status: 202, body: job };
}

function cancelJob(house, { args }) {
  const job = Object.assign(house.find('jobs', args[0]), { state: 'cancelled' });
  house.send('job', job);
  return { status: 202, body: job };
}

function addRobot(house, { body }) {
  const robot = house.newRobot(body.name, null);
  house.robots.push(robot);
  house.tellRobot(robot);
  return { status: 201, body: { id: robot.id, name: robot.name, token: 'hw_rb_8fK2nQx7vLw93mTzYb4cRj6P' } };
}

function setMap(house, { body, args }) {
  const robot = house.find('robots', args[0]);
  if (body.map !== null) house.find('maps', body.map);
  robot.map = body.map;
  house.tellRobot(robot);
  return { body: house.shown(robot) };
}

function setPlace(house, { user, body, args }) {
  const robot = house.find('robots', args[0]);
  const where = `robots/${robot.id}`;
  if (robot.map === null) throw new Refusal('conflict', 'The robot has no map to be on.', where);
  if (['accepted', 'driving'].includes(robot.mission?.state))
    throw new Refusal('conflict', 'The robot is on its way; stop it first.', where);
  if (!robot.online) throw new Refusal('robot_offline', 'The robot is not connected.', where);
  const { destinations, places } = house.graph;
  const place =
    body.label === undefined
      ? places.find((one) => one.id === body.place)?.id
      : (destinations.find((one) => one.label === body.label)?.place ??
        places.find((one) => one.label === body.label)?.id);
  if (!place)
    throw new Refusal(
      'unknown_place',
      body.label === undefined
        ? `The map has no place ${body.place}.`
        : `The map has no place called '${body.label}'.`,
      `maps/${robot.map}`,
    );
  house.put(robot, place, user.name);
  return { body: house.shown(robot) };
}

function addUser(house, { body }) {
  if (house.users.some((one) => one.name === body.name))
    throw new Refusal('conflict', `There is already a person called '${body.name}'.`, 'name');
  if (body.password.length < 8)
    throw new Refusal('invalid_input', 'A password has at least 8 characters and at most 1000.', 'password');
  const user = house.newUser(body.name, body.role, body.password);
  house.users.push(user);
  return { status: 201, body: house.shownUser(user) };
}

function addToken(house, { body }) {
  const token = {
    id: house.newId('k'),
    name: body.name,
    role: body.role,
    robot: body.robot ?? null,
    created_us: Date.now() * 1000,
  };
  house.tokens.push(token);
  return { status: 201, body: { id: token.id, token: 'hw_3qPd8sVt0aHn5GyXk1Bf' } };
}

function graphOf(house, { args }) {
  const map = house.find('maps', args[0]);
  if (map.state !== 'ready')
    throw new Refusal('conflict', 'The map has not been built yet.', `maps/${map.id}`);
  return { body: { ...house.graph, map: map.id }, headers: { ETag: `"r${house.graph.revision}"` } };
}

function remove(house, kind, id) {
  house.find(kind, id);
  house[kind] = house[kind].filter((one) => one.id !== id);
  return { status: 204 };
}

function frameOf(house, { args }) {
  const robot = house.find('robots', args[0]);
  if (!robot.belief)
    throw new Refusal('not_found', 'The robot has sent no picture yet.', `robots/${robot.id}/frame`);
  return { picture: robot.belief.place ?? 'p2' };
}

function thumbnailOf(house, { args }) {
  const map = house.find('maps', args[0]);
  if (!house.graph.places.some((one) => one.id === args[1]))
    throw new Refusal('unknown_place', `The map has no place ${args[1]}.`, `maps/${map.id}`);
  return { picture: args[1] };
}

/** What is told of a map that is there. */
const ofMap =
  (told) =>
  (house, { args }) => (house.find('maps', args[0]), { body: told(house) });

export const kRoutes = [
  [
    /^POST logout$/,
    'viewer',
    () => ({ status: 204, headers: { 'Set-Cookie': 'homeward_session=; Max-Age=0; Path=/' } }),
  ],
  [/^GET me$/, 'viewer', (house, { user }) => ({ body: { user: house.shownUser(user) } })],
  [/^GET users$/, 'admin', (house) => ({ body: { users: house.users.map((one) => house.shownUser(one)) } })],
  [/^POST users$/, 'admin', addUser],
  [/^GET tokens$/, 'installer', (house) => ({ body: { tokens: house.tokens } })],
  [/^POST tokens$/, 'installer', addToken],
  [/^DELETE tokens\/([^/]+)$/, 'installer', (house, { args }) => remove(house, 'tokens', args[0])],
  [/^GET robots$/, 'viewer', (house) => ({ body: { robots: house.robots.map((one) => house.shown(one)) } })],
  [/^POST robots$/, 'installer', addRobot],
  [/^PUT robots\/([^/]+)\/map$/, 'installer', setMap],
  [/^PUT robots\/([^/]+)\/place$/, 'rider', setPlace],
  [/^POST robots\/([^/]+)\/lease$/, 'rider', takeLease],
  [/^PUT robots\/([^/]+)\/lease$/, 'rider', keepLease],
  [/^DELETE robots\/([^/]+)\/lease$/, 'rider', releaseLease],
  [/^POST robots\/([^/]+)\/missions$/, 'rider', startMission],
  [/^POST robots\/([^/]+)\/missions\/([^/]+)\/answer$/, 'rider', answer],
  [/^POST robots\/([^/]+)\/stop$/, 'viewer', stop],
  [/^GET robots\/([^/]+)\/frame$/, 'viewer', frameOf],
  [/^GET maps$/, 'viewer', (house) => ({ body: { maps: house.maps } })],
  [/^POST maps$/, 'installer', addMap],
  [/^DELETE maps\/([^/]+)$/, 'installer', (house, { args }) => remove(house, 'maps', args[0])],
  [/^POST maps\/([^/]+)\/builds$/, 'installer', addToMap],
  [/^PUT maps\/([^/]+)\/refine$/, 'installer', setRefine],
  [/^GET maps\/([^/]+)\/graph$/, 'viewer', graphOf],
  [/^GET maps\/([^/]+)\/ways$/, 'viewer', ofMap((house) => ({ ways: house.drives }))],
  [/^GET maps\/([^/]+)\/history$/, 'viewer', ofMap((house) => ({ edits: house.edits }))],
  [/^GET maps\/([^/]+)\/places\/([^/]+)\/thumbnail$/, 'viewer', thumbnailOf],
  [
    /^GET maps\/[^/]+\/images\/[^/]+\/(p\d+)b?\.jpg\/thumbnail$/,
    'viewer',
    (_, { args }) => ({ picture: args[0] }),
  ],
  [/^POST maps\/([^/]+)\/edits$/, 'installer', edit],
  [/^POST maps\/([^/]+)\/undo$/, 'installer', undo],
  [/^POST maps\/([^/]+)\/redo$/, 'installer', redo],
  ...kExplorationRoutes,
  ...kDraftRoutes,
  ...kDoubtRoutes,
  ...kPlanRoutes,
  ...kFormerRoutes,
  ...kReportRoutes,
  ...kSimilarityRoutes,
  [/^GET tours$/, 'viewer', (house) => ({ body: { tours: house.tours } })],
  [/^GET tours\/([^/]+)$/, 'viewer', (house, { args }) => ({ body: house.find('tours', args[0]) })],
  [/^POST tours$/, 'installer', addTour],
  [/^PUT tours\/([^/]+)\/images\/(\d+)$/, 'installer', putImage],
  [/^PUT tours\/([^/]+)\/images\/(\d+)\/sweep$/, 'installer', putSweep],
  [/^PUT tours\/([^/]+)\/marks$/, 'installer', (_, { body }) => ({ body })],
  [/^POST tours\/([^/]+)\/complete$/, 'installer', complete],
  [/^POST jobs\/([^/]+)\/take$/, 'installer', takeJob],
  [/^POST jobs\/([^/]+)\/cancel$/, 'installer', cancelJob],
];
