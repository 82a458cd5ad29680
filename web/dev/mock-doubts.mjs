// SPDX-License-Identifier: Apache-2.0
// What of the mock server's map a person should look at, and two pictures beside each other.
import { Refusal } from './mock-refusal.mjs';

const kKinds = ['same_place', 'mixed_place', 'way'];
const kUsual = 20; // on a page
const kMost = 1000;

/** From the hypotheses, and from the ways that are hard to drive. */
function allDoubts(house) {
  const { graph } = house;
  const holder = (image) => graph.places.find((one) => one.members.includes(image))?.id;
  const pairs = graph.hypotheses.flatMap((one) => {
    const { prototype_a: image_a, prototype_b: image_b, decision, by } = one;
    const [place_a, place_b] = [holder(image_a), holder(image_b)];
    if (!place_a || !place_b) return [];
    const apart = place_a !== place_b;
    const decide = (accept) => [{ kind: 'decide', prototype_a: image_a, prototype_b: image_b, accept }];
    const effect = apart ? 0.6 - 0.3 * (one.support === 1) : 0.2;
    const probability = decision === 'undecided' ? 0.45 : by === 'person' ? 0.02 : 0.12;
    return {
      kind: 'same_place',
      image_a,
      image_b,
      place_a,
      place_b,
      state: decision,
      by,
      probability,
      effect,
      weight: probability * effect,
      masses_before: one.masses_before,
      masses_after: one.masses_after,
      support: one.support,
      plausibility: one.plausibility,
      neighbours: [
        { place_a: 'p3', place_b: 'p6', for: true, weight: 0.4 },
        { place_a: 'p1', place_b: 'p7', for: false, weight: 0.7 },
      ],
      reasons: [{ code: 'text', parameters: { text: 'The two pictures have much in common' } }],
      if_yes: decision === 'accepted' ? [] : decide(true),
      if_no: decision === 'rejected' ? [] : decide(false),
    };
  });
  const weak = graph.edges
    .filter(({ from, to, weak }) => weak && from < to)
    .map(({ from, to, by, confidence }) => ({
      kind: 'way',
      image_a: graph.places.find((one) => one.id === from).prototype,
      image_b: graph.places.find((one) => one.id === to).prototype,
      place_a: from,
      place_b: to,
      state: 'accepted',
      by,
      probability: 1 - confidence,
      effect: 0.5,
      weight: 0.5 * (1 - confidence),
      masses_before: null,
      masses_after: null,
      support: null,
      plausibility: null,
      neighbours: [],
      reasons: [],
      if_yes: [],
      if_no: [{ kind: 'remove_edge', from, to }],
    }));
  const all = [...pairs, ...weak, ...(house.moreDoubts ?? [])].map((one) => ({
    ...one,
    set_aside_by: setAsideBy(house, one),
  }));
  const last = (one) => Number(one.set_aside_by !== null);
  return all.sort((a, b) => last(a) - last(b) || b.weight - a.weight);
}

/** Who was not sure of a doubt that nobody has decided since. */
function setAsideBy({ edits }, { kind, image_a, image_b, by, state }) {
  if (by === 'person' && state !== 'undecided') return null;
  const own = [image_a, image_b].sort().join(' ');
  const found = edits.findLast(
    (one) =>
      one.kind === 'set_aside' &&
      !one.undone &&
      one.text === kind &&
      [one.image_a, one.image_b].sort().join(' ') === own,
  );
  return found?.by ?? null;
}

const isDecided = (one) => one.by === 'person';

const kAbout = {
  asked: (one) => !isDecided(one),
  undecided: (one) => !isDecided(one) && one.state === 'undecided',
  close: (one) => !isDecided(one) && one.state !== 'undecided',
  decided: isDecided,
  all: () => true,
};

/** One of the words that a query may say; null where it says nothing. */
function choice(query, name, known) {
  const text = query.get(name);
  if (text === null || known.includes(text)) return text;
  throw new Refusal('invalid_input', `'${text}' is none of ${known.join(', ')}.`, `query/${name}`);
}

function count(query, name, least, most) {
  const text = query.get(name);
  if (text === null) return null;
  if (/^\d+$/.test(text) && Number(text) >= least && Number(text) <= most) return Number(text);
  throw new Refusal('invalid_input', `Between ${least} and ${most} can be asked for.`, `query/${name}`);
}

function doubts(house, { args, query }) {
  const about = kAbout[choice(query, 'about', Object.keys(kAbout)) ?? 'asked'];
  const kind = choice(query, 'kind', kKinds);
  const place = query.get('place');
  const offset = count(query, 'offset', 0, 1e6) ?? 0;
  const limit = count(query, 'limit', 1, kMost) ?? kUsual;
  const map = house.find('maps', args[0]);
  if (place !== null && !house.graph.places.some((one) => one.id === place))
    throw new Refusal('unknown_place', `The map has no place ${place}.`, 'query/place');
  const found = allDoubts(house)
    .filter(about)
    .filter((one) => !kind || one.kind === kind)
    .filter((one) => !place || one.place_a === place || one.place_b === place);
  return {
    body: {
      format: 'homeward-doubts',
      version: 1,
      map: map.id,
      revision: house.graph.revision,
      total: found.length,
      offset,
      doubts: found.slice(offset, offset + limit),
    },
  };
}

/** Two pictures of the drawn house look much alike; the later is turned a little. */
function pair(house, { args, query }) {
  const [image_a, image_b] = ['image_a', 'image_b'].map((name) => {
    if (query.get(name)) return query.get(name);
    throw new Refusal('invalid_input', `Name a picture as ${name}.`, `query/${name}`);
  });
  house.find('maps', args[0]);
  const known = (image) => house.graph.places.some((one) => one.members.includes(image));
  for (const image of [image_a, image_b])
    if (!known(image)) throw new Refusal('not_found', `The map has no picture ${image}.`, `images/${image}`);
  const shift = 0.08;
  const matches = Array.from({ length: 16 }, (_, i) => {
    const a = { x: (0.07 + 0.053 * i) % 1, y: 0.25 + 0.5 * ((i * 7) % 10) * 0.1 };
    const agrees = i % 5 !== 4;
    const b = { x: (a.x + shift + (agrees ? 0.004 * (i % 3) : 0.3)) % 1, y: a.y + 0.01 };
    return { a, b, distinctiveness: 1 - i / 16, agrees };
  });
  return {
    body: {
      format: 'homeward-pair',
      version: 1,
      image_a,
      image_b,
      distance: 1.2,
      similarity: 0.4,
      turn_rad: -2 * Math.PI * shift,
      shift,
      matches,
    },
  };
}

export const kDoubtRoutes = [
  [/^GET maps\/([^/]+)\/doubts$/, 'viewer', doubts],
  [/^GET maps\/([^/]+)\/pair$/, 'viewer', pair],
];
