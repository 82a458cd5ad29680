// SPDX-License-Identifier: Apache-2.0
import type { Difference, Graph } from '../../api/types';
import type { Tone } from './difference_words';

/** What a drawing shows of a difference; the gone things are those of the earlier state. */
export interface DifferenceMarks {
  before: Graph;
  places: ReadonlyMap<string, Tone>;
  lines: ReadonlyMap<string, Tone>; // by the id of the line
}

export function lineId(from: string, to: string): string {
  return from < to ? `${from}|${to}` : `${to}|${from}`;
}

export function marksOf(difference: Difference, before: Graph, after: Graph): DifferenceMarks {
  const places = new Map<string, Tone>(difference.places.map(({ id, change }) => [id, change]));
  for (const { change, before: was, after: is } of difference.destinations) {
    const place = (is ?? was)?.place;
    if (place !== undefined && !places.has(place))
      places.set(place, change === 'removed' ? 'changed' : change);
  }
  const lines = new Map<string, Tone>();
  const present = new Set(after.edges.map(({ from, to }) => lineId(from, to)));
  for (const { from, to, change } of difference.edges) {
    const id = lineId(from, to);
    // A line is gone when both its directions are.
    const own = change === 'removed' && present.has(id) ? 'changed' : change;
    const known = lines.get(id);
    lines.set(id, known === undefined || known === own ? own : 'changed');
  }
  return { before, places, lines };
}
