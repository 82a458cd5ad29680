// SPDX-License-Identifier: Apache-2.0
import type { Core } from 'cytoscape';
import { useEffect, useRef } from 'preact/hooks';
import type { Spot } from './graph_content';

const kLeastPx = 9; // so that a mark is found where the whole of a large map is shown

interface Props {
  drawing: Core | null;
  at: ReadonlyMap<string, Spot>; // places, in units of the drawing
  diameter: number; // of a place, in units of the drawing
  shares: ReadonlyMap<string, number>; // how probable it is that the robot is there
  chosen: string | null;
}

/**
 * Where the robot believes to be, and the chosen place: rings over the drawing, in a layer of their own. The drawing itself,
 * which for a large map takes long to draw, stays as it is when they change.
 */
export function PlaceMarks({ drawing, at, diameter, shares, chosen }: Props) {
  const svg = useRef<SVGSVGElement>(null);
  const marks = [
    ...[...shares].map(([place, share]) => ({ place, share })),
    ...(chosen === null ? [] : [{ place: chosen, share: null }]),
  ];
  useEffect(() => {
    if (!drawing) return;
    const follow = () => svg.current && lay(svg.current, drawing, at, diameter);
    follow();
    drawing.on('viewport resize', follow);
    return () => void drawing.off('viewport resize', follow);
  });
  return (
    <svg class="place-marks" ref={svg} aria-hidden="true">
      {marks.map(({ place, share }) =>
        share === null ? (
          <circle key={`chosen ${place}`} class="chosen" data-place={place} />
        ) : (
          <g key={place} data-share={share.toFixed(2)}>
            <circle class="halo" data-place={place} data-share={share} stroke-opacity={0.1 + 0.5 * share} />
            <circle class="belief" data-place={place} data-share={share} />
          </g>
        ),
      )}
    </svg>
  );
}

/** Puts each ring around its place as it is shown now. */
function lay(svg: SVGSVGElement, drawing: Core, at: ReadonlyMap<string, Spot>, diameter: number): void {
  const zoom = drawing.zoom();
  const pan = drawing.pan();
  const radius_px = Math.max(kLeastPx, (diameter * zoom) / 2);
  const ring_px = Math.max(2, 0.1 * radius_px);
  for (const circle of svg.querySelectorAll('circle')) {
    const place = at.get(circle.dataset['place'] ?? '');
    circle.setAttribute('visibility', place ? 'visible' : 'hidden');
    if (!place) continue;
    const { x, y } = place;
    const share = Number(circle.dataset['share'] ?? 0);
    const kind = circle.getAttribute('class');
    const width_px = (kind === 'halo' ? 4 : kind === 'chosen' ? 2.5 : 1 + 2 * share) * ring_px;
    circle.setAttribute('cx', String(x * zoom + pan.x));
    circle.setAttribute('cy', String(y * zoom + pan.y));
    circle.setAttribute('r', String(kind === 'halo' ? radius_px + 2 * ring_px : radius_px));
    circle.setAttribute('stroke-width', String(width_px));
  }
}
