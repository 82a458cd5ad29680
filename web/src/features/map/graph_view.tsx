// SPDX-License-Identifier: Apache-2.0
import type { Core, ElementDefinition } from 'cytoscape';
import { useEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Belief, Graph } from '../../api/types';
import { graphStyle } from './graph_style';
import { drawnEdges, pictureShare, placeViews } from './place_views';
import { proposedLines } from './shortcut_words';

const kSize = 1000; // the unit square of the layout, in the drawing's own units
const kMargin = 26;

interface Props {
  graph: Graph;
  belief: Belief | null;
  way: readonly string[]; // places still to be driven
  chosen: string | null;
  onChoose: (place: string) => void;
}

/** The map as a drawing. Everything it offers is also in the list beside it, so it is hidden from screen readers. */
export function GraphView({ graph, belief, way, chosen, onChoose }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const core = useRef<Core | null>(null);
  const choose = useRef(onChoose);
  choose.current = onChoose;

  const [made, setMade] = useState(0);

  useEffect(() => {
    const container = box.current;
    if (!container) return;
    let destroy: (() => void) | null = null;
    let wanted = true;
    void import('cytoscape').then(({ default: cytoscape }) => {
      if (!wanted) return;
      const views = placeViews(graph, null);
      const diameter = kSize * pictureShare(views);
      const placed = views.every((view) => view.x !== null && view.y !== null);
      leaveStylesToUs();
      const drawing = cytoscape({
        container,
        elements: elementsOf(graph),
        style: graphStyle(diameter, Math.min(container.clientWidth, container.clientHeight) / kSize),
        layout: { name: placed ? 'preset' : 'cose', fit: true, padding: kMargin, animate: false },
        minZoom: 0.1,
        maxZoom: 3,
        autoungrabify: true,
        boxSelectionEnabled: false,
      });
      drawing.on('tap', 'node', (event) => choose.current((event.target as { id(): string }).id()));
      const unwatch = watchLook(drawing, container, diameter);
      core.current = drawing;
      setMade((n) => n + 1);
      destroy = () => {
        unwatch();
        core.current = null;
        drawing.destroy();
      };
    });
    return () => {
      wanted = false;
      destroy?.();
    };
  }, [graph]);

  useEffect(() => {
    const drawing = core.current;
    if (!drawing) return;
    drawing.batch(() => {
      for (const view of placeViews(graph, belief)) {
        const node = drawing.$id(view.id);
        node.data('belief', view.probability);
        node.toggleClass('chosen', view.id === chosen);
      }
      drawing.edges().removeClass('way');
      way.forEach((to, i) => {
        const from = way[i - 1];
        if (from !== undefined) drawing.$id(from < to ? `${from}|${to}` : `${to}|${from}`).addClass('way');
      });
    });
  }, [graph, belief, chosen, way, made]);

  const zoom = (factor: number) => {
    const drawing = core.current;
    if (!drawing) return;
    const centre = { x: drawing.width() / 2, y: drawing.height() / 2 };
    drawing.zoom({ level: drawing.zoom() * factor, renderedPosition: centre });
  };
  return (
    <div class="graph">
      <div class="graph-canvas" ref={box} aria-hidden="true" data-testid="graph" />
      <div class="graph-tools" role="group" aria-label="Size of the drawing">
        <button type="button" aria-label="Larger" onClick={() => zoom(1.4)}>
          +
        </button>
        <button type="button" aria-label="Smaller" onClick={() => zoom(1 / 1.4)}>
          −
        </button>
        <button
          type="button"
          aria-label="Show all"
          onClick={() => void core.current?.fit(undefined, kMargin)}
        >
          ⤢
        </button>
      </div>
    </div>
  );
}

/** Follows the size of the container and the change between light and dark; returns its end. */
function watchLook(drawing: Core, container: HTMLElement, diameter: number): () => void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const restyle = () => void drawing.style(graphStyle(diameter, drawing.zoom()));
  dark.addEventListener('change', restyle);
  const sizes = new ResizeObserver(() => {
    drawing.resize();
    drawing.fit(undefined, kMargin);
    restyle();
  });
  sizes.observe(container);
  return () => {
    dark.removeEventListener('change', restyle);
    sizes.disconnect();
  };
}

/**
 * Cytoscape adds a style element, which the content security policy forbids, unless one of this name is there.
 * Its one rule is in map.css.
 */
function leaveStylesToUs(): void {
  const kName = '__________cytoscape_stylesheet';
  if (document.getElementById(kName)) return;
  const mark = document.createElement('template');
  mark.id = kName;
  document.head.append(mark);
}

function elementsOf(graph: Graph): ElementDefinition[] {
  const nodes = placeViews(graph, null).map((view) => ({
    data: {
      id: view.id,
      ...(view.named ? { name: view.title } : {}),
      belief: 0,
      picture: calls.placeThumbnailUrl(graph.map, view.id, graph.revision),
    },
    position: { x: kSize * (view.x ?? 0), y: kSize * (view.y ?? 0) },
  }));
  const edges = drawnEdges(graph).map((edge) => ({
    data: { id: edge.id, source: edge.from, target: edge.to },
    classes: [edge.weak ? 'weak' : '', `closed-${edge.closed}`, edge.shortcut ? 'shortcut' : ''].join(' '),
  }));
  const proposed = proposedLines(graph).map((line) => ({
    data: { id: line.id, source: line.from, target: line.to },
    classes: 'proposed',
  }));
  return [...nodes, ...edges, ...proposed];
}
