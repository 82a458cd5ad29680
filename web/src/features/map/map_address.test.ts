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
      { map: 'm1', draft: null, page: 'drawing', place: null },
      { map: 'm 1', draft: 'd3', page: 'evidence', place: 'p4' },
      { map: 'draft', draft: 'd/3', page: 'drawing', place: 'p4' },
    ] as const)
      expect(readAddress(pathOf(address))).toEqual(address);
  });

  it('says nothing without a map', () => {
    expect(readAddress('/map')).toBeNull();
    expect(readAddress('/go')).toBeNull();
    expect(pathOf({ map: null, draft: null, page: 'evidence', place: null })).toBe('/map');
    expect(readAddress('/map/m1/%')).toEqual({ map: 'm1', draft: null, page: 'drawing', place: null });
  });
});
