// SPDX-License-Identifier: Apache-2.0
// Drafts of the mock server: edits that stand on the present map and are not in use.
import { difference } from './mock-difference.mjs';
import { apply, changed, logged } from './mock-edits.mjs';
import { wayBetween } from './mock-house.mjs';
import { Refusal } from './mock-refusal.mjs';

const kCheckStepMs = 120;

/** What edits may change of a graph; the rest is shared. */
const copied = (graph) => ({
  ...graph,
  places: graph.places.map((one) => ({ ...one, members: [...one.members] })),
  edges: graph.edges.map((one) => ({ ...one })),
  destinations: graph.destinations.map((one) => ({ ...one })),
  hypotheses: graph.hypotheses.map((one) => ({ ...one })),
  shortcuts: graph.shortcuts.map((one) => ({ ...one })),
});

const kKept = new WeakMap(); // by the log of a draft: the graph it was tried on, and what came of it

/** The map with a draft's edits, what is other in it, and why some do not hold any more. Nobody may change what it gives. */
function tried(house, draft) {
  const kept = kKept.get(draft.log);
  if (kept?.on === house.graph) return kept.found;
  const found = applied(house, draft);
  kKept.set(draft.log, { on: house.graph, found });
  return found;
}

function applied(house, draft) {
  let graph = copied(house.graph);
  const edits = draft.log.map((one) => {
    if (one.undone) return one;
    const trial = copied(graph);
    try {
      apply(trial, one);
    } catch (thrown) {
      return { ...one, lost: thrown.message };
    }
    graph = trial;
    return { ...one, lost: null };
  });
  return { graph, edits, other: difference(house.graph, graph) };
}

function touchesOf(house, draft) {
  const { places, edges, destinations } = tried(house, draft).other;
  const known = new Set(house.graph.places.map((one) => one.id));
  const all = [
    ...places.map((one) => one.id),
    ...edges.flatMap(({ from, to }) => [from, to]),
    ...destinations.flatMap(({ before, after }) => [before?.place, after?.place]),
  ];
  return [...new Set(all)].filter((one) => known.has(one));
}

function shown(house, draft) {
  const { id, map, name, by, created_us, version, check } = draft;
  const { edits } = tried(house, draft);
  const touches = touchesOf(house, draft);
  const overlaps = house.drafts
    .filter((one) => one !== draft && one.map === map)
    .map((one) => ({
      draft: one.id,
      by: one.by,
      name: one.name,
      places: touchesOf(house, one).filter((place) => touches.includes(place)),
    }))
    .filter((one) => one.places.length > 0);
  return {
    id,
    map,
    name,
    by,
    created_us,
    version,
    revision: house.graph.revision,
    changes: new Set(edits.filter((one) => !one.undone).map((one) => one.change)).size,
    edits,
    touches,
    overlaps,
    check,
  };
}

const answer = (house, draft, status = 200) => {
  const body = shown(house, draft);
  return { status, body, headers: { ETag: `"d${body.version}"` } };
};

/** Everybody hears of a draft that changed. */
function told(house, draft) {
  house.send('draft', shown(house, draft));
  return answer(house, draft);
}

/** Drafts stand on the present revision of their map. */
export function tellDrafts(house, map) {
  for (const one of house.drafts) if (one.map === map.id) house.send('draft', shown(house, one));
}

const whereOf = (id) => `drafts/${id}`;

function named(house, [map, id]) {
  const found = house.drafts.find((one) => one.map === map && one.id === id);
  if (found) return found;
  const words = 'There is no such draft; it may have been published or discarded.';
  throw new Refusal('not_found', words, whereOf(id));
}

function asked(house, { args, headers }) {
  const tag = headers['if-match'];
  if (!tag)
    throw Refusal.ofHttp(
      428,
      'Precondition required',
      'Say in If-Match which version of the draft the change is made against.',
    );
  const against = /^"d(\d+)"$/.exec(tag)?.[1];
  if (!against)
    throw new Refusal(
      'invalid_input',
      'If-Match must name a version of the draft, such as "d4".',
      'If-Match',
    );
  const draft = named(house, args);
  if (Number(against) === draft.version) return draft;
  const words = `The draft is at version ${draft.version}, the change was made against ${against}.`;
  throw new Refusal('stale_revision', words, whereOf(draft.id));
}

