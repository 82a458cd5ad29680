// SPDX-License-Identifier: Apache-2.0
import type { Core } from 'cytoscape';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Belief, Graph } from '../../api/types';
import type { DifferenceMarks } from './difference_marks';
import { elementsOf, kSize } from './graph_elements';
import { graphStyle } from './graph_style';
import { showDetailInView } from './detail_in_view';
import type { LinkedDrawings } from './linked_drawings';
import { picking } from './picking';
import { PlaceMarks } from './place_marks';
import { pictureShare, placeViews, probabilities } from './place_views';

const kMarginPx = { x: 56, y: 30 }; // names stand below their places and reach beyond them
const kLargestPicturePx = 120;
const kManyPlaces = 500; // from here on the drawing moves as a picture of itself

interface Props {
  graph: Graph;
  belief: Belief | null;
  way: readonly string[]; // places still to be driven
  chosen: string | null;
  marks?: DifferenceMarks | null; // what is other with the draft or the state that is shown
  linked?: LinkedDrawings | null; // it moves with these
  onChoose: (place: string) => void;
}

/** The map as a drawing. Everything it offers is also in the list beside it, so it is hidden from screen readers. */
export function GraphView({ graph, belief, way, chosen, marks = null, linked = null, onChoose }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const [drawing, setDrawing] = useState<Core | null>(null);
  const choose = useRef(onChoose);
  choose.current = onChoose;
  const diameter = useMemo(() => kSize * pictureShare(placeViews(graph)), [graph]);
  const shares = useMemo(() => probabilities(belief), [belief]);
  const look = useRef<{ map: string; zoom: number; pan: { x: number; y: number } } | null>(null);

  useEffect(() => {
    const container = box.current;
    if (!container) return;
    let destroy: (() => void) | null = null;
    let wanted = true;
    // The list is shown first: to draw thousands of places takes a while.
    void Promise.all([import('cytoscape'), nextPaint()]).then(([{ default: cytoscape }]) => {
      if (!wanted) return;
      const views = placeViews(graph);
      const placed = views.every((view) => view.x !== null && view.y !== null);
      leaveStylesToUs();
      const made = cytoscape({
        container,
        elements: elementsOf(graph, marks),
        style: graphStyle(diameter),
        layout: { name: placed ? 'preset' : 'cose', fit: false, animate: false },
        minZoom: 0.1,
        maxZoom: Math.max(3, kLargestPicturePx / diameter),
        autoungrabify: true,
        boxSelectionEnabled: false,
        textureOnViewport: views.length > kManyPlaces,
      });
      // A change of the map leaves what the reader looks at where it was.
      if (look.current?.map === graph.map) made.viewport(look.current);
      else showAll(made, diameter);
      made.on('tap', 'node', (event) => choose.current((event.target as { id(): string }).id()));
      const unwatch = watchLook(made, container, diameter);
      const forget = showDetailInView(made, diameter);
      const unlink = linked?.join(made);
      setDrawing(made);
      destroy = () => {
        look.current = { map: graph.map, zoom: made.zoom(), pan: { ...made.pan() } };
        unlink?.();
        unwatch();
        forget();
        setDrawing(null);
        made.destroy();
      };
    });
    return () => {
      wanted = false;
      destroy?.();
    };
  }, [graph, diameter, marks, linked]);

  useEffect(() => {
    if (!drawing) return;
    drawing.batch(() => {
      drawing.edges('.way').removeClass('way');
      way.forEach((to, i) => {
        const from = way[i - 1];
        if (from !== undefined) drawing.$id(from < to ? `${from}|${to}` : `${to}|${from}`).addClass('way');
      });
    });
  }, [drawing, way]);

  useEffect(() => {
    const node = drawing?.$id(chosen ?? '');
    if (!drawing || !node?.nonempty()) return;
    const { x, y } = node.position();
    const { x1, x2, y1, y2 } = drawing.extent();
    if (x < x1 || x > x2 || y < y1 || y > y2) drawing.center(node);
  }, [drawing, chosen]);

  const zoom = (factor: number) => {
    if (!drawing) return;
    const centre = { x: drawing.width() / 2, y: drawing.height() / 2 };
    drawing.zoom({ level: drawing.zoom() * factor, renderedPosition: centre });
  };
  return (
    <div class="graph">
      <div class="graph-canvas" ref={box} aria-hidden="true" data-testid="graph" />
      {picking.value && <p class="graph-pick">{picking.value.what}: press it in the drawing.</p>}
      <PlaceMarks drawing={drawing} diameter={diameter} shares={shares} chosen={chosen} />
      <div class="graph-tools" role="group" aria-label="Size of the drawing">
        <button type="button" aria-label="Larger" onClick={() => zoom(1.4)}>
          +
        </button>
        <button type="button" aria-label="Smaller" onClick={() => zoom(1 / 1.4)}>
          −
        </button>
        <button type="button" aria-label="Show all" onClick={() => drawing && showAll(drawing, diameter)}>
          ⤢
        </button>
      </div>
    </div>
  );
}

/** Once the page as it is has been painted. */
function nextPaint(): Promise<void> {
  return new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
}

/** All places in view. Cytoscape's own fit measures every name and line of the drawing. */
function showAll(drawing: Core, diameter: number): void {
  const points = drawing.nodes().map((node) => node.position());
  if (points.length === 0) return;
  const [x1, y1] = [Math.min(...points.map((one) => one.x)), Math.min(...points.map((one) => one.y))];
  const [x2, y2] = [Math.max(...points.map((one) => one.x)), Math.max(...points.map((one) => one.y))];
  const zoom = Math.min(
    (drawing.width() - 2 * kMarginPx.x) / (x2 - x1 + diameter),
    (drawing.height() - 2 * kMarginPx.y) / (y2 - y1 + diameter),
    drawing.maxZoom(),
  );
  if (!(zoom > 0)) return; // the container has no size yet
  drawing.viewport({
    zoom,
    pan: {
      x: (drawing.width() - zoom * (x1 + x2)) / 2,
      y: (drawing.height() - zoom * (y1 + y2)) / 2,
    },
  });
}

/** Follows the size of the container and the change between light and dark; returns its end. */
function watchLook(drawing: Core, container: HTMLElement, diameter: number): () => void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const restyle = () => void drawing.style(graphStyle(diameter));
  dark.addEventListener('change', restyle);
  let size = `${container.clientWidth} x ${container.clientHeight}`;
  const sizes = new ResizeObserver(() => {
    const present = `${container.clientWidth} x ${container.clientHeight}`;
    if (present === size) return; // an observer tells the size once at first
    size = present;
    drawing.resize();
    showAll(drawing, diameter);
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
