// SPDX-License-Identifier: Apache-2.0
// What the mock server says must be what the contract allows, or tests against it mean nothing.
import { readdirSync, readFileSync } from 'node:fs';
import Ajv from 'ajv';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { WebSocket } from 'ws';
import { tellOnPlan } from './mock-plans.mjs';
import { startMock } from './mock-server.mjs';

const folder = new URL('../../proto/schemas/', import.meta.url);
const ajv = new Ajv({ allErrors: true, strict: false });
for (const name of readdirSync(folder))
  ajv.addSchema(JSON.parse(readFileSync(new URL(name, folder), 'utf8')), name);

function problemsOf(schema, value) {
  const validate = ajv.getSchema(`${schema}.schema.json`);
  if (!validate) return [`there is no schema ${schema}`];
  return validate(value) ? [] : validate.errors.map((one) => `${schema}${one.instancePath} ${one.message}`);
}

let mock;
let cookie;
const ask = async (method, path, body, headers = {}) => {
  const answer = await fetch(`${mock.url}/api/v1/${path}`, {
    method,
    headers: { cookie, 'Content-Type': 'application/json', ...headers },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
  return {
    status: answer.status,
    headers: answer.headers,
    body: answer.headers.get('content-type')?.includes('json')
      ? JSON.parse((await answer.text()) || 'null')
      : null,
  };
};

beforeAll(async () => {
  mock = await startMock({ port: 0, step_ms: 20 });
  const answer = await ask('POST', 'login', { name: 'anna', password: 'homeward' }, { cookie: '' });
  cookie = answer.headers.get('set-cookie').split(';')[0];
});
afterAll(() => mock.close());

describe('the mock server', () => {
  it('answers as the schemas say', async () => {
    const { body: graph } = await ask('GET', 'maps/m1/graph');
    expect(problemsOf('graph', graph)).toEqual([]);
    const { body: robots } = await ask('GET', 'robots');
    const [robot] = robots.robots;
    expect(problemsOf('robot', robot)).toEqual([]);
    const { body: maps } = await ask('GET', 'maps');
    expect(maps.maps.flatMap((one) => problemsOf('map_info', one))).toEqual([]);
    const { body: tours } = await ask('GET', 'tours');
    expect(tours.tours.flatMap((one) => problemsOf('tour_info', one))).toEqual([]);
    const { body: taken } = await ask('POST', `robots/${robot.id}/lease`, {});
    expect(problemsOf('lease', taken.lease)).toEqual([]);
    const { body: mission } = await ask('POST', `robots/${robot.id}/missions`, {
      lease_id: taken.lease.id,
      destination: 'kitchen',
    });
    expect(problemsOf('mission', mission)).toEqual([]);
    mock.house.steer({ do: 'ask' });
    const asking = (await ask('GET', 'robots')).body.robots[0];
    expect([asking.question.label, problemsOf('robot', asking)]).toEqual(['kitchen', []]);
    const answer = { lease_id: taken.lease.id, question: asking.question.number, here: true };
    const answered = await ask('POST', `robots/${robot.id}/missions/${mission.id}/answer`, answer);
    expect([answered.status, problemsOf('mission', answered.body)]).toEqual([202, []]);
    const late = await ask('POST', `robots/${robot.id}/missions/${mission.id}/answer`, answer);
    expect([late.status, late.body.code]).toEqual([409, 'conflict']);
    const put = await ask('PUT', `robots/${robot.id}/place`, { label: 'kitchen' });
    expect([put.status, put.body.belief, problemsOf('robot', put.body)]).toEqual([200, null, []]);
    const nowhere = await ask('PUT', `robots/${robot.id}/place`, { label: 'cellar' });
    expect([nowhere.status, nowhere.body.code]).toEqual([404, 'unknown_place']);
    const refused = await ask('GET', 'maps/none/graph');
    expect([refused.status, problemsOf('problem', refused.body)]).toEqual([404, []]);
    const { body: built } = await ask('POST', 'maps', { name: 'second', tours: ['t1'] });
    expect([...problemsOf('job', built.job), ...problemsOf('map_info', built.map)]).toEqual([]);
    const { body: added } = await ask('POST', 'maps/m1/builds', { kind: 'add', tours: ['t1'] });
    expect(problemsOf('job', added.job)).toEqual([]);
    const { body: set } = await ask('PUT', 'maps/m1/refine', { refine: 'auto' });
    expect(problemsOf('map_info', set)).toEqual([]);
  });

  it('takes a request of several edits for one change, back and forth', async () => {
    const root = 'maps/m1';
    let { revision } = (await ask('GET', `${root}/graph`)).body;
    const change = (path, body) => ask('POST', `${root}/${path}`, body, { 'If-Match': `"r${revision}"` });
    const blocked = async () =>
      (await ask('GET', `${root}/graph`)).body.edges.filter((one) => one.blocked).length;
    const nothing = await change('undo');
    expect([nothing.status, nothing.body.code]).toEqual([404, 'not_found']);
    const edits = [
      { kind: 'block_edge', from: 'p4', to: 'p5', blocked: true },
      { kind: 'block_edge', from: 'p5', to: 'p4', blocked: true },
    ];
    ({ revision } = (await change('edits', { edits })).body);
    expect([await blocked(), (await ask('POST', `${root}/undo`)).status]).toEqual([2, 428]);
    ({ revision } = (await change('undo')).body);
    const { body: history } = await ask('GET', `${root}/history`);
    expect(history.edits.map((one) => [one.change, one.undone, one.redoable])).toEqual([
      [1, true, true],
      [1, true, true],
    ]);
    expect(await blocked()).toBe(0);
    ({ revision } = (await change('redo')).body);
    expect([await blocked(), (await change('redo')).body.code]).toEqual([2, 'not_found']);
    ({ revision } = (await change('undo')).body);
    const stale = await ask('POST', `${root}/redo`, undefined, { 'If-Match': '"r1"' });
    expect([stale.status, stale.body.code]).toEqual([412, 'stale_revision']);
    const nowhere = await change('edits', {
      edits: [{ kind: 'block_edge', from: 'p1', to: 'p9', blocked: true }],
    });
    expect([nowhere.status, nowhere.body.code]).toEqual([404, 'not_found']);
  });

  it('answers of drafts as the schemas say', async () => {
    const root = 'maps/m1/drafts';
    const { body: draft, headers } = await ask('POST', root, { name: 'night' });
    expect([headers.get('etag'), problemsOf('draft', draft)]).toEqual(['"d1"', []]);
    const edits = [{ kind: 'delete', place: 'p12' }];
    const path = `${root}/${draft.id}`;
    expect((await ask('POST', `${path}/edits`, { edits })).status).toBe(428);
    const version = { 'If-Match': headers.get('etag') };
    const { body: edited } = await ask('POST', `${path}/edits`, { edits }, version);
    expect([edited.version, edited.touches.includes('p12'), problemsOf('draft', edited)]).toEqual([
      2,
      true,
      [],
    ]);
    expect((await ask('POST', `${path}/edits`, { edits }, version)).body.code).toBe('stale_revision');
    expect(problemsOf('graph', (await ask('GET', `${path}/graph`)).body)).toEqual([]);
    expect(problemsOf('difference', (await ask('GET', `${path}/difference`)).body)).toEqual([]);
    expect((await ask('GET', `${path}/check`)).status).toBe(404);
    const { body: checking } = await ask('POST', `${path}/check`);
    expect(problemsOf('job', checking.job)).toEqual([]);
    await expect.poll(async () => (await ask('GET', `${path}/check`)).status, { timeout: 5000 }).toBe(200);
    expect(problemsOf('replay_check', (await ask('GET', `${path}/check`)).body)).toEqual([]);
    expect((await ask('DELETE', path)).status).toBe(204);
  });

  it('answers of plans as the schemas say', async () => {
    const upload = (path, text, more = '') =>
      fetch(`${mock.url}/api/v1/${path}?format=svg${more}`, {
        method: 'POST',
        headers: { cookie },
        body: text,
      });
    const broken = await upload('plans', '<svg>\nbroken', '&name=x');
    expect([broken.status, problemsOf('problem', await broken.json())]).toEqual([422, []]);
    const plan = await (await upload('plans', '<svg/>', '&name=Ground')).json();
    expect([plan.name, problemsOf('plan_info', plan)]).toEqual(['Ground', []]);
    expect((await upload(`plans/${plan.id}/versions`, '<svg/>', '&metres_per_unit=0.01')).status).toBe(201);
    const { body: lines } = await ask('GET', `plans/${plan.id}/lines`);
    expect([lines.version, lines.segments.length > 0, problemsOf('plan_lines', lines)]).toEqual([
      2,
      true,
      [],
    ]);
    expect((await ask('GET', 'maps/m1/plan')).status).toBe(404);
    const pins = [
      { place: 'p1', x_m: 1, y_m: 7 },
      { place: 'p11', x_m: 14, y_m: 7.5, theta_rad: 0.5 },
    ];
    expect((await ask('PUT', 'maps/m1/plan', { plan: plan.id, pins: [pins[0]] })).status).toBe(422);
    const { body: tied } = await ask('PUT', 'maps/m1/plan', { plan: plan.id, version: 1, pins });
    expect([tied.newest_version, tied.places.length, problemsOf('map_plan', tied)]).toEqual([2, 13, []]);
    const told = [];
    const { tell } = mock.house;
    mock.house.tell = (event) => told.push(event);
    for (const lost of [null, 'searching'])
      tellOnPlan(mock.house, { x_m: 1, y_m: 7.5, theta_rad: 0.5, lost, word: 'possible' });
    mock.house.tell = tell;
    expect(told.flatMap((one) => problemsOf('event', one))).toEqual([]);
    expect([told.length, told[1].pose.x_m]).toEqual([2, null]);
    const { body: maps } = await ask('GET', 'maps');
    expect(maps.maps.flatMap((one) => problemsOf('map_info', one))).toEqual([]);
    expect((await ask('GET', `plans/${plan.id}`)).body.maps).toEqual(['m1']);
    expect((await ask('DELETE', `plans/${plan.id}`)).body.code).toBe('conflict');
    expect((await ask('DELETE', 'maps/m1/plan')).status).toBe(204);
    expect((await ask('PUT', `plans/${plan.id}/name`, { name: 'Annex' })).body.name).toBe('Annex');
    expect((await ask('DELETE', `plans/${plan.id}`)).status).toBe(204);
    expect((await ask('GET', 'plans')).body.plans).toEqual([]);
  });

  it('answers of doubts and pairs of pictures as the schemas say', async () => {
    const { body: doubts } = await ask('GET', 'maps/m1/doubts?about=all');
    expect([doubts.doubts.length > 2, problemsOf('doubts', doubts)]).toEqual([true, []]);
    const [{ image_a, image_b }] = doubts.doubts;
    const { body: pair } = await ask('GET', `maps/m1/pair?${new URLSearchParams({ image_a, image_b })}`);
    expect(problemsOf('pair', pair)).toEqual([]);
  });

  it('answers of former states as the schemas say', async () => {
    const root = 'maps/m1';
    const { revision } = (await ask('GET', `${root}/graph`)).body;
    const edits = [{ kind: 'block_edge', from: 'p1', to: 'p2', blocked: true }];
    await ask('POST', `${root}/edits`, { edits }, { 'If-Match': `"r${revision}"` });
    const number = (await ask('GET', `${root}/history`)).body.edits.at(-1).change;
    const { body: built } = await ask('GET', `${root}/history/0/graph`);
    expect([problemsOf('graph', built), built.edges.some((one) => one.blocked)]).toEqual([[], false]);
    const { body: difference } = await ask('GET', `${root}/history/0/difference?to=${number}`);
    expect([problemsOf('difference', difference), difference.edges.length]).toEqual([[], 1]);
    expect((await ask('GET', `${root}/history/77/graph`)).body.code).toBe('not_found');
  });

  it('answers of explorations as the schemas say', async () => {
    const root = `robots/${(await ask('GET', 'robots')).body.robots[0].id}`;
    expect((await ask('GET', `${root}/exploration`)).status).toBe(404);
    const { body: taken } = await ask('POST', `${root}/lease`, { take_over: true });
    const order = { lease_id: taken.lease.id };
    expect((await ask('POST', `${root}/explorations`, { lease_id: 'none' })).body.code).toBe('lease_held');
    const wrong = await ask('POST', `${root}/explorations`, { ...order, exploration: 'none' });
    expect([wrong.status, wrong.body.code]).toEqual([409, 'conflict']);
    const begun = await ask('POST', `${root}/explorations`, order);
    expect([begun.status, problemsOf('mission', begun.body)]).toEqual([201, []]);
    const now = async () => (await ask('GET', `${root}/exploration`)).body;
    await expect.poll(async () => (await now()).pictures).toBeGreaterThan(3);
    expect(problemsOf('exploration', await now())).toEqual([]);
    expect((await ask('POST', `${root}/exploration/finish`, order)).body.code).toBe('conflict');
    await ask('POST', `${root}/stop`, {});
    await expect.poll(async () => (await now()).phase).toBe('paused');
    const fences = [[[1, 1], [2, 1], [2, 2]]]; // prettier-ignore
    expect((await ask('PUT', `${root}/exploration/fences`, { ...order, fences })).status).toBe(202);
    expect([(await now()).fences, problemsOf('exploration', await now())]).toEqual([fences, []]);
    const on = await ask('POST', `${root}/explorations`, { ...order, exploration: begun.body.exploration });
    expect([on.status, on.body.exploration]).toEqual([201, begun.body.exploration]);
    await expect.poll(async () => (await now()).phase, { timeout: 9000 }).toBe('uploaded');
    expect(problemsOf('exploration', await now())).toEqual([]);
    expect((await ask('GET', `tours/${(await now()).tour}`)).body.state).toBe('complete');
  });

  it('answers of explorations that are shared as the schemas say', async () => {
    const { house } = mock;
    const robots = ['Bruno', 'Carla', 'Dora'].map((name) => house.newRobot(name, 'm1'));
    house.robots.push(...robots);
    const [bruno, carla, dora] = robots.map((one) => one.id);
    const order = {};
    for (const one of [bruno, carla]) {
      const { body } = await ask('POST', `robots/${one}/lease`, { take_over: true });
      order[one] = { lease_id: body.lease.id };
    }
    const share = (of, robot, more = order[of]) =>
      ask('PUT', `robots/${of}/exploration/companion`, { ...more, robot });
    const refused = async (...args) => {
      const { status, body } = await share(...args);
      return [status, body.code, ...problemsOf('problem', body)];
    };
    await ask('POST', `robots/${bruno}/explorations`, order[bruno]);
    expect(await refused('none', bruno, {})).toEqual([404, 'not_found']);
    expect(await refused(bruno, 'none')).toEqual([404, 'not_found']);
    expect(await refused(bruno, bruno)).toEqual([422, 'invalid_input']);
    expect(await refused(bruno, carla)).toEqual([409, 'conflict']);
    expect(await refused(carla, bruno)).toEqual([409, 'conflict']);
    await ask('POST', `robots/${carla}/explorations`, order[carla]);
    expect(await refused(bruno, carla, { lease_id: 'none' })).toEqual([409, 'lease_held']);
    expect((await share(bruno, carla)).status).toBe(202);
    const now = async (of) => (await ask('GET', `robots/${of}/exploration`)).body;
    await expect.poll(async () => (await now(bruno)).companion).not.toBeNull();
    expect((await now(bruno)).companion).toMatchObject({ joined: false, pictures: 0 });
    expect((await share(carla, bruno)).status).toBe(202);
    for (const one of [bruno, carla])
      await expect.poll(async () => (await now(one)).companion?.joined, { timeout: 5000 }).toBe(true);
    expect(problemsOf('exploration', await now(bruno))).toEqual([]);
    house.robots.find((one) => one.id === dora).online = false;
    expect(await refused(bruno, dora)).toEqual([409, 'conflict']);
    expect((await share(bruno, null)).status).toBe(202);
    await expect.poll(async () => (await now(bruno)).companion).toBeNull();
    for (const one of [bruno, carla]) await ask('POST', `robots/${one}/stop`, {});
  });

  it('answers a report as a page of its own', async () => {
    const answer = await fetch(`${mock.url}/api/v1/maps/m1/report`, { headers: { cookie } });
    expect([answer.status, answer.headers.get('content-type')]).toEqual([200, 'text/html; charset=utf-8']);
    expect(answer.headers.get('content-security-policy')).toMatch(/frame-ancestors 'self'/);
    expect(await answer.text()).not.toMatch(/<script/);
  });

  it('answers how alike the pictures are as the schemas say, with tiles that are pictures', async () => {
    const { body } = await ask('GET', 'maps/m1/similarity');
    expect([problemsOf('similarity', body), body.images.length, body.levels]).toEqual([[], 26, 1]);
    const tile = (path) => fetch(`${mock.url}/api/v1/maps/m1/similarity/${path}`, { headers: { cookie } });
    const answer = await tile('0/0/0');
    const bytes = Buffer.from(await answer.arrayBuffer());
    expect(answer.headers.get('content-type')).toBe('image/png');
    expect([bytes.toString('latin1', 1, 4), bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual([
      'PNG',
      256,
      256,
    ]);
    expect([(await tile('1/0/0')).status, (await tile('0/0/1')).status]).toEqual([404, 404]);
  });

  it('tells how missions fared on ways as the contract says', async () => {
    const { body } = await ask('GET', 'maps/m1/ways');
    const keys = ['driven', 'failed', 'from', 'last_driven_us', 'last_failed_us', 'to'];
    for (const one of body.ways) expect(Object.keys(one).sort()).toEqual(keys);
    expect(body.ways.some((one) => one.driven > 0 && one.last_failed_us === null)).toBe(true);
  });

  it('tells events as the schema says, the snapshot first, and that it lives', async () => {
    const socket = new WebSocket(`${mock.url.replace('http', 'ws')}/api/v1/events`, { headers: { cookie } });
    const events = await new Promise((done, fail) => {
      const heard = [];
      socket.on('error', fail);
      socket.on('message', (data) => {
        heard.push(JSON.parse(data.toString()));
        if (heard.length >= 4 && heard.some((one) => one.type === 'heartbeat')) done(heard);
      });
    });
    socket.close();
    expect(events[0].type).toBe('snapshot');
    expect(events.flatMap((one) => problemsOf('event', one))).toEqual([]);
  });
});