function beginDraft(house, { user, body, args }) {
  const map = house.find('maps', args[0]);
  const draft = {
    id: house.newId('d'),
    map: map.id,
    name: body?.name ?? '',
    by: user.name,
    created_us: Date.now() * 1000,
    version: 1,
    log: [],
    check: null,
    checked: null,
  };
  house.drafts.push(draft);
  told(house, draft);
  return answer(house, draft, 201);
}

function gone(house, draft) {
  house.drafts = house.drafts.filter((one) => one !== draft);
  house.tell({ type: 'draft_gone', v: 1, seq: (house.seq += 1), map: draft.map, draft: draft.id });
}

function discardDraft(house, { args }) {
  gone(house, named(house, args));
  return { status: 204 };
}

function editDraft(house, request) {
  const draft = asked(house, request);
  const graph = copied(tried(house, draft).graph);
  const change = 1 + Math.max(0, ...draft.log.map((one) => one.change));
  const added = request.body.edits.map((one, i) => logged(graph, one, request.user.name, change, i));
  added.forEach((one, i) => apply(graph, one, `body/edits/${i}`));
  draft.log = [...draft.log.map((one) => ({ ...one, redoable: false })), ...added];
  draft.version += 1;
  return told(house, draft);
}

function step(house, draft, found, state) {
  const way = state.undone ? 'undo' : 'redo';
  if (!found) throw new Refusal('not_found', `There is no change to ${way}.`, whereOf(draft.id));
  draft.log = draft.log.map((one) => (one.change === found.change ? { ...one, ...state } : one));
  draft.version += 1;
  return told(house, draft);
}

function undoIn(house, request) {
  const draft = asked(house, request);
  const latest = draft.log.filter((one) => !one.undone).at(-1);
  return step(house, draft, latest, { undone: true, redoable: true });
}

function redoIn(house, request) {
  const draft = asked(house, request);
  const earliest = draft.log.find((one) => one.redoable);
  return step(house, draft, earliest, { undone: false, redoable: false });
}

function publish(house, request) {
  const draft = asked(house, request);
  const change = 1 + Math.max(0, ...house.edits.map((one) => one.change));
  const all = tried(house, draft).edits;
  const lost = all.find((one) => one.lost !== null && !one.undone);
  if (lost && !request.body?.leave_out_lost)
    throw new Refusal(
      'conflict',
      `The map has changed and does not take every edit of the draft any more: ${lost.lost}`,
      whereOf(draft.id),
    );
  const edits = all
    .filter((one) => !one.undone && one.lost === null)
    .map((one) => ({ ...one, change, redoable: false }));
  if (edits.length === 0) throw new Refusal('conflict', 'The draft changes nothing.', whereOf(draft.id));
  const log = [...house.edits.map((one) => ({ ...one, redoable: false })), ...edits];
  house.drafts = house.drafts.filter((one) => one !== draft);
  const map = house.find('maps', draft.map);
  const published = changed(house, map, log, house.graph.revision + 1);
  gone(house, draft);
  return { body: { revision: house.graph.revision }, headers: published.headers };
}

/** What a replay would say: where ways or places went, pictures are lost and destinations lead to each other no more. */
function checkOf(house, draft) {
  const { graph, other } = tried(house, draft);
  const { places, edges } = other;
  const routes = (one) =>
    one.destinations
      .flatMap((a) => one.destinations.map((b) => [a.place, b.place]))
      .filter(([a, b]) => a !== b);
  const open = (one) => routes(one).filter(([a, b]) => wayBetween(one, a, b) !== null);
  const spot = { other: null, images: [], of: 14, times: 0, distance_m: 0, words: 'It is worse here.' };
  const removed = places.filter((one) => one.change === 'removed');
  const lost = removed.map((one) => ({
    ...spot,
    kind: 'localisation',
    place: one.id,
    other: house.graph.edges.find(({ from }) => from === one.id)?.to ?? null,
    images: one.left,
    times: one.left.length,
  }));
  const ways = edges
    .filter((one) => one.change === 'added')
    .filter(({ from, to }) => from < to)
    .map(({ from, to }) => ({ ...spot, kind: 'way', place: from, other: to, of: 40 }));
  const still = open(graph).map(String);
  const cut = open(house.graph)
    .filter((one) => graph.places.some(({ id }) => id === one[0]) && !still.includes(String(one)))
    .slice(0, 3)
    .map(([place, other]) => ({ ...spot, kind: 'route', place, other, of: 0 }));
  const gone = house.graph.destinations
    .filter(({ place }) => removed.some(({ id }) => id === place))
    .map(({ place, image }) => ({ ...spot, kind: 'destination', place, images: [image], of: 1, times: 1 }));
  const worse = [...lost, ...ways, ...cut, ...gone];
  const all = house.graph.places.flatMap((one) => one.members).length;
  const missing = lost.flatMap((one) => one.images).length;
  return {
    format: 'homeward-replay-check',
    version: 1,
    map: draft.map,
    draft: draft.id,
    draft_version: draft.version,
    revision: house.graph.revision,
    pictures: all,
    sights: 0,
    right_before: all,
    right_after: all - missing,
    lost_before: 0,
    lost_after: missing,
    routes_before: open(house.graph).length,
    routes_after: open(graph).length,
    harmless: worse.length === 0,
    worse,
  };
}

