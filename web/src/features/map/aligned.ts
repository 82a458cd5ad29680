// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';

interface Point {
  x: number;
  y: number;
}

/**
 * `graph` with each place where `other` draws it, so that two drawings can be compared at a glance: every state of a map is laid
 * out by itself. Places that `other` lacks are moved as the rest is, by the least squares fit of a turn, a mirroring, a shift and
 * one factor of size (ours; the fit is Procrustes').
 */
export function alignedWith(graph: Graph, other: Graph): Graph {
  const { places } = indexOf(other);
  const drawn = (place: { x: number | null; y: number | null } | undefined): Point | null =>
    place && place.x !== null && place.y !== null ? { x: place.x, y: place.y } : null;
  const pairs = graph.places.flatMap((one) => {
    const [a, b] = [drawn(one), drawn(places.get(one.id))];
    return a && b ? [{ a, b }] : [];
  });
  if (pairs.length === 0) return graph;
  const move = fitted(pairs);
  return {
    ...graph,
    places: graph.places.map((one) => {
      const own = drawn(one);
      return own ? { ...one, ...(drawn(places.get(one.id)) ?? move(own)) } : one;
    }),
  };
}

function meanOf(points: readonly Point[]): Point {
  const sum = (of: (one: Point) => number) => points.reduce((before, one) => before + of(one), 0);
  return { x: sum((one) => one.x) / points.length, y: sum((one) => one.y) / points.length };
}

function fitted(pairs: readonly { a: Point; b: Point }[]): (point: Point) => Point {
  const mean_a = meanOf(pairs.map((one) => one.a));
  const mean_b = meanOf(pairs.map((one) => one.b));
  const [plain, mirrored] = [1, -1].map((side) => {
    let [along, across, square] = [0, 0, 0];
    for (const { a, b } of pairs) {
      const [ax, ay, bx, by] = [side * (a.x - mean_a.x), a.y - mean_a.y, b.x - mean_b.x, b.y - mean_b.y];
      along += ax * bx + ay * by;
      across += ax * by - ay * bx;
      square += ax * ax + ay * ay;
    }
    return { side, along, across, square };
  }) as [Fit, Fit];
  const best =
    Math.hypot(mirrored.along, mirrored.across) > 1.001 * Math.hypot(plain.along, plain.across)
      ? mirrored
      : plain;
  const [cos, sin] = best.square > 0 ? [best.along / best.square, best.across / best.square] : [1, 0];
  return ({ x, y }) => {
    const [ax, ay] = [best.side * (x - mean_a.x), y - mean_a.y];
    return { x: mean_b.x + cos * ax - sin * ay, y: mean_b.y + sin * ax + cos * ay };
  };
}

interface Fit {
  side: number; // -1: mirrored
  along: number;
  across: number;
  square: number;
}
