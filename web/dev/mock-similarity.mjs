// SPDX-License-Identifier: Apache-2.0
// How alike the pictures of the mock server's map are: the tiles of a matrix, painted as they are asked for.
import { pngOf } from './mock-png.mjs';
import { Refusal, wholeNumber } from './mock-refusal.mjs';

const kTile_px = 256;
const kLast = { level: 30, column: 1e6, row: 1e6 };
const kAlike = [
  [255, 255, 255],
  [170, 205, 235],
  [50, 120, 180],
  [8, 35, 80],
];
const kOnePlace = [21, 115, 71];
const kOpen = [200, 120, 0];
const kApart = [179, 38, 30];

function colourOf(similarity) {
  const place = Math.max(0, Math.min(1, similarity)) * (kAlike.length - 1);
  const below = Math.min(Math.floor(place), kAlike.length - 2);
  return kAlike[below].map((from, i) => Math.round(from + (place - below) * (kAlike[below + 1][i] - from)));
}

function imagesOf(house) {
  return house.taught.places.flatMap((one) => one.members);
}

function similarity(house, map) {
  house.find('maps', map);
  if (!house.built)
    throw new Refusal('not_found', 'The map was not built here; a build keeps its report.', `maps/${map}`);
  const images = imagesOf(house);
  const levels = 1 + Math.max(0, Math.ceil(Math.log2(images.length / kTile_px)));
  return { format: 'homeward-similarity', version: 1, revision: 1, tile_px: kTile_px, levels, images };
}

/** Of pictures so far from each other on the tour, of places of such look. */
function alike(apart, looks) {
  const near = 1 / (1 + 0.25 * apart);
  return Math.max(near, looks[0] === looks[1] ? 0.45 : 0);
}

/** Pixels of decided pairs, below the diagonal. */
function decided({ graph }, images, shift) {
  const at = new Map(images.map((image, i) => [image, i >> shift]));
  const painted = new Map();
  for (const { prototype_a, prototype_b, decision } of graph.hypotheses) {
    const ends = [at.get(prototype_a), at.get(prototype_b)].sort((a, b) => a - b);
    if (decision !== 'accepted') painted.set(ends.join(' '), decision === 'rejected' ? kApart : kOpen);
  }
  return painted;
}

function tile(house, { args: [map, ...numbers] }) {
  const [level, column, row] = Object.entries(kLast).map(([name, last], i) =>
    wholeNumber(numbers[i], last, `path/${name}`),
  );
  const { images, levels } = similarity(house, map);
  const side = Math.ceil(images.length / (kTile_px * 2 ** level));
  if (level >= levels || column >= side || row >= side)
    throw new Refusal('not_found', 'The similarity matrix has no such tile.', 'path');
  const place = new Map(
    house.graph.places.flatMap(({ id, members }, n) => members.map((one) => [one, { id, look: n % 37 }])),
  );
  const of = images.map((image) => place.get(image) ?? { id: null, look: -1 });
  const painted = decided(house, images, level);
  const block = 2 ** level;
  return {
    raw: pngOf(kTile_px, kTile_px, (x, y) => {
      const [u, v] = [column * kTile_px + x, row * kTile_px + y];
      const [a, b] = [of[u * block], of[v * block]];
      if (!a || !b) return kAlike[0];
      if (u >= v) return colourOf(alike(Math.max(0, u - v) * block, [a.look, b.look]));
      const one = a.id !== null && (a.id === b.id || (v === u + 1 && block > 5));
      return painted.get(`${u} ${v}`) ?? (one ? kOnePlace : kAlike[0]);
    }),
    headers: { 'Content-Type': 'image/png', 'Cache-Control': 'private, max-age=60' },
  };
}

export const kSimilarityRoutes = [
  [/^GET maps\/([^/]+)\/similarity$/, 'viewer', (house, { args }) => ({ body: similarity(house, args[0]) })],
  [/^GET maps\/([^/]+)\/similarity\/([^/]+)\/([^/]+)\/([^/]+)$/, 'viewer', tile],
];