function check(house, { args }) {
  const draft = named(house, args);
  if (house.jobs.some((one) => one.id === draft.check?.job && one.state === 'running'))
    throw new Refusal('conflict', 'This draft is being checked already.', whereOf(draft.id));
  const job = {
    id: house.newId('j'),
    kind: 'check',
    map: draft.map,
    state: 'running',
    progress: { stage: 'replay', share: 0 },
    error: null,
    skipped: 0,
    gained: 0,
    notes: [],
    created_us: Date.now() * 1000,
  };
  house.jobs.push(job);
  house.send('job', job);
  const found = checkOf(house, draft);
  draft.check = { job: job.id, version: draft.version };
  told(house, draft);
  const timer = setInterval(() => {
    if (job.state === 'running')
      job.progress = { ...job.progress, share: Math.min(1, job.progress.share + 0.1) };
    if (job.progress.share >= 1 || job.state !== 'running') {
      clearInterval(timer);
      if (job.state === 'running') {
        job.state = 'done';
        draft.checked = found;
      }
    }
    house.send('job', job);
  }, kCheckStepMs);
  house.timers.add(timer);
  return { status: 202, body: { job } };
}

function checked(house, { args }) {
  const { id, checked: found } = named(house, args);
  if (!found) throw new Refusal('not_found', 'No replay check of this draft has ended.', whereOf(id));
  return { body: found };
}

/** Orders of the tests, as if another person had asked. */
export function steerDrafts(house, order) {
  const [{ id: map }] = house.maps;
  const user = { name: order.by };
  const edit = (draft, version) => {
    const headers = { 'if-match': `"d${version}"` };
    editDraft(house, { user, headers, args: [map, draft], body: { edits: order.edits } });
  };
  if (order.do === 'draft_discard') discardDraft(house, { args: [map, order.draft] });
  else if (order.do === 'draft_edit') edit(order.draft, order.version);
  else {
    const { body } = beginDraft(house, { user, args: [map], body: { name: order.name } });
    edit(body.id, body.version);
  }
}

const kOne = 'maps\\/([^/]+)\\/drafts\\/([^/]+)';
const route = (method, rest = '') => new RegExp(`^${method} ${kOne}${rest}$`);

export const kDraftRoutes = [
  [
    /^GET maps\/([^/]+)\/drafts$/,
    'viewer',
    (house, { args }) => {
      const { id } = house.find('maps', args[0]);
      const own = house.drafts.filter((one) => one.map === id);
      return { body: { drafts: own.map((one) => shown(house, one)) } };
    },
  ],
  [/^POST maps\/([^/]+)\/drafts$/, 'installer', beginDraft],
  [route('GET'), 'viewer', (house, { args }) => answer(house, named(house, args))],
  [route('DELETE'), 'installer', discardDraft],
  [route('POST', '\\/edits'), 'installer', editDraft],
  [route('POST', '\\/undo'), 'installer', undoIn],
  [route('POST', '\\/redo'), 'installer', redoIn],
  [
    route('GET', '\\/graph'),
    'viewer',
    (house, { args }) => ({ body: { ...tried(house, named(house, args)).graph, map: args[0] } }),
  ],
  [
    route('GET', '\\/difference'),
    'viewer',
    (house, { args }) => ({ body: tried(house, named(house, args)).other }),
  ],
  [route('POST', '\\/check'), 'installer', check],
  [route('GET', '\\/check'), 'viewer', checked],
  [route('POST', '\\/publish'), 'installer', publish],
];
