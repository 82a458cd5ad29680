// SPDX-License-Identifier: Apache-2.0
import { useMemo } from 'preact/hooks';
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { drawnEdges } from './place_views';

const kWidth = 320;
const kMargin = 26;
const kMost = 240; // high
const kDots = 60; // the side of a square that all places would fill

interface Props {
  graph: Graph;
  marks: readonly { place: string; letter: string }[];
}

/** The whole map in two strokes, however many places it has, with letters at some of them; for the eyes alone. */
export function SmallMap({ graph, marks }: Props) {
  const drawing = useMemo(() => drawingOf(graph), [graph]);
  if (!drawing) return null;
  const { at, height, dots, lines } = drawing;
  const dot = Math.max(1.5, Math.min(6, kDots / Math.sqrt(graph.places.length)));
  const { places } = indexOf(graph);
  // Both letters at one place stand beside each other.
  const beside = marks.length > 1 && marks[0]?.place === marks[1]?.place;
  return (
    <svg class="small-map" viewBox={`0 0 ${kWidth} ${height}`} aria-hidden="true" data-testid="small-map">
      <path class="ways" d={lines} />
      <path class="dots" d={dots} style={{ strokeWidth: dot }} />
      {marks.map(({ place, letter }, i) => {
        const point = at(places.get(place));
        if (!point) return null;
        const x = point.x + (beside ? 24 * i - 12 : 0);
        return (
          <g key={letter} class="mark">
            <circle cx={x} cy={point.y} r="11" />
            <text x={x} y={point.y} dy="0.35em">
              {letter}
            </text>
          </g>
        );
      })}
    </svg>
  );
}

function drawingOf(graph: Graph) {
  const points = graph.places.flatMap(({ x, y }) => (x === null || y === null ? [] : [{ x, y }]));
  if (points.length === 0) return null;
  const range = (of: (one: { x: number; y: number }) => number) =>
    points.reduce<readonly [number, number]>(
      ([least, most], one) => [Math.min(least, of(one)), Math.max(most, of(one))] as const,
      [Infinity, -Infinity],
    );
  const [[left, right], [top, bottom]] = [range((one) => one.x), range((one) => one.y)];
  const factor = Math.min(
    (kWidth - 2 * kMargin) / Math.max(1e-6, right - left),
    (kMost - 2 * kMargin) / Math.max(1e-6, bottom - top),
  );
  const height = Math.round(factor * (bottom - top)) + 2 * kMargin;
  const indent = (kWidth - factor * (right - left)) / 2;
  const at = (one: { x: number | null; y: number | null } | undefined) =>
    one && one.x !== null && one.y !== null
      ? { x: indent + factor * (one.x - left), y: kMargin + factor * (one.y - top) }
      : null;
  const { places } = indexOf(graph);
  const write = (one: { x: number; y: number }) => `${one.x.toFixed(1)} ${one.y.toFixed(1)}`;
  const dots = graph.places.flatMap((one) => at(one) ?? []).map((one) => `M${write(one)}h.01`);
  const lines = drawnEdges(graph).map(({ from, to }) => {
    const [a, b] = [at(places.get(from)), at(places.get(to))];
    return a && b ? `M${write(a)}L${write(b)}` : '';
  });
  return { at, height, dots: dots.join(''), lines: lines.join('') };
}
