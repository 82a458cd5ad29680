// SPDX-License-Identifier: Apache-2.0
// The pretended server that the dashboard is developed against refuses in the words of the real one: each request here is
// asked of both, and what they answer is the same but for the ids.
// Usage: node tests/browser/same_answers_test.mjs --base URL --name N --password P
import { parseArgs } from 'node:util';
import { kCamera, startMock } from '../../web/dev/mock-server.mjs';

const { values } = parseArgs({
  options: { base: { type: 'string' }, name: { type: 'string' }, password: { type: 'string' } },
});
for (const key of ['base', 'name', 'password']) if (!values[key]) throw new Error(`--${key} is missing`);

const kPassword = 'wheels-and-ways';
const kOnlineMs = 30_000;

/** What requests are about, in either house: {robot}, {map}... stand for its ids. */
class House {
  constructor(base) {
    this.base = base;
    this.cookies = { nobody: '' };
    this.ids = {};
  }
  async ask(method, path, { as = 'admin', body, headers = {} } = {}) {
    const answer = await fetch(`${this.base}/api/v1/${this.filled(path)}`, {
      method,
      headers: {
        cookie: this.cookies[as],
        origin: this.base,
        ...(body === undefined || body instanceof Uint8Array ? {} : { 'Content-Type': 'application/json' }),
        ...JSON.parse(this.filled(JSON.stringify(headers))),
      },
      ...(body === undefined
        ? {}
        : { body: body instanceof Uint8Array ? body : this.filled(JSON.stringify(body)) }),
    });
    const text = await answer.text();
    const json = /json/.test(answer.headers.get('content-type') ?? '') && text ? JSON.parse(text) : text;
    return { status: answer.status, body: json, cookie: answer.headers.get('set-cookie')?.split(';')[0] };
  }
  async well(method, path, options) {
    const { status, body, cookie } = await this.ask(method, path, options);
    if (status >= 300)
      throw new Error(`${method} ${path} at ${this.base}: ${status} ${JSON.stringify(body)}`);
    return { body, cookie };
  }
  async signIn(as, name, password) {
    this.cookies[as] = '';
    this.cookies[as] = (await this.well('POST', 'login', { as, body: { name, password } })).cookie;
  }
  filled(text) {
    return text.replace(/\{(\w+)\}/g, (whole, key) => this.ids[key] ?? whole);
  }
  /** The words of an answer, with this house's ids taken out again. */
  bare(value) {
    const sorted =
      value === null || typeof value !== 'object' ? value : Object.fromEntries(Object.entries(value).sort());
    const longest = Object.entries(this.ids).sort((a, b) => String(b[1]).length - String(a[1]).length);
    return longest.reduce(
      (text, [key, id]) => text.replace(new RegExp(`(?<![\\w-])${escaped(id)}(?![\\w-])`, 'g'), `{${key}}`),
      JSON.stringify(sorted),
    );
  }
  async settle(name, password) {
    await this.signIn('admin', name, password);
    for (const [person, role] of [
      ['rita', 'rider'],
      ['vic', 'viewer'],
    ]) {
      await this.well('POST', 'users', { body: { name: person, password: kPassword, role } });
      await this.signIn(person, person, kPassword);
    }
    const { robots } = (await this.well('GET', 'robots')).body;
    const robot = robots[0];
    const { body: graph } = await this.well('GET', `maps/${robot.map}/graph`);
    const { body: spare } = await this.well('POST', 'robots', { body: { name: 'spare' } });
    const { body: tour } = await this.well('POST', 'tours', { body: { name: 'short', camera: kCamera } });
    const { place, id: destination, image: dock, label } = graph.destinations[0];
    const way = graph.edges.find(({ from }) => from === place);
    const far = graph.places.find(
      (one) => !graph.edges.some(({ from, to }) => from === place && to === one.id) && one.id !== place,
    );
    this.ids = {
      dock_label: label,
      robot: robot.id,
      robot_name: robot.name,
      map: robot.map,
      spare: spare.id,
      tour: tour.id,
      revision: graph.revision,
      destination,
      place,
      far: far.id,
      far_image: far.members[0],
      far_all: far.members.join('", "'),
      beside: way.to,
      dock,
    };
    for (const until = Date.now() + kOnlineMs; ;) {
      const now = (await this.well('GET', 'robots')).body.robots.find((one) => one.id === robot.id);
      if (now.online) break;
      if (Date.now() > until) throw new Error(`the robot of ${this.base} does not come`);
      await new Promise((done) => setTimeout(done, 200));
    }
  }
}

