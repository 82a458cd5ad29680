// SPDX-License-Identifier: Apache-2.0
// Changes of the mock server's map: all edits of a request are one change, undone and redone as a whole.
import { tellDrafts } from './mock-drafts.mjs';
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
export function changed(house, map, log, revision) {
  house.graph = { ...structuredClone(house.taught), revision };
  for (const one of log.filter(({ undone }) => !undone)) apply(house.graph, one);
  house.edits = log;
  map.revision = revision;
  house.send('map', map);
  tellDrafts(house, map);
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

/** An edit as it is asked for, in the words of the log: keyed to pictures. */
export function logged(graph, one, by, change, i) {
  const where = `body/edits/${i}`;
  const prototype = (id) => {
    const found = graph.places.find((place) => place.id === id);
    if (!found) throw new Refusal('unknown_place', `There is no place ${id}.`, where);
    return found.prototype;
  };
  const dock = (id) => {
    const found = graph.destinations.find((destination) => destination.id === id);
    if (!found) throw new Refusal('not_found', `The map has no destination ${id}.`, where);
    return found.image;
  };
  const decision = (accept) => (accept ? 'accept' : 'reject');
  const way = () => ({ image_a: prototype(one.from), image_b: prototype(one.to) });
  const parts = {
    rename: () => ({ image_a: prototype(one.place), text: one.label }),
    merge: () => ({ image_a: prototype(one.into), image_b: prototype(one.place) }),
    split: () => ({ image_a: prototype(one.place), images: one.images }),
    delete: () => ({ image_a: prototype(one.place) }),
    move: () => ({ image_a: prototype(one.into), images: one.images }),
    add_edge: way,
    remove_edge: way,
    block_edge: () => ({ ...way(), text: String(one.blocked) }),
    decide: () => ({ image_a: one.prototype_a, image_b: one.prototype_b, text: decision(one.accept) }),
    decide_shortcut: () => ({ image_a: one.image_a, image_b: one.image_b, text: decision(one.accept) }),
    set_aside: () => ({ image_a: one.image_a, image_b: one.image_b, text: one.about }),
    add_destination: () => ({ image_a: one.image, text: one.label }),
    remove_destination: () => ({ image_a: dock(one.destination) }),
    name_destination: () => ({ image_a: dock(one.destination), text: one.label }),
    set_pictogram: () => ({ image_a: dock(one.destination), text: one.pictogram }),
    set_destination_picture: () => ({ image_a: dock(one.destination), image_b: one.image }),
  };
  const t_us = Date.now() * 1000;
  const empty = { image_b: null, text: '', images: [] };
  const standing = { undone: false, change, redoable: false, lost: null };
  return { kind: one.kind, ...empty, ...parts[one.kind](), by, t_us, ...standing };
}

export function apply(graph, { kind, image_a, image_b, text, images, by }, where) {
  const refuse = (code, words) => {
    throw new Refusal(code, words, where);
  };
  const holder = (image) => graph.places.find((one) => one.members.includes(image));
  const place_of = (image) =>
    holder(image) ?? refuse('not_found', `No place of the map holds the image ${image}.`);
  const leave = (place, gone) => {
    const left = place.members.filter((one) => !gone.includes(one));
    if (left.length === 0)
      refuse(
        'invalid_input',
        `Place ${place.id} would be left without pictures: merge it or delete it instead.`,
      );
    place.members = left;
    if (gone.includes(place.prototype)) place.prototype = left[Math.floor(left.length / 2)];
  };
  const join = (from, to) => {
    const known = (a, b) => graph.edges.some((one) => one.from === a && one.to === b);
    const like = { ...graph.edges[0], blocked: false, weak: true, by: 'person' };
    for (const [a, b] of [
      [from, to],
      [to, from],
    ])
      if (!known(a, b)) graph.edges.push({ ...like, from: a, to: b });
  };
  const between = () => {
    const [from, to] = [place_of(image_a).id, place_of(image_b).id];
    if (from === to) refuse('invalid_input', `Both images are in place ${from}.`);
    return [from, to];
  };
  /** On the two pictures; where the method asked nothing about them, a person's own, without any evidence. */
  const hypothesis = () => {
    const own = [image_a, image_b].sort().join(' ');
    const is_it = (one) => [one.prototype_a, one.prototype_b].sort().join(' ') === own;
    const known = graph.hypotheses.find(is_it);
    if (known) return known;
    const nothing = { true: 0, false: 0, unknown: 1 };
    const evidence = { masses_before: nothing, masses_after: nothing, support: 0, plausibility: 1 };
    graph.hypotheses.push({ prototype_a: image_a, prototype_b: image_b, ...evidence });
    return graph.hypotheses.at(-1);
  };
  const destination = (image) => graph.destinations.find((one) => one.image === image);
  const free = (image) => {
    const known = destination(image);
    if (known) refuse('conflict', `The picture ${image} is the destination '${known.label}' already.`);
  };
  const merge = (into, gone) => {
    into.members.push(...gone.members);
    graph.places = graph.places.filter((one) => one !== gone);
    const id = (one) => (one === gone.id ? into.id : one);
    const moved = graph.edges.map((one) => ({ ...one, from: id(one.from), to: id(one.to) }));
    const same = (a, b) => a.from === b.from && a.to === b.to;
    graph.edges = moved.filter(
      (one, i) => one.from !== one.to && moved.findIndex((other) => same(one, other)) === i,
    );
    for (const one of graph.destinations) one.place = id(one.place);
  };
  const steps = {
    rename: () => {
      const place = place_of(image_a);
      Object.assign(place, { label: text, name: text || place.id });
    },
    merge: () => {
      const [into, gone] = [place_of(image_a), place_of(image_b)];
      if (into === gone) refuse('invalid_input', `Both images are in place ${into.id} already.`);
      merge(into, gone);
    },
    split: () => {
      const place = place_of(image_a);
      const absent = images.find((one) => !place.members.includes(one));
      if (absent) refuse('not_found', `Place ${place.id} does not hold the image ${absent}.`);
      leave(place, images);
      const id = `p${1 + Math.max(...graph.places.map((one) => Number(one.id.slice(1))))}`;
      const beside = { x: Math.min(1, place.x + 0.06), y: Math.min(1, place.y + 0.08) };
      graph.places.push({
        ...place,
        ...beside,
        id,
        label: '',
        name: id,
        members: images,
        prototype: images[0],
      });
      for (const one of graph.destinations) if (images.includes(one.image)) one.place = id;
      join(place.id, id);
    },
    move: () => {
      const into = place_of(image_a);
      const going = images.filter((one) => place_of(one) !== into);
      if (going.length === 0) refuse('invalid_input', `Place ${into.id} holds these images already.`);
      for (const one of going) leave(place_of(one), [one]);
      into.members.push(...going);
      for (const one of graph.destinations) if (going.includes(one.image)) one.place = into.id;
    },
    delete: () => {
      const { id } = place_of(image_a);
      graph.places = graph.places.filter((one) => one.id !== id);
      graph.edges = graph.edges.filter((one) => one.from !== id && one.to !== id);
      graph.destinations = graph.destinations.filter((one) => one.place !== id);
    },
    add_edge: () => {
      const [from, to] = between();
      const before = graph.edges.length;
      join(from, to);
      if (graph.edges.length === before)
        refuse('invalid_input', `The map has the way between ${from} and ${to} already.`);
    },
    remove_edge: () => {
      const ends = between();
      const left = graph.edges.filter((one) => !(ends.includes(one.from) && ends.includes(one.to)));
      if (left.length === graph.edges.length)
        refuse('not_found', `The map has no edge from ${ends[0]} to ${ends[1]}.`);
      graph.edges = left;
    },
    block_edge: () => {
      const [from, to] = between();
      const edge = graph.edges.find((one) => one.from === from && one.to === to);
      if (!edge) refuse('not_found', `The map has no edge from ${from} to ${to}.`);
      edge.blocked = text === 'true';
    },
    decide: () => {
      if (image_a === image_b) refuse('invalid_input', 'A hypothesis is about two pictures.');
      const [a, b] = [place_of(image_a), place_of(image_b)];
      if (text === 'accept' && a !== b) merge(a, b);
      Object.assign(hypothesis(), { decision: text === 'accept' ? 'accepted' : 'rejected', by: 'person' });
    },
    decide_shortcut: () => {
      const found = graph.shortcuts.find((one) => one.image_a === image_a && one.image_b === image_b);
      if (!found) refuse('not_found', `The map has no shortcut between ${image_a} and ${image_b}.`);
      Object.assign(found, { state: text === 'accept' ? 'accepted' : 'rejected', by });
    },
    // Kept in the log alone; see the doubts.
    set_aside: () => void [place_of(image_a), place_of(image_b)],
    add_destination: () => {
      const place = place_of(image_a).id;
      free(image_a);
      graph.destinations.push({ id: `d-${image_a}`, place, image: image_a, label: text, pictogram: '' });
    },
    remove_destination: () =>
      (graph.destinations = graph.destinations.filter((one) => one.image !== image_a)),
    name_destination: () => (destination(image_a).label = text),
    set_pictogram: () => (destination(image_a).pictogram = text),
    set_destination_picture: () => {
      const place = place_of(image_b).id;
      free(image_b);
      Object.assign(destination(image_a), { image: image_b, place });
    },
  };
  steps[kind]();
}
