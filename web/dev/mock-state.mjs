// SPDX-License-Identifier: Apache-2.0
// What the mock server knows and does: accounts, robots, leases, missions that progress, maps, tours, jobs.
import { steerDrafts } from './mock-drafts.mjs';
import { edit } from './mock-edits.mjs';
import { kJumpNote, kitchenNote, newDrives, newGraph, unnamedNote } from './mock-house.mjs';
import { kRoutes } from './mock-routes.mjs';
import { Refusal } from './mock-refusal.mjs';

const kRanks = ['viewer', 'rider', 'carer', 'installer', 'admin'];

export class House {
  /** step_ms: how long the robot takes from a place to the next. `waits`: having set out, it stays where it is until a test
   *  tells it to go on, so that no test has to be quicker than the robot. */
  constructor({ step_ms, fresh, waits = false }) {
    Object.assign(this, {
      step_ms,
      waits,
      goes_on: !waits,
      seq: 0,
      ids: 0,
      unreachable: false,
      silent: null, // while nothing is told or answered, what waits for the end of it
      sureness: 0.995, // of the next arrivals
      tell: () => undefined,
      dropClients: () => undefined,
    });
    this.users = fresh
      ? []
      : ['anna:admin', 'ben:rider', 'vera:viewer'].map((one) => this.newUser(...one.split(':'), 'homeward'));
    this.sessions = new Map();
    this.tokens = [];
    this.taught = newGraph('m1');
    this.graph = structuredClone(this.taught);
    this.edits = [];
    this.drives = newDrives();
    this.built = true; // on this server: there is a report of it, and how alike its pictures are
    this.drafts = []; // each with the log of its edits
    this.plans = [];
    this.ties = new Map(); // by map: the plan that it is tied to, and its pins
    const tour = {
      id: 't1',
      name: 'Ground floor',
      state: 'complete',
      images: 26,
      created_us: 1.7e15,
      missing: [],
    };
    this.sweeps = []; // as they came: of which tour and picture, and what was sent
    this.tours = fresh ? [] : [{ ...tour, camera: kCamera }];
    this.maps = fresh ? [] : [this.mapInfo('m1', 'Ground floor', 'ready', 1, ['t1'])];
    this.jobs = [];
    this.robots = fresh ? [] : [this.newRobot('Chair', 'm1')];
    this.timers = new Set();
    this.beat = setInterval(() => {
      this.robots.forEach((one) => one.online && this.tellRobot(one));
      this.tell({ type: 'heartbeat', v: 1, seq: (this.seq += 1) });
    }, 1000);
  }

  close() {
    this.beSilent(false);
    clearInterval(this.beat);
    for (const timer of this.timers) clearInterval(timer);
  }

  newId(kind) {
    return `${kind}${(this.ids += 1)}`;
  }
  newUser(name, role, password) {
    return { id: this.newId('u'), name, role, password };
  }
  mapInfo(id, name, state, revision, tours) {
    const made = state === 'ready';
    return {
      id,
      name,
      state,
      revision,
      places: made ? 13 : 0,
      images: made ? 26 : 0,
      tours,
      feature_config_id: null,
      refine: 'ask',
      plan: null,
    };
  }
  newRobot(name, map) {
    const belief = {
      updates: 40,
      place: 'p1',
      probability: 0.91,
      top: [
        { place: 'p1', probability: 0.91 },
        { place: 'p2', probability: 0.07 },
      ],
      lost: false,
    };
    return {
      id: this.newId('r'),
      name,
      online: map !== null,
      map,
      state: map ? 'idle' : null,
      belief: map ? belief : null,
      mission: null,
      question: null,
      lease: null,
      status_age_ms: map ? 120 : null,
    };
  }

  // ----- telling
  shown(robot) {
    const lease = robot.lease && robot.lease.until_ms > Date.now() ? robot.lease : null;
    return {
      ...robot,
      lease: lease && {
        holder: lease.holder,
        epoch: lease.epoch,
        expires_in_ms: lease.until_ms - Date.now(),
      },
    };
  }
  snapshot() {
    return {
      type: 'snapshot',
      v: 1,
      seq: this.seq,
      build: 'mock',
      robots: this.robots.map((one) => this.shown(one)),
      jobs: this.jobs,
      maps: this.maps,
    };
  }
  send(type, value) {
    this.tell({ type, v: 1, seq: (this.seq += 1), [type]: value });
  }
  tellRobot(robot) {
    this.send('robot', this.shown(robot));
  }

  // ----- accounts
  userOf(request) {
    const cookie = /homeward_session=([^;]+)/.exec(request.headers.cookie ?? '')?.[1];
    return this.sessions.get(cookie) ?? null;
  }
  shownUser({ id, name, role }) {
    return { id, name, role };
  }
  signedIn(user, status) {
    const key = `s${Math.random().toString(36).slice(2)}`;
    this.sessions.set(key, user);
    const cookie = `homeward_session=${key}; HttpOnly; SameSite=Strict; Path=/`;
    return { status, headers: { 'Set-Cookie': cookie }, body: { user: this.shownUser(user) } };
  }

