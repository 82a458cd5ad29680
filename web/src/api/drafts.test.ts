// SPDX-License-Identifier: Apache-2.0
import { beforeAll, describe, expect, it, vi } from 'vitest';
import type { Draft } from './types';

let withHeard: typeof import('./drafts').withHeard;
beforeAll(async () => {
  vi.stubGlobal('location', { pathname: '/map', protocol: 'http:', host: 'x' });
  ({ withHeard } = await import('./drafts'));
});

const draft = (id: string, version: number): Draft => ({
  id,
  map: 'm1',
  name: '',
  by: 'anna',
  created_us: Number(id.slice(1)),
  version,
  revision: 1,
  changes: 0,
  edits: [],
  touches: [],
  overlaps: [],
  check: null,
});
const versions = (drafts: readonly Draft[]) => drafts.map((one) => `${one.id} ${one.version}`);

describe('the drafts of a map', () => {
  it('are as the newest word of each says, whatever came first', () => {
    const loaded = [draft('d2', 4), draft('d1', 1)];
    expect(
      versions(withHeard(loaded, { d2: draft('d2', 3) }, { d1: draft('d1', 2), d3: draft('d3', 1) })),
    ).toEqual(['d1 2', 'd2 4', 'd3 1']);
  });

  it('leave out those that are gone', () => {
    expect(versions(withHeard([draft('d1', 1)], { d1: draft('d1', 2) }, { d1: null }))).toEqual([]);
  });
});
