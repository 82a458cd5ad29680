// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import type { DifferenceMarks } from './difference_marks';
import { kToneSigns, type Tone } from './difference_words';
import { lineLook, type LineLook } from './line_look';
import { drawnEdges, placeViews, type PlaceView } from './place_views';
import { proposedLines } from './shortcut_words';

/** The unit square of the layout, in the drawing's own units. */
export const kSize = 1000;

/** In the drawing's own units. */
export interface Spot {
  x: number;
  y: number;
}

export interface DrawnPlace extends Spot {
  id: string;
  name: string | null; // that stands below it
  tone: Tone | null;
  picture: string; // its address
}

export interface DrawnLine {
  id: string;
  from: Spot;
  to: Spot;
  look: LineLook;
  ahead: LineLook; // the same while a robot has it before it
}

/** What is drawn: places, ways, shortcuts that wait; with a draft also what is gone, and a sign at all that is other. */
export interface GraphContent {
  places: readonly DrawnPlace[];
  lines: readonly DrawnLine[];
  at: ReadonlyMap<string, DrawnPlace>; // by id
}

/** `spots`, where they are given, in place of the graph's own. */
export function contentOf(
  graph: Graph,
  marks: DifferenceMarks | null,
  spots: ReadonlyMap<string, Spot> | null = null,
): GraphContent {
  const present = indexOf(graph).places;
  const gone = marks ? placeViews(marks.before).filter((view) => !present.has(view.id)) : [];
  const places = [
    ...placeViews(graph).map((view) => placeOf(graph, view, marks, spots)),
    ...(marks ? gone.map((view) => placeOf(marks.before, view, marks, spots)) : []),
  ];
  const at = new Map(places.map((one) => [one.id, one]));
  const lines = drawnEdges(graph);
  const drawn = new Set(lines.map((line) => line.id));
  const lost = marks
    ? drawnEdges(marks.before).filter(({ id }) => marks.lines.get(id) === 'removed' && !drawn.has(id))
    : [];
  const proposed = proposedLines(graph).map((line) => ({
    ...line,
    weak: false,
    closed: 'no' as const,
    shortcut: true,
    proposed: true,
  }));
  const all = [...lines, ...lost, ...proposed].flatMap((line) => {
    const [from, to] = [at.get(line.from), at.get(line.to)];
    const tone = marks?.lines.get(line.id) ?? null;
    const { id } = line;
    return from && to
      ? [{ id, from, to, look: lineLook(line, tone), ahead: lineLook(line, tone, true) }]
      : [];
  });
  return { places, lines: all, at };
}

function placeOf(
  graph: Graph,
  view: PlaceView,
  marks: DifferenceMarks | null,
  spots: ReadonlyMap<string, Spot> | null,
): DrawnPlace {
  const tone = marks?.places.get(view.id) ?? null;
  const name = tone ? `${kToneSigns[tone].sign} ${view.title}` : view.named ? view.title : null;
  const own = { x: kSize * (view.x ?? 0), y: kSize * (view.y ?? 0) };
  return {
    id: view.id,
    name,
    tone,
    picture: calls.imageThumbnailUrl(graph.map, indexOf(graph).places.get(view.id)?.prototype ?? ''),
    ...(spots?.get(view.id) ?? own),
  };
}
