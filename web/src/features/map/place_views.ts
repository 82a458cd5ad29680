// SPDX-License-Identifier: Apache-2.0
import type { Belief, Edge, Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';

/** A place as the list and the drawing show it. */
export interface PlaceView {
  id: string;
  title: string;
  named: boolean;
  sought: string; // what a search looks through
  x: number | null;
  y: number | null;
}

const known = new WeakMap<Graph, readonly PlaceView[]>();
const order = new Intl.Collator();

/** All places: those with a name first, by name, then the rest in the order of the map. Made once for each graph. */
export function placeViews(graph: Graph): readonly PlaceView[] {
  let views = known.get(graph);
  if (!views) known.set(graph, (views = viewsOf(graph)));
  return views;
}

function viewsOf(graph: Graph): readonly PlaceView[] {
  const { names } = indexOf(graph);
  const views = graph.places.map(({ id, x, y }) => {
    const title = placeTitle(graph, id);
    return { id, title, named: names.has(id), sought: `${title} ${id}`.toLowerCase(), x, y };
  });
  const named = views.filter((one) => one.named).sort((a, b) => order.compare(a.title, b.title));
  return [...named, ...views.filter((one) => !one.named)];
}

/** How probable it is for each place that a robot is there; places that the belief does not tell of are left out. */
export function probabilities(belief: Belief | null): ReadonlyMap<string, number> {
  const shares = new Map<string, number>();
  if (!belief || belief.lost) return shares;
  if (belief.place !== null) shares.set(belief.place, belief.probability ?? 0);
  for (const { place, probability } of belief.top) shares.set(place, probability);
  return shares;
}

/** Places whose title or id holds every word of `text`. */
export function matching(views: readonly PlaceView[], text: string): readonly PlaceView[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return words.length === 0
    ? views
    : views.filter((view) => words.every((word) => view.sought.includes(word)));
}

/** One way out of a place; two directed edges between the same places are one way. */
export interface WayOut {
  other: string;
  length_m: number;
  weak: boolean;
  closed: 'no' | 'one_way' | 'both'; // to no direction that it has, to one of two, or to all
  shortcut: boolean;
}

export function waysOut(graph: Graph, place: string): WayOut[] {
  const ways = new Map<string, WayOut>();
  for (const edge of graph.edges) {
    const other = otherEnd(edge, place);
    if (other === null) continue;
    const seen = ways.get(other);
    ways.set(other, {
      other,
      length_m: seen ? Math.max(seen.length_m, edge.length_m) : edge.length_m,
      weak: edge.weak || (seen?.weak ?? false),
      closed: withDirection(seen?.closed ?? null, edge.blocked),
      shortcut: edge.shortcut,
    });
  }
  return [...ways.values()];
}

/** How closed a way is when one more direction of it is known; null: it is the first. */
function withDirection(before: WayOut['closed'] | null, blocked: boolean): WayOut['closed'] {
  const own = blocked ? 'both' : 'no';
  return before === null || before === own ? own : 'one_way';
}

function otherEnd(edge: Edge, place: string): string | null {
  if (edge.from === place) return edge.to;
  return edge.to === place ? edge.from : null;
}

/** An edge to draw. */
export interface Line {
  id: string;
  from: string;
  to: string;
  weak: boolean;
  closed: WayOut['closed'];
  shortcut: boolean;
}

/** The edges to draw: one line for two directions. */
export function drawnEdges(graph: Graph): Line[] {
  const lines = new Map<string, Line>();
  for (const edge of graph.edges) {
    const id = edge.from < edge.to ? `${edge.from}|${edge.to}` : `${edge.to}|${edge.from}`;
    const seen = lines.get(id);
    lines.set(id, {
      id,
      from: edge.from,
      to: edge.to,
      weak: edge.weak || (seen?.weak ?? false),
      closed: withDirection(seen?.closed ?? null, edge.blocked),
      shortcut: edge.shortcut,
    });
  }
  return [...lines.values()];
}

/** A diameter at which most pictures of places do not overlap, as a share of the drawing's width. */
export function pictureShare(views: readonly PlaceView[]): number {
  const points = views.flatMap(({ x, y }) => (x === null || y === null ? [] : [{ x, y }]));
  const nearest = nearestDistances(points).sort((a, b) => a - b);
  const typical = nearest[Math.floor(nearest.length / 4)] ?? 0.2;
  const least = Math.min(0.03, 0.3 / Math.sqrt(points.length));
  return Math.min(0.14, Math.max(least, 0.85 * typical));
}

/** The distance of each point to its nearest other, at most 1; by a sweep, as points beyond the nearest in x alone need no look. */
function nearestDistances(points: readonly { x: number; y: number }[]): number[] {
  const sorted = [...points].sort((a, b) => a.x - b.x);
  return sorted.map((a, i) => {
    let nearest = 1;
    for (const step of [-1, 1])
      for (let j = i + step; ; j += step) {
        const b = sorted[j];
        if (!b || Math.abs(b.x - a.x) >= nearest) break;
        nearest = Math.min(nearest, Math.hypot(a.x - b.x, a.y - b.y));
      }
    return nearest;
  });
}