const escaped = (text) => String(text).replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

const kRevision = { 'If-Match': '"r{revision}"' };
const kVersion = { 'If-Match': '"d1"' };
const edits = (...all) => ({ body: { edits: all }, headers: kRevision });

// [what it is about, method, path, options]; in order, for some change what the next ones find.
const kRequests = [
  [
    'another page asks',
    'POST',
    'robots',
    { body: { name: 'x' }, headers: { origin: 'http://elsewhere.example' } },
  ],
  ['nobody asks', 'GET', 'robots', { as: 'nobody' }],
  ['a wrong password', 'POST', 'login', { as: 'nobody', body: { name: 'rita', password: 'quite another' } }],
  ['an unknown name', 'POST', 'login', { as: 'nobody', body: { name: 'nobody', password: kPassword } }],
  [
    'a set-up link that was used',
    'POST',
    'setup',
    { as: 'nobody', body: { token: 'first', name: 'eve', password: kPassword } },
  ],
  ['an unknown route', 'GET', 'nonsense'],
  ['a viewer drives', 'POST', 'robots/{robot}/lease', { as: 'vic', body: {} }],
  [
    'a rider adds a person',
    'POST',
    'users',
    { as: 'rita', body: { name: 'x', password: kPassword, role: 'rider' } },
  ],
  ['a name twice', 'POST', 'users', { body: { name: 'rita', password: kPassword, role: 'rider' } }],
  ['a short password', 'POST', 'users', { body: { name: 'tim', password: 'short', role: 'rider' } }],
  ['no token', 'DELETE', 'tokens/none'],
  ['no robot', 'POST', 'robots/none/stop', { body: {} }],
  ['no robot to lease', 'POST', 'robots/none/lease', { body: {} }],
  ['no picture yet', 'GET', 'robots/{spare}/frame'],
  ['a lease over', 'PUT', 'robots/{robot}/lease', { as: 'rita', body: { lease_id: 'gone' } }],
  [
    'a mission without a lease',
    'POST',
    'robots/{robot}/missions',
    { as: 'rita', body: { lease_id: 'gone', destination: '{destination}' } },
  ],
  ['a lease', 'POST', 'robots/{robot}/lease', { as: 'rita', body: {}, keep: 'lease' }],
  ['another drives', 'POST', 'robots/{robot}/lease', { body: {} }],
  ['the lease of another', 'PUT', 'robots/{robot}/lease', { body: { lease_id: 'gone' } }],
  [
    'a mission on the lease of another',
    'POST',
    'robots/{robot}/missions',
    { body: { lease_id: 'gone', destination: '{destination}' } },
  ],
  [
    'an unknown destination',
    'POST',
    'robots/{robot}/missions',
    { as: 'rita', body: { lease_id: '{lease}', destination: 'cellar' } },
  ],
  [
    'an unknown place',
    'POST',
    'robots/{robot}/missions',
    { as: 'rita', body: { lease_id: '{lease}', place: 'p99999' } },
  ],
  [
    'an answer to no mission',
    'POST',
    'robots/{robot}/missions/none/answer',
    { as: 'rita', body: { lease_id: '{lease}', question: 1, here: true } },
  ],
  ['a lease given back', 'DELETE', 'robots/{robot}/lease', { as: 'rita', body: { lease_id: '{lease}' } }],
  [
    'a lease of the spare robot',
    'POST',
    'robots/{spare}/lease',
    { as: 'rita', body: {}, keep: 'spare_lease' },
  ],
  [
    'a mission of a robot that is away',
    'POST',
    'robots/{spare}/missions',
    { as: 'rita', body: { lease_id: '{spare_lease}', destination: '{destination}' } },
  ],
  ['the place of a robot without a map', 'PUT', 'robots/{spare}/place', { body: { place: '{place}' } }],
  ['no map to be on', 'PUT', 'robots/{spare}/map', { body: { map: 'none' } }],
  ['a map for it', 'PUT', 'robots/{spare}/map', { body: { map: '{map}' } }],
  ['the place of a robot that is away', 'PUT', 'robots/{spare}/place', { body: { place: '{place}' } }],
  ['no exploration', 'GET', 'robots/{robot}/exploration'],
  ['fences of no robot', 'PUT', 'robots/none/exploration/fences', { body: { lease_id: 'gone', fences: [] } }],
  ...[
    ['a companion of no robot', 'none', '{robot}'],
    ['no robot as a companion', '{robot}', 'none'],
    ['itself as a companion', '{robot}', '{robot}'],
    ['a companion that is away', '{robot}', '{spare}'],
    ['a companion that explores nothing', '{spare}', '{robot}'],
    ['no companion, on the lease of another', '{robot}', null],
  ].map(([about, of, robot]) => [
    about,
    'PUT',
    `robots/${of}/exploration/companion`,
    { body: { lease_id: 'gone', robot } },
  ]),
  [
    'a rider chooses a companion',
    'PUT',
    'robots/{robot}/exploration/companion',
    { as: 'rita', body: { lease_id: 'gone', robot: null } },
  ],
  ['a label that is not there', 'PUT', 'robots/{robot}/place', { body: { label: 'cellar' } }],
  ['a place that is not there', 'PUT', 'robots/{robot}/place', { body: { place: 'p99999' } }],
  ['no camera', 'POST', 'tours', { body: { name: 'blind', camera: { format: 'something' } } }],
  ['no tour', 'GET', 'tours/none'],
  [
    'no picture',
    'PUT',
    'tours/{tour}/images/0',
    { body: new Uint8Array(0), headers: { 'Content-Type': 'image/jpeg' } },
  ],
  [
    'no tour for a picture',
    'PUT',
    'tours/none/images/0',
    { body: new Uint8Array(4), headers: { 'Content-Type': 'image/jpeg' } },
  ],
  ['too few pictures', 'POST', 'tours/{tour}/complete', { body: {} }],
  ['no tour to complete', 'POST', 'tours/none/complete', { body: {} }],
  ['no map', 'GET', 'maps/none/graph'],
  ['no map to remove', 'DELETE', 'maps/none'],
  ['no map to build', 'POST', 'maps/none/builds', { body: { kind: 'build' } }],
  ['no map to refine', 'PUT', 'maps/none/refine', { body: { refine: 'auto' } }],
  ['no thumbnail of an unknown place', 'GET', 'maps/{map}/places/p99999/thumbnail'],
  ['no job to take', 'POST', 'jobs/none/take', { body: {} }],
  ['no job to cancel', 'POST', 'jobs/none/cancel', { body: {} }],
  [
    'no revision',
    'POST',
    'maps/{map}/edits',
    { body: { edits: [{ kind: 'rename', place: '{place}', label: 'x' }] } },
  ],
  [
    'a revision of old',
    'POST',
    'maps/{map}/edits',
    { body: { edits: [{ kind: 'rename', place: '{place}', label: 'x' }] }, headers: { 'If-Match': '"r0"' } },
  ],
  ['no place to rename', 'POST', 'maps/{map}/edits', edits({ kind: 'rename', place: 'p99999', label: 'x' })],
  [
    'no way to close',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'block_edge', from: '{place}', to: '{far}', blocked: true }),
  ],
  [
    'no shortcut to decide',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'decide_shortcut', image_a: 'a/1.jpg', image_b: 'a/2.jpg', accept: true }),
  ],
  [
    'a place with itself',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'merge', place: '{place}', into: '{place}' }),
  ],
  [
    'a picture of another place',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'split', place: '{place}', images: ['{far_image}'] }),
  ],
  [
    'all pictures of a place',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'split', place: '{far}', images: ['{far_all}'] }),
  ],
  [
    'a picture that is there',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'move', images: ['{far_image}'], into: '{far}' }),
  ],
  [
    'a picture of no place',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'move', images: ['a/1.jpg'], into: '{far}' }),
  ],
  ['no place to remove', 'POST', 'maps/{map}/edits', edits({ kind: 'delete', place: 'p99999' })],
  [
    'a way that is there',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'add_edge', from: '{place}', to: '{beside}' }),
  ],
  [
    'no way to remove',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'remove_edge', from: '{place}', to: '{far}' }),
  ],
  [
    'no hypothesis to decide',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'decide', prototype_a: 'a/1.jpg', prototype_b: 'a/2.jpg', accept: true }),
  ],
  [
    'a destination twice',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'add_destination', image: '{dock}', label: 'again' }),
  ],
  [
    'a destination at no picture',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'add_destination', image: 'a/1.jpg', label: 'again' }),
  ],
  [
    'no destination to name',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'name_destination', destination: 'none', label: 'again' }),
  ],
  [
    'no picture to dock at',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'set_destination_picture', destination: '{destination}', image: 'a/1.jpg' }),
  ],
  [
    'no picture to be unsure of',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'set_aside', about: 'way', image_a: 'a/1.jpg', image_b: 'a/2.jpg' }),
  ],
  [
    'one picture twice',
    'POST',
    'maps/{map}/edits',
    edits({ kind: 'decide', prototype_a: '{far_image}', prototype_b: '{far_image}', accept: true }),
  ],
  ['nothing to redo', 'POST', 'maps/{map}/redo', { headers: kRevision }],
  ['no draft', 'GET', 'maps/{map}/drafts/none'],
  ['no draft to discard', 'DELETE', 'maps/{map}/drafts/none'],
  ['no map for a draft', 'POST', 'maps/none/drafts', { body: { name: 'x' } }],
  ['a viewer drafts', 'POST', 'maps/{map}/drafts', { as: 'vic', body: { name: 'x' } }],
  ['a draft', 'POST', 'maps/{map}/drafts', { body: { name: 'x' }, keep: 'draft', id: (body) => body.id }],
  ['no version', 'POST', 'maps/{map}/drafts/{draft}/undo', { body: {} }],
  [
    'a version of old',
    'POST',
    'maps/{map}/drafts/{draft}/undo',
    { body: {}, headers: { 'If-Match': '"d0"' } },
  ],
  ['nothing to undo', 'POST', 'maps/{map}/drafts/{draft}/undo', { body: {}, headers: kVersion }],
  ['nothing to redo in it', 'POST', 'maps/{map}/drafts/{draft}/redo', { body: {}, headers: kVersion }],
  ['nothing to publish', 'POST', 'maps/{map}/drafts/{draft}/publish', { body: {}, headers: kVersion }],
  ['no check yet', 'GET', 'maps/{map}/drafts/{draft}/check'],
  [
    'no place to rename in it',
    'POST',
    'maps/{map}/drafts/{draft}/edits',
    { body: { edits: [{ kind: 'rename', place: 'p99999', label: 'x' }] }, headers: kVersion },
  ],
  ['no map for doubts', 'GET', 'maps/none/doubts'],
  ['doubts of no kind', 'GET', 'maps/{map}/doubts?kind=mood'],
  ['doubts of no place', 'GET', 'maps/{map}/doubts?place=p99999'],
  ['too many doubts', 'GET', 'maps/{map}/doubts?limit=1001'],
  ['one picture alone', 'GET', 'maps/{map}/pair?image_a={far_image}'],
  ['a pair of no picture', 'GET', 'maps/{map}/pair?image_a={far_image}&image_b=a/1.jpg'],
  ['no map for ways', 'GET', 'maps/none/ways'],
  ['no such change', 'GET', 'maps/{map}/history/999999/graph'],
  ['a change that is no number', 'GET', 'maps/{map}/history/first/difference'],
  ['a later change that is no number', 'GET', 'maps/{map}/history/0/difference?to=last'],
  ['no map for a report', 'GET', 'maps/none/report'],
  ['no map for a matrix', 'GET', 'maps/none/similarity'],
  ['no such tile', 'GET', 'maps/{map}/similarity/0/9999/0'],
  ['a level that is too high', 'GET', 'maps/{map}/similarity/31/0/0'],
  ['no map to edit', 'POST', 'maps/none/edits', edits({ kind: 'rename', place: '{place}', label: 'x' })],
];

const mock = await startMock({ port: 0 });
const real = new House(values.base);
const pretended = new House(mock.url);
await real.settle(values.name, values.password);
await pretended.settle('anna', 'homeward');

let different = 0;
for (const [about, method, path, options = {}] of kRequests) {
  const told = [];
  for (const house of [real, pretended]) {
    const { status, body } = await house.ask(method, path, options);
    if (options.keep) house.ids[options.keep] = (options.id ?? ((one) => one.lease.id))(body);
    // Of an answer that is not a refusal the schemas say what it is.
    told.push(`${status} ${status >= 400 ? house.bare(body) : ''}`);
  }
  if (told[0] === told[1]) continue;
  different += 1;
  process.stdout.write(`${about}: ${method} ${path}\n  real       ${told[0]}\n  pretended  ${told[1]}\n`);
}
mock.close();
process.stdout.write(`${kRequests.length} requests, ${different} answered differently\n`);
process.exit(different === 0 ? 0 : 1);
