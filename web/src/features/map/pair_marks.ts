// SPDX-License-Identifier: Apache-2.0
import type { Pair } from '../../api/types';
import { count } from '../../lib/words';

export type Rarity = 'rare' | 'usual' | 'common';

/** A thing that is in both pictures, at shares of what is shown; `number` for those that are joined by a line. */
export interface PairMark {
  number: number | null;
  rarity: Rarity;
  a: { x: number; y: number };
  b: { x: number; y: number };
}

const kNumbered = 12;
const kMost = 60;
const kRare = 0.66;
const kUsual = 0.33;
const kFarAcross = 0.5; // a line over more than this leads around the edge of a panorama: it would cross everything

function rarityOf(distinctiveness: number): Rarity {
  return distinctiveness >= kRare ? 'rare' : distinctiveness >= kUsual ? 'usual' : 'common';
}

/** What is drawn over two pictures, of which the second is moved to the left by `shift` of its width. */
export function pairMarks({ matches, shift }: Pick<Pair, 'matches' | 'shift'>): PairMark[] {
  const moved = (x: number) => (shift === null ? x : (((x - shift) % 1) + 1) % 1);
  const drawn = matches
    .filter((one) => one.agrees)
    .sort((one, other) => other.distinctiveness - one.distinctiveness)
    .slice(0, kMost)
    .map(({ a, b, distinctiveness }) => ({
      rarity: rarityOf(distinctiveness),
      a,
      b: { x: moved(b.x), y: b.y },
    }));
  let numbers = 0;
  return drawn.map((one) => {
    const joined = numbers < kNumbered && Math.abs(one.a.x - one.b.x) < kFarAcross;
    return { ...one, number: joined ? (numbers += 1) : null };
  });
}

/** The same for those who do not see it. */
export function pairWords({ matches }: Pick<Pair, 'matches'>): string {
  if (matches.length === 0) return 'Nothing was found that is in both pictures.';
  const agreeing = matches.filter((one) => one.agrees);
  const rare = agreeing.filter((one) => rarityOf(one.distinctiveness) === 'rare').length;
  const found = `${count(matches.length, 'thing')} ${matches.length === 1 ? 'is' : 'are'} in both pictures`;
  return `${found}; ${agreeing.length} of them lie as they would for one and the same place, ${rare} of these are rare in the house.`;
}
