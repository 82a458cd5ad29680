// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';

/** While a place is looked for in the drawing: what a press on one does instead of showing it. */
export interface Picking {
  what: string; // it is looked for, as a sentence
  pick: (place: string) => void;
}

export const picking = signal<Picking | null>(null);
