// SPDX-License-Identifier: Apache-2.0
import { computed, effect, signal } from '@preact/signals';
import { navigate, path } from '../../lib/router';

/** What of the map pages an address shows: /map/m1/draft/d3/evidence/place/p4. */
export interface MapAddress {
  map: string | null; // null: the one that the page would show by itself
  draft: string | null;
  page: 'drawing' | 'evidence';
  place: string | null;
}

const kNowhere: MapAddress = { map: null, draft: null, page: 'drawing', place: null };

/** The address that a path says; null for one that names no map. */
export function readAddress(pathname: string): MapAddress | null {
  const [first, map, ...rest] = pathname.split('/').filter(Boolean).map(decoded);
  if (first !== 'map' || map === undefined) return null;
  const after = (word: string) => {
    const at = rest.indexOf(word);
    return at < 0 ? null : (rest[at + 1] ?? null);
  };
  const page = rest.includes('evidence') ? 'evidence' : 'drawing';
  return { map, draft: after('draft'), page, place: after('place') };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

export function pathOf({ map, draft, page, place }: MapAddress): string {
  if (map === null) return '/map';
  const parts = [
    'map',
    map,
    ...(draft === null ? [] : ['draft', draft]),
    ...(page === 'drawing' ? [] : [page]),
    ...(place === null ? [] : ['place', place]),
  ];
  return `/${parts.map(encodeURIComponent).join('/')}`;
}

const latest = signal(kNowhere);
effect(() => {
  const said = readAddress(path.value);
  if (said) latest.value = said;
});

/** What is to be shown: as the address says; where it says nothing, what was looked at last. */
export const mapAddress = computed<MapAddress>(
  () => readAddress(path.value) ?? { ...latest.value, page: 'drawing' },
);

/** Shows something else of `map`; what is not named stays as it is. */
export function show(map: string, part: Partial<Omit<MapAddress, 'map'>>): void {
  const present = mapAddress.peek();
  const kept = present.map === null || present.map === map ? present : kNowhere;
  navigate(pathOf({ ...kept, ...part, map }));
}
