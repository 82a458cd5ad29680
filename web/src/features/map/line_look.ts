// SPDX-License-Identifier: Apache-2.0
import { kToneSigns, type Tone } from './difference_words';
import type { Line } from './place_views';

/** Colours are names of tokens.css. */
export interface LineLook {
  colour: string;
  dash: 'solid' | 'dashed' | 'dotted';
  width: number; // as a multiple of a plain line's
  rank: number; // what is of a higher one lies above
  sign: string | null; // in its middle
  text: string; // the sign's colour
}

const kPlain: LineLook = {
  colour: 'line-strong',
  dash: 'solid',
  width: 1,
  rank: 0,
  sign: null,
  text: 'ink',
};

/** What is other with a draft, ways and places alike. */
export const kToneColours: Readonly<Record<Tone, string>> = {
  added: 'brand',
  removed: 'danger',
  changed: 'amber',
};

/**
 * How a way is drawn; what is other with a draft says so first of all, then what is closed. `ahead`: a robot still has it before
 * it.
 */
export function lineLook(
  line: Pick<Line, 'weak' | 'closed' | 'shortcut'> & { proposed?: boolean },
  tone: Tone | null,
  ahead = false,
): LineLook {
  return {
    ...kPlain,
    ...(line.weak ? { dash: 'dashed' } : {}),
    ...(line.shortcut ? { colour: 'focus' } : {}),
    ...(line.proposed ? { dash: 'dashed', width: 0.7, rank: 1 } : {}),
    ...(ahead ? { colour: 'brand', width: 2.4, rank: 2 } : {}),
    ...(line.closed === 'no' ? {} : { colour: 'danger', dash: 'dotted' }),
    ...(line.closed === 'both' ? { sign: '✕', text: 'danger-text' } : {}),
    ...(tone
      ? {
          colour: kToneColours[tone],
          text: `${kToneColours[tone]}-text`,
          dash: tone === 'removed' ? 'dashed' : 'solid',
          width: 1.8,
          rank: 3,
          sign: kToneSigns[tone].sign,
        }
      : {}),
  };
}