  /** Answers one request: {status, headers, body}, {raw, headers} or {picture}; throws a Refusal. */
  async call(request, path, body, query = new URLSearchParams()) {
    const route = `${request.method} ${path.replace(/^\//, '')}`;
    if (route === 'GET setup') return { body: { needed: this.users.length === 0 } };
    if (route === 'POST setup') {
      if (body.token !== 'first' || this.users.length > 0)
        throw new Refusal('forbidden', 'This set-up link is not valid, or was used before.', 'token');
      this.users.push(this.newUser(body.name, 'admin', body.password));
      return this.signedIn(this.users[0], 201);
    }
    if (route === 'POST login') {
      const user = this.users.find((one) => one.name === body.name && one.password === body.password);
      if (!user) throw new Refusal('unauthenticated', 'The name or the password is wrong.', 'login');
      return this.signedIn(user, 200);
    }
    const { origin, host } = request.headers;
    if (request.method !== 'GET' && origin && origin !== `http://${host}`)
      throw new Refusal('forbidden', 'A change must come from a page of this server.', 'Origin');
    const user = this.userOf(request);
    const known = kRoutes.some(([pattern]) => pattern.test(route));
    if (known && !user)
      throw new Refusal('unauthenticated', 'Sign in, or send a token in the Authorization header.');
    for (const [pattern, role, handle] of kRoutes) {
      const found = pattern.exec(route);
      if (!found) continue;
      if (kRanks.indexOf(user.role) < kRanks.indexOf(role))
        throw new Refusal(
          'forbidden',
          `This needs the role ${role}; yours is ${user.role}.`,
          `/api/v1${path}`,
        );
      return handle(this, {
        user,
        body,
        query,
        headers: request.headers,
        args: found.slice(1).map(decodeURIComponent),
      });
    }
    throw new Refusal('not_found', `There is no /api/v1${path} here.`, `/api/v1${path}`);
  }

  /** One of the robots, maps, tours, jobs or tokens. */
  find(kind, id) {
    const found = this[kind].find((one) => one.id === id);
    const what = kind.slice(0, -1);
    const words = kind === 'robots' ? `There is no robot ${id}.` : `There is no ${what} with this id.`;
    if (!found) throw new Refusal('not_found', words, `${kind}/${id}`);
    return found;
  }

  // ----- driving
  drive(robot, mission) {
    robot.mission = { ...mission, state: 'accepted' };
    this.goes_on = !this.waits;
    this.tellRobot(robot);
    clearInterval(robot.timer);
    const timer = setInterval(() => this.step(robot), this.step_ms);
    Object.defineProperty(robot, 'timer', { value: timer, configurable: true, enumerable: false });
    this.timers.add(timer);
  }
  step(robot) {
    const { mission } = robot;
    if (mission.state === 'driving' && !this.goes_on) return;
    const at = mission.path[mission.path_index];
    robot.belief = {
      updates: 60,
      place: at,
      probability: 0.88,
      top: [{ place: at, probability: 0.88 }],
      lost: false,
    };
    const arrived = mission.state === 'driving' && mission.path_index >= mission.path.length - 1;
    robot.mission = arrived
      ? { ...this.ended(mission, 'arrived'), arrival_probability: this.sureness }
      : {
          ...mission,
          state: 'driving',
          reason: robot.mission.state === 'driving' ? null : mission.reason, // a moment for looking around
          path_index: Math.min(mission.path_index + 1, mission.path.length - 1),
        };
    robot.state = arrived ? 'arrived' : 'driving';
    if (arrived) clearInterval(robot.timer);
    this.tellRobot(robot);
  }
  /** Stands at the end of its way and asks whether this is it. */
  ask(robot) {
    const { mission } = robot;
    clearInterval(robot.timer);
    const label = this.graph.destinations.find((one) => one.id === mission.destination)?.label ?? '';
    robot.mission = {
      ...mission,
      state: 'driving',
      path_index: mission.path.length - 1,
      arrival_probability: 0.81,
    };
    robot.belief = { ...robot.belief, probability: 0.62 };
    robot.state = 'driving';
    robot.question = { number: this.ids + 1, place: mission.place, label, left_s: 60 };
    this.ids += 1;
    this.answers = [];
    this.tellRobot(robot);
  }
  hear(robot, here, by) {
    const { label } = robot.question;
    this.answers.push({ here, by });
    robot.question = null;
    robot.mission = here
      ? { ...this.ended(robot.mission, 'arrived'), arrival_probability: 0.97 }
      : this.ended(robot.mission, 'failed', {
          code: 'destination_denied',
          parameters: { destination: label },
        });
    robot.state = robot.mission.state;
    this.tellRobot(robot);
  }
  /** Somebody says where the robot is; with its next picture it believes it. */
  put(robot, place, by) {
    this.said = { place, by };
    robot.belief = null;
    this.tellRobot(robot);
    setTimeout(() => {
      const top = [{ place, probability: 0.72 }];
      robot.belief = { updates: 1, place, probability: 0.93, top, lost: false };
      this.tellRobot(robot);
    }, this.step_ms);
  }
  halt(robot, reason) {
    clearInterval(robot.timer);
    robot.question = null;
    if (robot.mission && ['accepted', 'driving'].includes(robot.mission.state))
      robot.mission = this.ended(robot.mission, 'stopped', reason);
    robot.state = 'stopped';
    this.tellRobot(robot);
  }
  ended(mission, state, reason = mission.reason) {
    return { ...mission, state, reason, ended_us: Date.now() * 1000 };
  }

