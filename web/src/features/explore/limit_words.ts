// SPDX-License-Identifier: Apache-2.0
import type { Limits } from '../../api/calls';
import { numberOf } from './fence_words';

/** Limits as they are typed. */
export interface TypedLimits {
  minutes: string;
  metres: string;
  back: string; // minutes
}

const kMostMinutes = 16_000;
const kMostMetres = 100_000;

/** The limits that the fields say; null where one says no number, or one that is out of range. */
export function limitsOf({ minutes, metres, back }: TypedLimits): Limits | null {
  const limits: Limits = {};
  const fields = [
    ['limit_s', minutes, 60, kMostMinutes],
    ['limit_m', metres, 1, kMostMetres],
    ['back_after_s', back, 60, kMostMinutes],
  ] as const;
  for (const [key, text, unit, most] of fields) {
    const value = numberOf(text);
    if (value === null) continue;
    if (value === undefined || value < 1 || value > most) return null;
    limits[key] = value * unit;
  }
  return limits;
}
