// SPDX-License-Identifier: Apache-2.0
import { computed, effect, signal } from '@preact/signals';
import { navigate, path } from '../../lib/router';

export const kMapPages = ['drawing', 'plan', 'evidence', 'changes', 'report', 'similarity'] as const;
export type MapPageName = (typeof kMapPages)[number];

/** What of the map pages an address shows: /map/m1/draft/d3/evidence/place/p4, /map/m1/changes/2/5. */
export interface MapAddress {
  map: string | null; // null: the one that the page would show by itself
  draft: string | null;
  page: MapPageName;
  of: readonly number[]; // what the page is about: of changes two of them, of similarity two pictures
  place: string | null;
}

const kNowhere: MapAddress = { map: null, draft: null, page: 'drawing', of: [], place: null };

/** The address that a path says; null for one that names no map. */
export function readAddress(pathname: string): MapAddress | null {
  const [first, map, ...rest] = pathname.split('/').filter(Boolean).map(decoded);
  if (first !== 'map' || map === undefined) return null;
  const after = (word: string) => {
    const at = rest.indexOf(word);
    return at < 0 ? null : (rest[at + 1] ?? null);
  };
  const page = kMapPages.find((one) => one !== 'drawing' && rest.includes(one)) ?? 'drawing';
  return { map, draft: after('draft'), page, of: numbersAfter(rest, page), place: after('place') };
}

function numbersAfter(parts: readonly string[], page: MapPageName): number[] {
  const at = parts.indexOf(page);
  const [a = '', b = ''] = at < 0 ? [] : parts.slice(at + 1);
  const own = /^\d{1,9}$/.test(a) ? (/^\d{1,9}$/.test(b) ? [a, b] : [a]) : [];
  return own.map(Number);
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

export function pathOf({ map, draft, page, of, place }: MapAddress): string {
  if (map === null) return '/map';
  const parts = [
    'map',
    map,
    ...(draft === null ? [] : ['draft', draft]),
    ...(page === 'drawing' ? [] : [page, ...of.map(String)]),
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
  () => readAddress(path.value) ?? { ...latest.value, page: 'drawing', of: [] },
);

/** Shows something else of `map`; what is not named stays as it is. */
export function show(map: string, part: Partial<Omit<MapAddress, 'map'>>): void {
  const present = mapAddress.peek();
  const kept = present.map === null || present.map === map ? present : kNowhere;
  navigate(pathOf({ ...kept, ...part, map }));
}
