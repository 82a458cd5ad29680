// SPDX-License-Identifier: Apache-2.0
// Types of doubts (proto/schemas/doubts.schema.json), written by hand until proto/openapi.yaml has them. Nothing but types.ts
// imports them, so that the generated ones take their place there.
import type { components } from './generated/openapi';

type Schemas = components['schemas'];

type Decision = Schemas['Hypothesis']['decision'];

/** Something about a map that a person should look at. */
export interface Doubt {
  kind: 'same_place' | 'mixed_place' | 'way';
  image_a: string;
  image_b: string;
  place_a: string;
  place_b: string; // the same as place_a for mixed_place
  state: Decision; // as the map stands: whether they are one place, or the way exists
  by: 'method' | 'person';
  probability: number; // that the map is wrong here
  effect: number; // how much of the map deciding otherwise would change
  weight: number; // probability times effect
  masses_before: Schemas['Masses'] | null;
  masses_after: Schemas['Masses'] | null;
  support: number | null;
  plausibility: number | null;
  neighbours: { place_a: string; place_b: string; for: boolean; weight: number }[];
  reasons: Schemas['Reason'][];
  if_yes: Schemas['Edit'][];
  if_no: Schemas['Edit'][];
}

export interface Doubts {
  format: 'homeward-doubts';
  version: 1;
  map: string;
  revision: number;
  total: number;
  offset: number;
  doubts: Doubt[];
}

/** A server of before says no name. */
export type Place = Omit<Schemas['Place'], 'name'> & { name?: string };
export type Graph = Omit<Schemas['Graph'], 'places'> & { places: Place[] };

interface Numbered {
  v: 1;
  seq: number;
}
export type DraftEvent =
  | (Numbered & { type: 'draft'; draft: Schemas['Draft'] })
  | (Numbered & { type: 'draft_gone'; map: string; draft: string });
