// SPDX-License-Identifier: Apache-2.0
// Types of drafts, doubts and pairs of pictures, written by hand until they are in proto/openapi.yaml. Nothing but types.ts
// imports them, so that the generated ones take their place there.
import type { components } from './generated/openapi';

type Schemas = components['schemas'];

/** Edits of one request that a person may try: on top of a map's revision, and not in use. */
export interface Draft {
  id: string;
  map: string;
  name: string;
  by: string; // who began it
  created_us: number;
  version: number; // rises with each change of it
  revision: number; // of the map that it stands on
  changes: number; // requests that stand
  edits: Schemas['LoggedEdit'][];
  touches: string[]; // places of the map that it changes
  overlaps: { draft: string; by: string; name: string; places: string[] }[];
  check: { job: string; version: number } | null; // the latest that was asked for
}

export type Change = 'added' | 'removed' | 'changed';

interface PlaceState {
  label: string;
  prototype: string;
  images: number;
}
interface EdgeState {
  bearing_rad: number | null;
  weak: boolean;
  blocked: boolean;
  shortcut: boolean;
  by: 'method' | 'person';
}
type DestinationState = Omit<Schemas['Destination'], 'id'>;
type Decision = Schemas['Hypothesis']['decision'];

/** What is other in a later state of a map; `before` is null for what is new, `after` for what is gone. */
export interface Difference {
  format: 'homeward-difference';
  version: 1;
  places: {
    id: string;
    change: Change;
    before: PlaceState | null;
    after: PlaceState | null;
    gained: string[];
    left: string[];
  }[];
  edges: { from: string; to: string; change: Change; before: EdgeState | null; after: EdgeState | null }[];
  destinations: {
    id: string;
    change: Change;
    before: DestinationState | null;
    after: DestinationState | null;
  }[];
  hypotheses: { prototype_a: string; prototype_b: string; before: Decision; after: Decision }[];
  parts_before: number;
  parts_after: number;
}

export interface WorseSpot {
  kind: 'localisation' | 'pictures' | 'places' | 'way' | 'far_way' | 'route';
  place: string;
  other: string | null;
  images: string[];
  of: number;
  distance_m: number;
}

/** What a draft does to recognising the pictures of the tours, against the map without it. */
export interface ReplayCheck {
  format: 'homeward-replay-check';
  version: 1;
  map: string;
  draft: string;
  draft_version: number;
  revision: number;
  pictures: number;
  right_before: number;
  right_after: number;
  lost_before: number;
  lost_after: number;
  routes_before: number;
  routes_after: number;
  harmless: boolean;
  worse: WorseSpot[];
}

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

export interface PointInPicture {
  x: number; // shares of width and height
  y: number;
}

/** Two pictures beside each other, and what is in both. */
export interface Pair {
  format: 'homeward-pair';
  version: 1;
  image_a: string;
  image_b: string;
  distance: number;
  similarity: number;
  turn_rad: number | null;
  shift: number | null; // share of its width by which b is moved to the left to lie below a
  matches: { a: PointInPicture; b: PointInPicture; distinctiveness: number; agrees: boolean }[];
}

export type Place = Schemas['Place'] & { name?: string }; // how it is told from others, in words
export type Graph = Omit<Schemas['Graph'], 'places'> & { places: Place[] };
export type Job = Omit<Schemas['Job'], 'kind'> & { kind: Schemas['Job']['kind'] | 'check' };

interface Numbered {
  v: 1;
  seq: number;
}
export type DraftEvent =
  | (Numbered & { type: 'draft'; draft: Draft })
  | (Numbered & { type: 'draft_gone'; map: string; draft: string });
