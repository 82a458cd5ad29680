// SPDX-License-Identifier: Apache-2.0
// What is other in a later state of the mock server's map, as proto/schemas/difference.schema.json has it.

const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** What is in `before` and `after` by key, where it is not the same. */
function changes(before, after, key, state) {
  const keyed = (all) => new Map(all.map((one) => [key(one), one]));
  const [old, young] = [keyed(before), keyed(after)];
  return [...new Set([...old.keys(), ...young.keys()])].flatMap((one) => {
    const [a, b] = [old, young].map((all) => (all.has(one) ? state(all.get(one)) : null));
    const change = a === null ? 'added' : b === null ? 'removed' : 'changed';
    return same(a, b) ? [] : [{ of: old.get(one) ?? young.get(one), change, before: a, after: b }];
  });
}

/** How many parts the ways leave a map in. */
function partsOf({ places, edges }) {
  const part = new Map(places.map((one) => [one.id, one.id]));
  const root = (id) => {
    while (part.get(id) !== id) {
      part.set(id, part.get(part.get(id))); // the next time the way is half as long
      id = part.get(id);
    }
    return id;
  };
  for (const { from, to, blocked } of edges) if (!blocked) part.set(root(from), root(to));
  return new Set(places.map((one) => root(one.id))).size;
}

export function difference(before, after) {
  const members = (graph, id) => graph.places.find((one) => one.id === id)?.members ?? [];
  const place = ({ label, prototype, members: images }) => ({ label, prototype, images: images.length });
  const edge = ({ bearing_rad, weak, blocked, shortcut, by }) => ({
    bearing_rad,
    weak,
    blocked,
    shortcut,
    by,
  });
  const destination = ({ place: at, image, label, pictogram }) => ({ place: at, image, label, pictogram });
  const places = changes(before.places, after.places, ({ id }) => id, place);
  const edges = changes(before.edges, after.edges, ({ from, to }) => `${from} ${to}`, edge);
  const id = ({ id: own }) => own;
  const destinations = changes(before.destinations, after.destinations, id, destination);
  const pair = ({ prototype_a, prototype_b }) => `${prototype_a} ${prototype_b}`;
  const decision = (one) => one.decision;
  const open = 'undecided'; // as good as what nobody asked about
  const decided = changes(before.hypotheses, after.hypotheses, pair, decision)
    .map(({ of: { prototype_a, prototype_b }, before: was, after: is }) => ({
      prototype_a,
      prototype_b,
      before: was ?? open,
      after: is ?? open,
    }))
    .filter((one) => one.before !== one.after);
  return {
    format: 'homeward-difference',
    version: 1,
    places: places.map(({ of, ...rest }) => {
      const [was, is] = [members(before, of.id), members(after, of.id)];
      const gained = is.filter((one) => !was.includes(one));
      return { id: of.id, ...rest, gained, left: was.filter((one) => !is.includes(one)) };
    }),
    edges: edges.map(({ of, ...rest }) => ({ from: of.from, to: of.to, ...rest })),
    destinations: destinations.map(({ of, ...rest }) => ({ id: of.id, ...rest })),
    hypotheses: decided,
    parts_before: partsOf(before),
    parts_after: partsOf(after),
  };
}
