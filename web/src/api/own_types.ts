// SPDX-License-Identifier: Apache-2.0
// Types that are a little wider or narrower than the generated ones. Nothing but types.ts imports them.
import type { components } from './generated/openapi';

type Schemas = components['schemas'];

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
