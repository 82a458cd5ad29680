// SPDX-License-Identifier: Apache-2.0
// Changes of the mock server's map: all edits of a request are one change, undone and redone as a whole.
import { Refusal } from './mock-refusal.mjs';

/** The map that a request changes, when it names the revision that is there. */
function asked(house, { headers, args }) {
  const map = house.find('maps', args[0]);
  if (!headers['if-match'])
    throw Refusal.ofHttp(
      428,
      'Precondition required',
      'Say in If-Match which revision the change is made against.',
    );
  const { revision } = house.graph;
  const against = /^"r(\d+)"$/.exec(headers['if-match'])?.[1];
  if (Number(against) !== revision)
    throw new Refusal(
      'stale_revision',
      `The map is at revision ${revision}, the change was made against ${against}.`,
      `maps/${map.id}`,
    );
  return map;
}

/** The map as it was taught, with the edits of `log` that stand. */
function changed(house, map, log, revision) {
  house.graph = { ...structuredClone(house.taught), revision };
  for (const one of log.filter(({ undone }) => !undone)) apply(house.graph, one);
  house.edits = log;
  map.revision = revision;
  house.send('map', map);
  return { body: { revision }, headers: { ETag: `"r${revision}"` } };
}

export function edit(house, request) {
  const map = asked(house, request);
  const change = 1 + Math.max(0, ...house.edits.map((one) => one.change));
  const added = request.body.edits.map((one, i) => logged(house.graph, one, request.user.name, change, i));
  const trial = structuredClone(house.graph);
  added.forEach((one, i) => apply(trial, one, `body/edits/${i}`));
  const log = [...house.edits.map((one) => ({ ...one, redoable: false })), ...added];
  return changed(house, map, log, house.graph.revision + added.length);
}

export function undo(house, request) {
  const map = asked(house, request);
  const latest = house.edits.filter((one) => !one.undone).at(-1);
  if (!latest) throw new Refusal('not_found', 'There is no change to undo.');
  return step(house, map, latest.change, { undone: true, redoable: true });
}

export function redo(house, request) {
  const map = asked(house, request);
  const earliest = house.edits.find((one) => one.redoable);
  if (!earliest) throw new Refusal('not_found', 'There is no change to redo.');
  return step(house, map, earliest.change, { undone: false, redoable: false });
}

function step(house, map, change, state) {
  const log = house.edits.map((one) => (one.change === change ? { ...one, ...state } : one));
  return changed(house, map, log, house.graph.revision + 1);
}

/** An edit as it is asked for, in the words of the log. */
function logged(graph, one, by, change, i) {
  const where = `body/edits/${i}`;
  const prototype = (id) => {
    const found = graph.places.find((place) => place.id === id);
    if (!found) throw new Refusal('unknown_place', `There is no place ${id}.`, where);
    return found.prototype;
  };
  const parts = {
    rename: () => ({ image_a: prototype(one.place), image_b: null, text: one.label }),
    block_edge: () => ({
      image_a: prototype(one.from),
      image_b: prototype(one.to),
      text: String(one.blocked),
    }),
    decide_shortcut: () => ({
      image_a: one.image_a,
      image_b: one.image_b,
      text: one.accept ? 'accept' : 'reject',
    }),
  };
  if (!parts[one.kind])
    throw new Refusal(
      'invalid_input',
      `This version applies rename, block_edge and decide_shortcut, not ${one.kind}.`,
      where,
    );
  const t_us = Date.now() * 1000;
  return {
    kind: one.kind,
    ...parts[one.kind](),
    images: [],
    by,
    t_us,
    undone: false,
    change,
    redoable: false,
    lost: null,
  };
}

function apply(graph, { kind, image_a, image_b, text, by }, where) {
  const place_of = (image) => graph.places.find((one) => one.members.includes(image));
  if (kind === 'rename') {
    const place = place_of(image_a);
    place.label = text;
  } else if (kind === 'block_edge') {
    const [from, to] = [place_of(image_a).id, place_of(image_b).id];
    const edge = graph.edges.find((one) => one.from === from && one.to === to);
    if (!edge) throw new Refusal('not_found', `The map has no edge from ${from} to ${to}.`, where);
    edge.blocked = text === 'true';
  } else {
    const found = graph.shortcuts.find((one) => one.image_a === image_a && one.image_b === image_b);
    if (!found)
      throw new Refusal('not_found', `The map has no shortcut between ${image_a} and ${image_b}.`, where);
    Object.assign(found, { state: text === 'accept' ? 'accepted' : 'rejected', by });
  }
}
