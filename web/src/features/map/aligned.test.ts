// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph } from '../../api/types';
import { alignedWith } from './aligned';

type Drawn = readonly [id: string, x: number | null, y: number | null];
const graphOf = (...places: Drawn[]) =>
  ({
    places: places.map(([id, x, y]) => ({ id, x, y, label: '', members: [] })),
    edges: [],
    destinations: [],
  }) as unknown as Graph;
const seen = (graph: Graph) =>
  graph.places.map(({ id, x, y }) => [
    id,
    x === null ? null : +x.toFixed(6),
    y === null ? null : +y.toFixed(6),
  ]);

const known: Drawn[] = [
  ['a', 0.1, 0.1],
  ['b', 0.5, 0.1],
  ['c', 0.5, 0.3],
];

describe('a drawing beside another', () => {
  it('has places where the other has them, and moves what the other lacks with them', () => {
    const turned = (x: number, y: number): [number, number] => [1 - 2 * y, 2 * x - 0.1];
    const other = graphOf(...known.map(([id, x, y]) => [id, ...turned(x ?? 0, y ?? 0)] as const));
    const moved = alignedWith(graphOf(...known, ['gone', 0.2, 0.4]), other);
    expect(seen(moved)).toEqual([
      ...seen(other),
      ['gone', ...turned(0.2, 0.4).map((one) => +one.toFixed(6))],
    ]);
  });

  it('may be mirrored', () => {
    const other = graphOf(...known.map(([id, x, y]) => [id, 1 - (x ?? 0), y] as const));
    const moved = alignedWith(graphOf(...known, ['gone', 0.2, 0.4]), other);
    expect(seen(moved).at(-1)).toEqual(['gone', 0.8, 0.4]);
  });

  it('stays where nothing is in both, and shifts by a single place', () => {
    const graph = graphOf(...known);
    expect(alignedWith(graph, graphOf(['x', 0, 0]))).toBe(graph);
    const moved = alignedWith(graph, graphOf(['a', 0.2, 0.1]));
    expect(seen(moved)).toEqual([
      ['a', 0.2, 0.1],
      ['b', 0.6, 0.1],
      ['c', 0.6, 0.3],
    ]);
    expect(seen(alignedWith(graphOf(...known, ['d', null, null]), graph)).at(-1)).toEqual(['d', null, null]);
  });
});
