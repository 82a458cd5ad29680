// SPDX-License-Identifier: Apache-2.0
import type { Core } from 'cytoscape';
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Belief, Graph } from '../../api/types';
import { lineId, type DifferenceMarks } from './difference_marks';
import { contentOf, kSize, type GraphContent, type Spot } from './graph_content';
import { graphStyle } from './graph_style';
import type { LinkedDrawings } from './linked_drawings';
import { picking } from './picking';
import { PlaceMarks } from './place_marks';
import { pictureShare, placeViews, probabilities } from './place_views';
import { nearestWithin, showPlacesInView } from './places_in_view';
import { spotsFor } from './spots';
import { WaysLayer } from './ways_layer';

const kMarginPx = { x: 56, y: 30 }; // names stand below their places and reach beyond them
const kLargestPicturePx = 120;
const kNowhere: ReadonlyMap<string, Spot> = new Map();
const kPressPx = 12; // from the middle of a place, however small it is: as good as on it
const kSlackPx = 8; // beyond its edge, for fingers

interface Props {
  graph: Graph;
  belief: Belief | null;
  way: readonly string[]; // places still to be driven
  chosen: string | null;
  marks?: DifferenceMarks | null; // what is other with the draft or the state that is shown
  linked?: LinkedDrawings | null; // it moves with these
  onChoose: (place: string) => void;
}

/** What is drawn now. */
interface Drawing {
  core: Core; // what may be pressed or read
  content: GraphContent;
  ways: WaysLayer;
}

/** The map as a drawing. Everything it offers is also in the list beside it, so it is hidden from screen readers. */
export function GraphView({ graph, belief, way, chosen, marks = null, linked = null, onChoose }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const [drawing, setDrawing] = useState<Drawing | null>(null);
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
      const states = marks ? [graph, marks.before] : [graph];
      const spots = spotsFor(cytoscape, states, diameter);
      const content = contentOf(graph, marks, spots);
      leaveStylesToUs();
      const made = cytoscape({
        container,
        style: graphStyle(diameter),
        layout: { name: 'preset', fit: false },
        minZoom: 0.1,
        maxZoom: Math.max(3, kLargestPicturePx / diameter),
        autoungrabify: true,
        boxSelectionEnabled: false,
      });
      // A change of the map leaves what the reader looks at where it was.
      if (look.current?.map === graph.map) made.viewport(look.current);
      else showAll(made, content, diameter);
      made.on('tap', ({ position }: { position: Spot }) => {
        const within = Math.max(diameter / 2 + kSlackPx / made.zoom(), kPressPx / made.zoom());
        const place = nearestWithin(content.places, position, within);
        if (place) choose.current(place.id);
      });
      const ways = new WaysLayer(made, content, diameter);
      const drawn = { core: made, content, ways };
      const unwatch = watchLook(drawn, container, diameter);
      const forget = showPlacesInView(made, content, diameter, (dots) => ways.setDots(dots));
      const unlink = linked?.join(made);
      setDrawing(drawn);
      destroy = () => {
        look.current = { map: graph.map, zoom: made.zoom(), pan: { ...made.pan() } };
        unlink?.();
        unwatch();
        forget();
        ways.end();
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
    drawing?.ways.setWay(new Set(way.slice(1).map((to, i) => lineId(way[i] ?? '', to))));
  }, [drawing, way]);

  useEffect(() => {
    const place = drawing?.content.at.get(chosen ?? '');
    if (!drawing || !place) return;
    const { core } = drawing;
    const { x1, x2, y1, y2 } = core.extent();
    if (place.x >= x1 && place.x <= x2 && place.y >= y1 && place.y <= y2) return;
    core.pan({
      x: core.width() / 2 - core.zoom() * place.x,
      y: core.height() / 2 - core.zoom() * place.y,
    });
  }, [drawing, chosen]);

  const zoom = (factor: number) => {
    if (!drawing) return;
    const { core } = drawing;
    core.zoom({
      level: core.zoom() * factor,
      renderedPosition: { x: core.width() / 2, y: core.height() / 2 },
    });
  };
  return (
    <div class="graph">
      <div class="graph-canvas" ref={box} aria-hidden="true" data-testid="graph" />
      {picking.value && <p class="graph-pick">{picking.value.what}: press it in the drawing.</p>}
      <PlaceMarks
        drawing={drawing?.core ?? null}
        at={drawing?.content.at ?? kNowhere}
        diameter={diameter}
        shares={shares}
        chosen={chosen}
      />
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
          onClick={() => drawing && showAll(drawing.core, drawing.content, diameter)}
        >
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

/** All places in view. */
function showAll(drawing: Core, { places: points }: GraphContent, diameter: number): void {
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
function watchLook({ core, content, ways }: Drawing, container: HTMLElement, diameter: number): () => void {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const restyle = () => {
    core.style(graphStyle(diameter));
    ways.draw();
  };
  dark.addEventListener('change', restyle);
  let size = `${container.clientWidth} x ${container.clientHeight}`;
  const sizes = new ResizeObserver(() => {
    const present = `${container.clientWidth} x ${container.clientHeight}`;
    if (present === size) return; // an observer tells the size once at first
    size = present;
    core.resize();
    showAll(core, content, diameter);
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
