// SPDX-License-Identifier: Apache-2.0
import type { ElementDefinition } from 'cytoscape';
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import type { DifferenceMarks } from './difference_marks';
import { kToneSigns } from './difference_words';
import { drawnEdges, placeViews, type Line, type PlaceView } from './place_views';
import { proposedLines } from './shortcut_words';

/** The unit square of the layout, in the drawing's own units. */
export const kSize = 1000;

/** What is drawn: places, ways, shortcuts that wait; with a draft also what is gone, and a sign at all that is other. */
export function elementsOf(graph: Graph, marks: DifferenceMarks | null): ElementDefinition[] {
  const present = indexOf(graph).places;
  const gone = marks ? placeViews(marks.before).filter((view) => !present.has(view.id)) : [];
  const nodes = [
    ...placeViews(graph).map((view) => nodeOf(graph, view, marks)),
    ...(marks ? gone.map((view) => nodeOf(marks.before, view, marks)) : []),
  ];
  const lines = drawnEdges(graph);
  const drawn = new Set(lines.map((line) => line.id));
  const known = new Set([...present.keys(), ...gone.map((view) => view.id)]);
  const lost = marks
    ? drawnEdges(marks.before).filter(
        ({ id, from, to }) =>
          marks.lines.get(id) === 'removed' && !drawn.has(id) && known.has(from) && known.has(to),
      )
    : [];
  const proposed = proposedLines(graph).map((line) => ({
    data: { id: line.id, source: line.from, target: line.to },
    classes: 'proposed',
  }));
  return [...nodes, ...[...lines, ...lost].map((line) => edgeOf(line, marks)), ...proposed];
}

function nodeOf(graph: Graph, view: PlaceView, marks: DifferenceMarks | null): ElementDefinition {
  const tone = marks?.places.get(view.id);
  const name = tone ? `${kToneSigns[tone].sign} ${view.title}` : view.named ? view.title : null;
  return {
    data: {
      id: view.id,
      ...(name === null ? {} : { name }),
      picture: calls.imageThumbnailUrl(graph.map, indexOf(graph).places.get(view.id)?.prototype ?? ''),
    },
    position: { x: kSize * (view.x ?? 0), y: kSize * (view.y ?? 0) },
    ...(tone ? { classes: tone } : {}),
  };
}

function edgeOf(line: Line, marks: DifferenceMarks | null): ElementDefinition {
  const tone = marks?.lines.get(line.id) ?? '';
  return {
    data: { id: line.id, source: line.from, target: line.to },
    classes: [line.weak ? 'weak' : '', `closed-${line.closed}`, line.shortcut ? 'shortcut' : '', tone].join(
      ' ',
    ),
  };
}
