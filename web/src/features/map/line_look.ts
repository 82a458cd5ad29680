// SPDX-License-Identifier: Apache-2.0
import { kToneSigns, type Tone } from './difference_words';
import type { Line } from './place_views';

/** Colours are names of tokens.css. */
export interface LineLook {
  colour: string;
  dash: 'solid' | 'dashed' | 'dotted';
  width: number; // as a multiple of a plain line's
  sign: string | null; // in its middle
  text: string; // the sign's colour
}

const kPlain: LineLook = { colour: 'line-strong', dash: 'solid', width: 1, sign: null, text: 'ink' };

/** Of the ways that a robot still has before it. */
export const kWayLook: Partial<LineLook> = { colour: 'brand', width: 2.4 };

const kTones: Readonly<Record<Tone, Partial<LineLook>>> = {
  added: { colour: 'brand', text: 'brand-text' },
  removed: { colour: 'danger', text: 'danger-text' },
  changed: { colour: 'amber', text: 'amber-text' },
};

/** How a way is drawn; what is other with a draft says so first of all. */
export function lineLook(
  line: Pick<Line, 'weak' | 'closed' | 'shortcut'> & { proposed?: boolean },
  tone: Tone | null,
): LineLook {
  return {
    ...kPlain,
    ...(line.weak ? { dash: 'dashed' } : {}),
    ...(line.shortcut ? { colour: 'focus' } : {}),
    ...(line.proposed ? { dash: 'dashed', width: 0.7 } : {}),
    ...(line.closed === 'no' ? {} : { colour: 'danger', dash: 'dotted' }),
    ...(line.closed === 'both' ? { sign: '✕', text: 'danger-text' } : {}),
    ...(tone
      ? {
          ...kTones[tone],
          dash: tone === 'removed' ? 'dashed' : 'solid',
          width: 1.8,
          sign: kToneSigns[tone].sign,
        }
      : {}),
  };
}
