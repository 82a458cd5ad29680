// SPDX-License-Identifier: Apache-2.0
import type { Core, ElementDefinition } from 'cytoscape';
import type { DrawnPlace, GraphContent, Spot } from './graph_content';
import { nameStyle } from './graph_style';

const kLeastPx = 16; // smaller than this a picture shows nothing
const kMostPictures = 300; // at a time
const kMostElements = 500; // at a time
const kWaitMs = 120; // after the last movement

/** A part of the drawing, in its own units. */
export interface Extent {
  x1: number;
  x2: number;
  y1: number;
  y2: number;
}

const within = ({ x, y }: Spot, { x1, x2, y1, y2 }: Extent, beyond_x: number, beyond_y = beyond_x): boolean =>
  x > x1 - beyond_x && x < x2 + beyond_x && y > y1 - beyond_y && y < y2 + beyond_y;

/**
 * The places that are elements of the drawing: all of a map that is not large; of a large one those in view and around it that
 * have a name or are other with a draft, and when places are large enough for pictures all of these.
 */
export function elementPlaces(
  places: readonly DrawnPlace[],
  extent: Extent,
  diameter_px: number,
): readonly DrawnPlace[] {
  if (places.length <= kMostElements) return places;
  const { x1, x2, y1, y2 } = extent;
  const near = places.filter((one) => within(one, extent, (x2 - x1) / 2, (y2 - y1) / 2));
  const told = near.filter((one) => one.name !== null);
  const rest = diameter_px >= kLeastPx ? near.filter((one) => one.name === null) : [];
  const all = [...told, ...rest];
  if (all.length <= kMostElements) return all;
  const rank = (one: DrawnPlace) => (within(one, extent, 0) ? 0 : 2) + (one.tone === null ? 1 : 0);
  return [0, 1, 2, 3].flatMap((wanted) => all.filter((one) => rank(one) === wanted)).slice(0, kMostElements);
}

/** The place nearest to a spot, at most so far away. */
export function nearestWithin(
  places: readonly DrawnPlace[],
  { x, y }: Spot,
  distance: number,
): DrawnPlace | null {
  let nearest: DrawnPlace | null = null;
  let least = distance;
  for (const place of places) {
    const apart = Math.hypot(place.x - x, place.y - y);
    if (apart > least) continue;
    [nearest, least] = [place, apart];
  }
  return nearest;
}

function nodeOf({ id, name, tone, picture, x, y }: DrawnPlace): ElementDefinition {
  return {
    group: 'nodes',
    data: { id, ...(name === null ? {} : { name }), picture },
    position: { x, y },
    ...(tone ? { classes: tone } : {}),
  };
}

/**
 * Gives places their pictures where they are in view and large enough to show something, and dots elsewhere: a map of
 * thousands of places would ask for as many pictures at once. Keeps names at a size to be read. `dot` hears which places
 * are no elements now. Returns its end.
 */
export function showPlacesInView(
  drawing: Core,
  content: GraphContent,
  diameter: number,
  dot: (places: readonly DrawnPlace[]) => void,
): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let named = 0; // the zoom that the names are made for
  const show = () => {
    const zoom = drawing.zoom();
    const extent = drawing.extent();
    const elements = elementPlaces(content.places, extent, diameter * zoom);
    const wanted = new Set(elements.map((one) => one.id));
    const large = diameter * zoom >= kLeastPx;
    const seen = large ? elements.filter((one) => within(one, extent, diameter)) : [];
    const pictured = new Set(seen.slice(0, kMostPictures).map((one) => one.id));
    drawing.batch(() => {
      drawing.nodes().forEach((node) => void (wanted.has(node.id()) || node.remove()));
      const made = drawing.add(elements.filter((one) => drawing.$id(one.id).empty()).map(nodeOf));
      const shown = drawing.nodes().filter((node) => pictured.has(node.id()));
      drawing.nodes('.pictured').difference(shown).removeClass('pictured');
      shown.not('.pictured').addClass('pictured');
      const names = zoom === named ? made.filter('[name]') : drawing.nodes('[name]');
      if (names.nonempty()) names.style(nameStyle(diameter, zoom));
      named = zoom;
    });
    dot(elements === content.places ? [] : content.places.filter((one) => !wanted.has(one.id)));
  };
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(show, kWaitMs);
  };
  show();
  drawing.on('viewport resize', later);
  return () => {
    clearTimeout(timer);
    drawing.off('viewport resize', later);
  };
}
