// SPDX-License-Identifier: Apache-2.0
// Ways and distant places, below the drawing. A way that is an element of cytoscape takes 0.13 ms to be made, styled and drawn;
// here all of one look are a single path. So cytoscape gets only the places that are looked at.
import type { Core } from 'cytoscape';
import type { DrawnPlace, GraphContent, Spot } from './graph_content';
import { token } from './graph_style';
import { kToneColours, type LineLook } from './line_look';

const kLeastLinePx = 0.75;
const kLeastDotPx = 1.5; // its radius
const kSignPx = 12; // at least
const kTones = ['changed', 'removed', 'added'] as const; // of dots, from the lowest up

/** Which part of the drawing is shown, and how large. */
interface Shown {
  zoom: number;
  pan: Spot; // px
  width_px: number;
  height_px: number;
  density: number; // pixels of the screen for each px
}

/** Lines of one look: what takes time is to begin a path. */
interface LineGroup {
  look: LineLook;
  lines: { from: Spot; to: Spot }[];
}

/** A canvas below `drawing` that follows it. */
export class WaysLayer {
  private readonly canvas = document.createElement('canvas');
  private way: ReadonlySet<string> = new Set();
  private groups: readonly LineGroup[];
  private dots: readonly DrawnPlace[] = [];
  private shown = ''; // what was drawn last, as text

  constructor(
    private readonly drawing: Core,
    private readonly content: GraphContent,
    private readonly diameter: number, // of a place, in units of the drawing
  ) {
    this.groups = groupsOf(content, this.way);
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
    this.groups = groupsOf(this.content, lines);
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
    this.canvas.width = Math.round(shown.width_px * shown.density);
    this.canvas.height = Math.round(shown.height_px * shown.density);
    if (!context) return;
    context.scale(shown.density, shown.density);
    drawLines(context, this.groups, Math.min(3, 0.4 * this.diameter), shown);
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
      density: devicePixelRatio,
    };
  }
}

/** From the lowest up. `way`: the lines that a robot has before it, by id. */
function groupsOf(content: GraphContent, way: ReadonlySet<string>): LineGroup[] {
  const groups = new Map<string, LineGroup>();
  for (const { id, from, to, look: plain, ahead } of content.lines) {
    const look = way.has(id) ? ahead : plain;
    const key = JSON.stringify(look);
    let group = groups.get(key);
    if (!group) groups.set(key, (group = { look, lines: [] }));
    group.lines.push({ from, to });
  }
  return [...groups.values()].sort((a, b) => a.look.rank - b.look.rank);
}

/** Whether any part of the box of two points, in px, is in view. */
function inView(
  [ax, ay]: readonly [number, number],
  [bx, by]: readonly [number, number],
  beyond_px: number,
  { width_px, height_px }: Shown,
): boolean {
  return (
    Math.max(ax, bx) > -beyond_px &&
    Math.min(ax, bx) < width_px + beyond_px &&
    Math.max(ay, by) > -beyond_px &&
    Math.min(ay, by) < height_px + beyond_px
  );
}

const onScreen = ({ x, y }: Spot, { zoom, pan }: Shown): [number, number] => [
  x * zoom + pan.x,
  y * zoom + pan.y,
];

function drawLines(
  context: CanvasRenderingContext2D,
  groups: readonly LineGroup[],
  unit: number, // a plain line's width, in units of the drawing
  shown: Shown,
): void {
  const signs: { look: LineLook; middles: [number, number][] }[] = [];
  for (const { look, lines } of groups) {
    const middles: [number, number][] = [];
    const path = new Path2D();
    for (const { from, to } of lines) {
      const [a, b] = [onScreen(from, shown), onScreen(to, shown)];
      if (!inView(a, b, kSignPx, shown)) continue;
      path.moveTo(...a);
      path.lineTo(...b);
      if (look.sign !== null) middles.push([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    }
    const width_px = Math.max(kLeastLinePx, look.width * unit * shown.zoom);
    context.strokeStyle = token(look.colour);
    context.lineWidth = width_px;
    context.setLineDash(dashesOf(look.dash, width_px));
    context.stroke(path);
    signs.push({ look, middles });
  }
  context.setLineDash([]);
  for (const { look, middles } of signs) drawSigns(context, look, middles, unit * shown.zoom);
}

function dashesOf(dash: LineLook['dash'], width_px: number): number[] {
  if (dash === 'solid') return [];
  const unit_px = Math.max(2, width_px);
  return dash === 'dashed' ? [3 * unit_px, 1.5 * unit_px] : [unit_px, unit_px];
}

function drawSigns(
  context: CanvasRenderingContext2D,
  look: LineLook,
  middles: readonly (readonly [number, number])[],
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
  for (const [x, y] of middles) {
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
  const ring_px = Math.min(2, 0.4 * radius_px);
  context.fillStyle = token('sunken');
  for (const tone of [null, ...kTones]) {
    const path = new Path2D();
    for (const place of places) {
      const at = onScreen(place, shown);
      if (place.tone !== tone || !inView(at, at, radius_px, shown)) continue;
      path.moveTo(at[0] + radius_px, at[1]);
      path.arc(...at, radius_px, 0, 2 * Math.PI);
    }
    context.fill(path);
    context.strokeStyle = token(tone === null ? 'line-strong' : kToneColours[tone]);
    context.lineWidth = tone === null ? ring_px : 2.5 * ring_px;
    context.stroke(path);
  }
}
