// SPDX-License-Identifier: Apache-2.0
// @vitest-environment node
import { beforeAll, describe, expect, it, vi } from 'vitest';

type Module = typeof import('./map_address');
let readAddress: Module['readAddress'];
let pathOf: Module['pathOf'];
beforeAll(async () => {
  vi.stubGlobal('location', { pathname: '/map' });
  vi.stubGlobal('addEventListener', () => undefined);
  ({ readAddress, pathOf } = await import('./map_address'));
});

describe('the address of what the map pages show', () => {
  it('is read as it is written', () => {
    for (const address of [
      { map: 'm1', draft: null, page: 'drawing', of: [], place: null },
      { map: 'm 1', draft: 'd3', page: 'evidence', of: [], place: 'p4' },
      { map: 'draft', draft: 'd/3', page: 'drawing', of: [], place: 'p4' },
      { map: 'm1', draft: null, page: 'changes', of: [0], place: null },
      { map: 'm1', draft: 'd3', page: 'changes', of: [2, 5], place: '7' },
      { map: 'm1', draft: null, page: 'similarity', of: [11, 24999], place: null },
    ] as const)
      expect(readAddress(pathOf(address))).toEqual(address);
  });

  it('says nothing without a map', () => {
    expect(readAddress('/map')).toBeNull();
    expect(readAddress('/go')).toBeNull();
    expect(pathOf({ map: null, draft: null, page: 'evidence', of: [], place: null })).toBe('/map');
    expect(readAddress('/map/m1/%')).toEqual({
      map: 'm1',
      draft: null,
      page: 'drawing',
      of: [],
      place: null,
    });
    expect(readAddress('/map/m1/changes/x/5')?.of).toEqual([]);
    expect(readAddress('/map/m1/place/p1/5')?.of).toEqual([]);
  });
});
