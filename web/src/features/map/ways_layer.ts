// SPDX-License-Identifier: Apache-2.0
// Ways and distant places, below the drawing. An element of cytoscape takes about 0.2 ms to be made and styled, a line here a
// hundredth of that, so cytoscape gets only what somebody may press or read.
import type { Core } from 'cytoscape';
import type { DrawnPlace, GraphContent, Spot } from './graph_content';
import { token } from './graph_style';
import { kWayLook, type LineLook } from './line_look';

const kLeastLinePx = 0.75;
const kLeastDotPx = 1.5; // its radius
const kSignPx = 12; // at least

/** Which part of the drawing is shown, and how large. */
export interface Shown {
  zoom: number;
  pan: Spot; // px
  width_px: number;
  height_px: number;
}

interface Drawn extends LineLook {
  from: Spot;
  to: Spot;
}

/** A canvas below `drawing` that follows it. */
export class WaysLayer {
  private readonly canvas = document.createElement('canvas');
  private way: ReadonlySet<string> = new Set();
  private lines: readonly Drawn[];
  private dots: readonly DrawnPlace[] = [];
  private shown = ''; // what was drawn last, as text

  constructor(
    private readonly drawing: Core,
    private readonly content: GraphContent,
    private readonly diameter: number, // of a place, in units of the drawing
  ) {
    this.lines = linesOf(content, this.way);
    this.canvas.className = 'graph-ways';
    drawing.container()?.prepend(this.canvas);
    drawing.on('render', this.follow); // in the same frame as the drawing itself
    this.draw();
  }

  end(): void {
    this.drawing.off('render', this.follow);
    this.canvas.remove();
  }

  /** The lines that a robot has before it, by id. */
  setWay(lines: ReadonlySet<string>): void {
    if (lines.size === this.way.size && [...lines].every((one) => this.way.has(one))) return;
    this.way = lines;
    this.lines = linesOf(this.content, lines);
    this.draw();
  }

  /** The places that are shown as dots. */
  setDots(places: readonly DrawnPlace[]): void {
    this.dots = places;
    this.draw();
  }

  /** As the colours of the page are now. */
  draw(): void {
    const context = this.canvas.getContext('2d');
    const shown = this.present();
    this.shown = JSON.stringify(shown);
    const scale = devicePixelRatio;
    this.canvas.width = Math.round(shown.width_px * scale);
    this.canvas.height = Math.round(shown.height_px * scale);
    if (!context) return;
    context.scale(scale, scale);
    drawLines(context, this.lines, Math.min(3, 0.4 * this.diameter), shown);
    drawDots(context, this.dots, this.diameter, shown);
  }

  private readonly follow = (): void => {
    if (JSON.stringify(this.present()) !== this.shown) this.draw();
  };

  private present(): Shown {
    const { drawing } = this;
    return {
      zoom: drawing.zoom(),
      pan: { ...drawing.pan() },
      width_px: drawing.width(),
      height_px: drawing.height(),
    };
  }
}

/** `way`: the lines that a robot has before it, by id. */
function linesOf({ lines, at }: GraphContent, way: ReadonlySet<string>): Drawn[] {
  return lines.flatMap(({ id, from, to, look }) => {
    const [a, b] = [at.get(from), at.get(to)];
    return a && b ? [{ ...look, ...(way.has(id) ? kWayLook : {}), from: a, to: b }] : [];
  });
}

const onScreen = ({ x, y }: Spot, { zoom, pan }: Shown): Spot => ({
  x: x * zoom + pan.x,
  y: y * zoom + pan.y,
});

/** Whether any part of the box of two points, in px, is in view. */
function inView(a: Spot, b: Spot, beyond_px: number, { width_px, height_px }: Shown): boolean {
  return (
    Math.max(a.x, b.x) > -beyond_px &&
    Math.min(a.x, b.x) < width_px + beyond_px &&
    Math.max(a.y, b.y) > -beyond_px &&
    Math.min(a.y, b.y) < height_px + beyond_px
  );
}

/** Lines of one look are one path: what takes time is to begin one. */
function drawLines(
  context: CanvasRenderingContext2D,
  lines: readonly Drawn[],
  unit: number, // a plain line's width, in units of the drawing
  shown: Shown,
): void {
  const paths = new Map<string, { look: LineLook; path: Path2D; middles: Spot[] }>();
  for (const { from, to, ...look } of lines) {
    const [a, b] = [onScreen(from, shown), onScreen(to, shown)];
    if (!inView(a, b, kSignPx, shown)) continue;
    const key = `${look.width} ${look.dash} ${look.colour} ${look.sign ?? ''}`;
    let group = paths.get(key);
    if (!group) paths.set(key, (group = { look, path: new Path2D(), middles: [] }));
    group.path.moveTo(a.x, a.y);
    group.path.lineTo(b.x, b.y);
    if (look.sign !== null) group.middles.push({ x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 });
  }
  const groups = [...paths.values()].sort((a, b) => a.look.width - b.look.width);
  for (const { look, path } of groups) {
    const width_px = Math.max(kLeastLinePx, look.width * unit * shown.zoom);
    context.strokeStyle = token(look.colour);
    context.lineWidth = width_px;
    context.setLineDash(dashesOf(look.dash, width_px));
    context.stroke(path);
  }
  context.setLineDash([]);
  for (const { look, middles } of groups) drawSigns(context, look, middles, unit * shown.zoom);
}

function dashesOf(dash: LineLook['dash'], width_px: number): number[] {
  if (dash === 'solid') return [];
  const unit_px = Math.max(2, width_px);
  return dash === 'dashed' ? [3 * unit_px, 1.5 * unit_px] : [unit_px, unit_px];
}

function drawSigns(
  context: CanvasRenderingContext2D,
  look: LineLook,
  middles: readonly Spot[],
  unit_px: number,
): void {
  if (look.sign === null) return;
  context.font = `bold ${Math.max(kSignPx, 8 * unit_px)}px 'Atkinson Hyperlegible', sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.lineJoin = 'round';
  context.strokeStyle = token('surface');
  context.lineWidth = Math.max(3, 2.4 * unit_px);
  context.fillStyle = token(look.text);
  for (const { x, y } of middles) {
    context.strokeText(look.sign, x, y);
    context.fillText(look.sign, x, y);
  }
}

function drawDots(
  context: CanvasRenderingContext2D,
  places: readonly DrawnPlace[],
  diameter: number,
  shown: Shown,
): void {
  const radius_px = Math.max(kLeastDotPx, (diameter * shown.zoom) / 2);
  const path = new Path2D();
  for (const place of places) {
    const at = onScreen(place, shown);
    if (!inView(at, at, radius_px, shown)) continue;
    path.moveTo(at.x + radius_px, at.y);
    path.arc(at.x, at.y, radius_px, 0, 2 * Math.PI);
  }
  context.fillStyle = token('sunken');
  context.fill(path);
  context.strokeStyle = token('line-strong');
  context.lineWidth = Math.min(2, 0.4 * radius_px);
  context.stroke(path);
}
