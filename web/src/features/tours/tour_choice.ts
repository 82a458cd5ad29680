// SPDX-License-Identifier: Apache-2.0
import type { MapInfo, Tour } from '../../api/types';

/** The tours that a map can be made from, or that can join the map `grown`. */
export function offeredTours(tours: readonly Tour[], grown: MapInfo | null): Tour[] {
  return tours.filter((one) => one.state === 'complete' && !(grown?.tours ?? []).includes(one.id));
}

/**
 * The tour that is meant in all likelihood: the only one that no map was made from yet. Of several nobody can know
 * whether they are of one building; null then.
 */
export function suggested(offered: readonly Tour[], maps: readonly MapInfo[]): string | null {
  const used = new Set(maps.filter((one) => one.state !== 'failed').flatMap((one) => one.tours));
  const unused = offered.filter((one) => !used.has(one.id));
  return unused.length === 1 ? (unused[0]?.id ?? null) : null;
}
