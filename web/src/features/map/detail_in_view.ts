// SPDX-License-Identifier: Apache-2.0
import type { Core, NodeSingular } from 'cytoscape';
import { nameStyle } from './graph_style';

const kLeastPx = 16; // smaller than this a picture shows nothing
const kMostPictures = 300; // at a time
const kWaitMs = 120; // after the last movement

/**
 * Gives places their pictures where they are in view and large enough to show something, and dots elsewhere: a map of
 * thousands of places would ask for as many pictures at once. Keeps names at a size to be read. Returns its end.
 */
export function showDetailInView(drawing: Core, diameter: number): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let named = 0; // the zoom that the names are made for
  const show = () => {
    const zoom = drawing.zoom();
    const { x1, x2, y1, y2 } = drawing.extent();
    const inView = (node: NodeSingular) => {
      const { x, y } = node.position();
      return x > x1 - diameter && x < x2 + diameter && y > y1 - diameter && y < y2 + diameter;
    };
    const large = diameter * zoom >= kLeastPx;
    const shown = large ? drawing.nodes().filter(inView).slice(0, kMostPictures) : drawing.collection();
    drawing.batch(() => {
      drawing.nodes('.pictured').difference(shown).removeClass('pictured');
      shown.not('.pictured').addClass('pictured');
      if (zoom !== named) drawing.nodes('[name]').style(nameStyle(diameter, zoom));
      named = zoom;
    });
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
