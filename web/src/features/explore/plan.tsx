// SPDX-License-Identifier: Apache-2.0
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from 'preact/hooks';
import type { Exploration } from '../../api/types';
import { watchHands, type Hands } from '../../lib/hands';
import { rasterOf } from './floor';
import { floorPicture, paint, paletteOf, type Palette } from './plan_paint';
import { boundsOf, fitted, moved, onPlan, zoomed, type PlanView, type Point, type Size } from './plan_view';

const kZoom = 1.5; // by a button or a key
const kStep = 0.2; // of what is in view, by a key or a button

interface Props {
  exploration: Exploration | null;
  fences: readonly (readonly Point[])[];
  drawn: readonly Point[] | null; // corners of a fence that is being drawn
  words: string; // the same for those who do not see it
  onTap: ((point: Point) => void) | null;
}

/** The plan as it grows: shows all that is known until somebody moves or enlarges it. */
export function Plan({ exploration, fences, drawn, words, onTap }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const canvas = useRef<HTMLCanvasElement>(null);
  const [own, setOwn] = useState<PlanView | null>(null); // null: all that is known
  const size = useSize(box);
  const palette = usePalette(canvas);
  const floor = exploration?.floor ?? null;
  const raster = useMemo(() => floor && rasterOf(floor), [floor]);
  const picture = useMemo(() => raster && palette && floorPicture(raster, palette), [raster, palette]);
  const view = own ?? fitted(boundsOf(exploration, raster?.known ?? null), size);
  const middle = { x: size.width / 2, y: size.height / 2 };
  const shift = (x: number, y: number) =>
    setOwn(moved(view, x * kStep * size.width, y * kStep * size.height));
  const grow = (factor: number) => setOwn(zoomed(view, factor, middle, size));
  const hands: Hands = {
    move: (dx, dy) => setOwn((before) => moved(before ?? view, dx, dy)),
    zoom: (factor, at) => setOwn((before) => zoomed(before ?? view, factor, at, size)),
    press: (at) => onTap?.(onPlan(view, size, at)),
    hover: () => undefined,
  };
  const latest = useRef(hands);
  latest.current = hands;
  useLayoutEffect(() => (box.current ? watchHands(box.current, () => latest.current) : undefined), []);
  useLayoutEffect(() => {
    const context = canvas.current?.getContext('2d');
    if (!canvas.current || !context || !palette || size.width === 0) return;
    const ratio = Math.min(3, devicePixelRatio || 1);
    const [width, height] = [Math.round(size.width * ratio), Math.round(size.height * ratio)];
    if (canvas.current.width !== width) canvas.current.width = width;
    if (canvas.current.height !== height) canvas.current.height = height;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const drawing = { exploration, fences, drawn, floor: raster && picture && { raster, picture } };
    paint(context, drawing, view, size, palette);
  });
  return (
    <div class="stack tight">
      <div class="plan-frame">
        <div class={onTap ? 'plan-box drawing' : 'plan-box'} ref={box} data-testid="plan">
          <canvas ref={canvas} role="img" aria-label={words} />
        </div>
        <div class="plan-zoom" role="group" aria-label="Size of the plan">
          <button type="button" class="button" aria-label="Enlarge" onClick={() => grow(kZoom)}>
            +
          </button>
          <button type="button" class="button" aria-label="Make smaller" onClick={() => grow(1 / kZoom)}>
            −
          </button>
        </div>
      </div>
      <PlanButtons shift={shift} fit={() => setOwn(null)} fits={own === null} />
    </div>
  );
}

function useSize(box: { current: HTMLElement | null }): Size {
  const [size, setSize] = useState<Size>({ width: 0, height: 0 });
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const sizes = new ResizeObserver(() =>
      setSize({ width: element.clientWidth, height: element.clientHeight }),
    );
    sizes.observe(element);
    return () => sizes.disconnect();
  }, [box]);
  return size;
}

/** The colours, read again when the page turns light or dark. */
function usePalette(canvas: { current: HTMLCanvasElement | null }): Palette | null {
  const [palette, setPalette] = useState<Palette | null>(null);
  useEffect(() => {
    const read = () => {
      if (canvas.current) setPalette(paletteOf(canvas.current));
    };
    read();
    const dark = matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', read);
    return () => dark.removeEventListener('change', read);
  }, [canvas]);
  return palette;
}

interface ButtonsProps {
  shift: (x: number, y: number) => void;
  fit: () => void;
  fits: boolean;
}

const kArrows = [
  ['←', 'left', 1, 0],
  ['→', 'right', -1, 0],
  ['↑', 'up', 0, 1],
  ['↓', 'down', 0, -1],
] as const;

function PlanButtons({ shift, fit, fits }: ButtonsProps) {
  return (
    <div class="plan-buttons" role="group" aria-label="Part of the plan">
      {kArrows.map(([sign, word, x, y]) => (
        <button
          key={word}
          type="button"
          class="button"
          aria-label={`Look further ${word}`}
          onClick={() => shift(x, y)}
        >
          {sign}
        </button>
      ))}
      <button type="button" class="button" aria-pressed={fits} onClick={fit}>
        Show all
      </button>
    </div>
  );
}

const kLegend = [
  ['free', 'Floor that it has seen'],
  ['covered', 'Seen well in pictures'],
  ['thing', 'Something stands there'],
  ['node', 'A picture, and the way'],
  ['loop', 'A place known again'],
  ['robot', 'The robot'],
  ['target', 'Where it goes next'],
  ['fence', 'A fence'],
] as const;

export function PlanLegend() {
  return (
    <ul class="plan-legend" aria-label="Signs of the plan">
      {kLegend.map(([sign, word]) => (
        <li key={sign}>
          <span class={`plan-sign ${sign}`} aria-hidden="true" />
          {word}
        </li>
      ))}
    </ul>
  );
}