  /** What drives would teach a map, waiting for a person. */
  offer(map) {
    const job = {
      id: this.newId('j'),
      kind: 'refine',
      map: map.id,
      state: 'offered',
      progress: { stage: 'places', share: 1 },
      error: null,
      skipped: 0,
      gained: 3,
      notes: [kitchenNote('place_would_gain'), unnamedNote('place_would_gain')],
      created_us: Date.now() * 1000,
    };
    this.jobs.push(job);
    this.send('job', job);
  }

  build(map, kind = 'build', tours = map.tours) {
    const job = {
      id: this.newId('j'),
      kind,
      map: map.id,
      state: 'running',
      progress: { stage: 'comparing pictures', share: 0 },
      error: null,
      skipped: 0,
      gained: 0,
      notes: [],
      created_us: Date.now() * 1000,
    };
    this.jobs.push(job);
    this.send('job', job);
    const timer = setInterval(() => {
      job.progress = { ...job.progress, share: Math.min(1, job.progress.share + 0.12) };
      const ended = job.state === 'cancelled' || job.progress.share >= 1;
      if (ended) {
        clearInterval(timer);
        if (job.state === 'running') job.state = 'done';
        if (job.state === 'done' && tours.includes('t1')) job.notes = [kJumpNote];
        Object.assign(
          map,
          this.mapInfo(map.id, map.name, job.state === 'done' ? 'ready' : 'failed', map.revision + 1, tours),
        );
        this.send('map', map);
      }
      this.send('job', job);
    }, 250);
    this.timers.add(timer);
    return job;
  }

  /** While the server is frozen, or the network loses all that is sent, connections stay open and nothing comes. What was
   *  asked meanwhile is answered afterwards. */
  beSilent(on) {
    this.silent?.end();
    this.silent = null;
    if (!on) return;
    this.silent = {};
    this.silent.over = new Promise((done) => (this.silent.end = done));
  }

  /** Orders of the tests: {do: "unreachable", on}, {do: "silent", on}, {do: "robot", set: {...}}, {do: "edit"},
   *  {do: "change", edits, by}, {do: "draft", edits, by, name}, {do: "draft_discard", draft},
   *  {do: "draft_edit", draft, version, edits, by}, {do: "hold", holder}, {do: "offer"}, {do: "halt", reason},
   *  {do: "go_on"}: the robot that waits drives to the end of its way; {do: "ask"}: the one that is under way stands and
   *  asks whether this is it. */
  steer(order) {
    const robot = this.robots[0];
    if (order.do === 'unreachable') {
      this.unreachable = order.on;
      if (order.on) this.dropClients();
    } else if (order.do === 'silent') {
      this.beSilent(order.on);
    } else if (order.do === 'robot') {
      Object.assign(robot, order.set);
      this.tellRobot(robot);
    } else if (order.do === 'edit') {
      // Another person's change that this browser has not heard of yet.
      this.graph.revision += 1;
    } else if (order.do === 'change') {
      // One that every browser hears of.
      const headers = { 'if-match': `"r${this.graph.revision}"` };
      const { edits, by } = order;
      edit(this, { user: { name: by }, headers, args: [this.maps[0].id], body: { edits } });
    } else if (order.do.startsWith('draft')) {
      steerDrafts(this, order);
    } else if (order.do === 'go_on') {
      this.goes_on = true;
    } else if (order.do === 'ask') {
      this.ask(robot);
    } else if (order.do === 'halt') {
      this.halt(robot, order.reason);
    } else if (order.do === 'offer') {
      this.offer(this.maps[0]);
    } else if (order.do === 'hold') {
      robot.lease = { id: 'other', holder: order.holder, epoch: 7, until_ms: Date.now() + 60_000 };
      this.tellRobot(robot);
    }
  }
}

export const kCamera = {
  format: 'homeward-camera',
  version: 1,
  model: 'equirectangular',
  width_px: 800,
  height_px: 400,
  robot_from_camera: { translation_m: [0, 0, 1.2], rotation_wxyz: [1, 0, 0, 0] },
};
