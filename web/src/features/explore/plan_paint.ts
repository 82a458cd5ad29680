// SPDX-License-Identifier: Apache-2.0
import type { Exploration } from '../../api/types';
import { kCovered, kFree, kThing, type Raster } from './floor';
import { onScreen, scaleBar, type PlanView, type Point, type Size } from './plan_view';

/** The colours of the plan, as styles/explore.css has them for light and dark. */
export interface Palette {
  ground: string;
  free: string;
  covered: string;
  thing: string;
  way: string;
  node: string;
  loop: string;
  fence: string;
  robot: string;
  robot_edge: string;
  ink: string;
}

const kNames: Readonly<Record<keyof Palette, string>> = {
  ground: '--plan-ground',
  free: '--plan-free',
  covered: '--plan-covered',
  thing: '--plan-thing',
  way: '--plan-way',
  node: '--plan-node',
  loop: '--plan-loop',
  fence: '--plan-fence',
  robot: '--plan-robot',
  robot_edge: '--plan-robot-edge',
  ink: '--ink',
};

export function paletteOf(element: HTMLElement): Palette {
  const style = getComputedStyle(element);
  const entries = Object.entries(kNames).map(([key, name]) => [key, style.getPropertyValue(name).trim()]);
  return Object.fromEntries(entries) as unknown as Palette;
}

/** "#rrggbb" as a pixel of an ImageData, which is little-endian on all that browsers run on. */
function pixel(colour: string): number {
  const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) || 0);
  return ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
}

/** The floor as a picture, a pixel a cell, the greatest y at the top. */
export function floorPicture(raster: Raster, palette: Palette): HTMLCanvasElement {
  const { columns, rows, kinds } = raster;
  const canvas = document.createElement('canvas');
  canvas.width = columns;
  canvas.height = rows;
  const context = canvas.getContext('2d');
  if (!context) return canvas;
  const image = context.createImageData(columns, rows);
  const pixels = new Uint32Array(image.data.buffer);
  const colours = new Uint32Array(4); // what is unknown stays clear
  colours[kFree] = pixel(palette.free);
  colours[kThing] = pixel(palette.thing);
  colours[kCovered] = pixel(palette.covered);
  for (let row = 0; row < rows; row += 1) {
    const to = (rows - 1 - row) * columns;
    for (let column = 0; column < columns; column += 1)
      pixels[to + column] = colours[kinds[row * columns + column] ?? 0] ?? 0;
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

/** What is drawn; `drawn` is a fence that somebody draws just now. */
export interface Scene {
  exploration: Exploration | null;
  floor: { raster: Raster; picture: HTMLCanvasElement } | null;
  fences: readonly (readonly Point[])[];
  drawn: readonly Point[] | null;
}

interface Brush {
  context: CanvasRenderingContext2D;
  view: PlanView;
  size: Size;
  palette: Palette;
}

export function paint(
  context: CanvasRenderingContext2D,
  scene: Scene,
  view: PlanView,
  size: Size,
  palette: Palette,
): void {
  const brush = { context, view, size, palette };
  context.fillStyle = palette.ground;
  context.fillRect(0, 0, size.width, size.height);
  context.lineJoin = 'round';
  context.lineCap = 'round';
  if (scene.floor) paintFloor(brush, scene.floor);
  paintGrid(brush);
  scene.fences.forEach((fence, n) => paintFence(brush, fence, String(n + 1)));
  if (scene.exploration) {
    paintWay(brush, scene.exploration);
    paintTarget(brush, scene.exploration);
    paintRobot(brush, scene.exploration);
  }
  if (scene.drawn) paintDrawn(brush, scene.drawn);
  paintScale(brush);
}

function paintFloor({ context, view, size }: Brush, { raster, picture }: NonNullable<Scene['floor']>): void {
  const [left, top] = onScreen(view, size, [raster.x_m, raster.y_m + raster.rows * raster.cell_m]);
  const pixels = raster.cell_m * view.scale; // of a cell
  context.imageSmoothingEnabled = pixels < 1;
  context.drawImage(picture, left, top, raster.columns * pixels, raster.rows * pixels);
}

/** A cross at each metre where there is room for them, else at every tenth. */
function paintGrid({ context, view, size, palette }: Brush): void {
  const step = view.scale >= 28 ? 1 : view.scale >= 5 ? 10 : 100;
  const left = Math.ceil((view.x - size.width / 2 / view.scale) / step) * step;
  const right = view.x + size.width / 2 / view.scale;
  const bottom = Math.ceil((view.y - size.height / 2 / view.scale) / step) * step;
  const top = view.y + size.height / 2 / view.scale;
  context.fillStyle = palette.ink;
  context.globalAlpha = 0.16;
  for (let x = left; x <= right; x += step)
    for (let y = bottom; y <= top; y += step) {
      const [at_x, at_y] = onScreen(view, size, [x, y]);
      context.fillRect(Math.round(at_x) - 2, Math.round(at_y), 5, 1);
      context.fillRect(Math.round(at_x), Math.round(at_y) - 2, 1, 5);
    }
  context.globalAlpha = 1;
}

function trace({ context, view, size }: Brush, points: readonly (readonly number[])[], close = false): void {
  context.beginPath();
  addLine(context, view, size, points);
  if (close) context.closePath();
}

const kLeastStep_px = 1; // points that are closer on the screen are not drawn by themselves

function addLine(
  context: CanvasRenderingContext2D,
  view: PlanView,
  size: Size,
  points: readonly (readonly number[])[],
): void {
  let [from_x, from_y] = [Infinity, Infinity];
  points.forEach(([x = 0, y = 0], n) => {
    const [at_x, at_y] = onScreen(view, size, [x, y]);
    const near = Math.abs(at_x - from_x) + Math.abs(at_y - from_y) < kLeastStep_px;
    if (near && n < points.length - 1) return;
    if (n === 0) context.moveTo(at_x, at_y);
    else context.lineTo(at_x, at_y);
    [from_x, from_y] = [at_x, at_y];
  });
}

function paintWay(brush: Brush, { nodes, loops }: Exploration): void {
  const { context, view, size, palette } = brush;
  const width = Math.max(1.5, Math.min(3, view.scale / 16));
  context.strokeStyle = palette.way;
  context.lineWidth = width;
  trace(brush, nodes);
  context.stroke();
  context.strokeStyle = palette.loop;
  context.lineWidth = Math.min(width + 1, Math.max(1, view.scale / 8));
  context.setLineDash([5, 5]);
  context.beginPath();
  for (const [later = 0, earlier = 0] of loops) {
    const [a, b] = [nodes[later], nodes[earlier]];
    if (a && b) addLine(context, view, size, [a, b]);
  }
  context.stroke();
  context.setLineDash([]);
  const again = new Set(loops.flat());
  paintNodes(
    brush,
    nodes.filter((_, n) => !again.has(n)),
    palette.node,
  );
  paintNodes(
    brush,
    nodes.filter((_, n) => again.has(n)),
    palette.loop,
  );
  const [first] = nodes;
  if (first) paintBeginning(brush, first);
}

/** All in one path: there may be thousands. Where they are too close for dots of their own, one stands for several. */
function paintNodes({ context, view, size }: Brush, nodes: readonly number[][], colour: string): void {
  const radius = Math.max(1.5, Math.min(5.5, view.scale / 9));
  const taken = new Set<number>();
  context.fillStyle = colour;
  context.beginPath();
  for (const [x = 0, y = 0] of nodes) {
    const [at_x, at_y] = onScreen(view, size, [x, y]);
    if (at_x < -radius || at_y < -radius || at_x > size.width + radius || at_y > size.height + radius)
      continue;
    const spot = Math.round(at_x) * 16_384 + Math.round(at_y);
    if (taken.has(spot)) continue;
    taken.add(spot);
    if (radius < 2) context.rect(at_x - radius, at_y - radius, 2 * radius, 2 * radius);
    else {
      context.moveTo(at_x + radius, at_y);
      context.arc(at_x, at_y, radius, 0, 2 * Math.PI);
    }
  }
  context.fill();
}

/** Where it began. */
function paintBeginning({ context, view, size, palette }: Brush, [x = 0, y = 0]: readonly number[]): void {
  const [at_x, at_y] = onScreen(view, size, [x, y]);
  context.fillStyle = palette.node;
  context.strokeStyle = palette.robot_edge;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(at_x, at_y, Math.max(4, Math.min(7, view.scale / 8)), 0, 2 * Math.PI);
  context.fill();
  context.stroke();
}

function paintTarget({ context, view, size, palette }: Brush, { target, pose }: Exploration): void {
  if (!target) return;
  const [x = 0, y = 0] = target;
  const [at_x, at_y] = onScreen(view, size, [x, y]);
  context.strokeStyle = palette.robot;
  context.lineWidth = 2;
  if (pose) {
    const [from_x, from_y] = onScreen(view, size, [pose.x_m, pose.y_m]);
    context.setLineDash([2, 6]);
    context.beginPath();
    context.moveTo(from_x, from_y);
    context.lineTo(at_x, at_y);
    context.stroke();
    context.setLineDash([]);
  }
  for (const radius of [9, 3]) {
    context.beginPath();
    context.arc(at_x, at_y, radius, 0, 2 * Math.PI);
    context.stroke();
  }
}

/** An arrow head, never smaller than can be seen. */
function paintRobot({ context, view, size, palette }: Brush, { pose }: Exploration): void {
  if (!pose) return;
  const [at_x, at_y] = onScreen(view, size, [pose.x_m, pose.y_m]);
  const long = Math.max(13, Math.min(26, 0.45 * view.scale));
  context.save();
  context.translate(at_x, at_y);
  context.rotate(-pose.theta_rad);
  context.beginPath();
  context.moveTo(long, 0);
  context.lineTo(-0.75 * long, 0.72 * long);
  context.lineTo(-0.35 * long, 0);
  context.lineTo(-0.75 * long, -0.72 * long);
  context.closePath();
  context.fillStyle = palette.robot;
  context.strokeStyle = palette.robot_edge;
  context.lineWidth = 2.5;
  context.stroke();
  context.fill();
  context.restore();
}

function paintFence(brush: Brush, fence: readonly Point[], name: string): void {
  const { context, view, size, palette } = brush;
  trace(brush, fence, true);
  context.save();
  context.globalAlpha = 0.18;
  context.fillStyle = palette.fence;
  context.fill();
  context.clip();
  context.globalAlpha = 0.75;
  context.strokeStyle = palette.fence;
  context.lineWidth = 1.5;
  const corners = fence.map((one) => onScreen(view, size, one));
  const inside = (value: number, most: number) => Math.max(-20, Math.min(most + 20, value));
  const [xs, ys] = [
    corners.map(([x]) => inside(x, size.width)),
    corners.map(([, y]) => inside(y, size.height)),
  ];
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  context.beginPath();
  for (let sum = Math.floor((left + top) / 10) * 10; sum <= right + bottom; sum += 10) {
    context.moveTo(sum - top, top);
    context.lineTo(sum - bottom, bottom);
  }
  context.stroke();
  context.restore();
  trace(brush, fence, true);
  context.strokeStyle = palette.fence;
  context.lineWidth = 2.5;
  context.stroke();
  const [sum_x, sum_y] = corners.reduce<[number, number]>(([a, b], [x, y]) => [a + x, b + y], [0, 0]);
  paintName(brush, name, sum_x / corners.length, sum_y / corners.length);
}

function paintName({ context, palette }: Brush, name: string, x: number, y: number): void {
  context.beginPath();
  context.arc(x, y, 12, 0, 2 * Math.PI);
  context.fillStyle = palette.fence;
  context.fill();
  context.fillStyle = palette.robot_edge;
  context.font = "700 14px 'Atkinson Hyperlegible', sans-serif";
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(name, x, y + 1);
}

function paintDrawn(brush: Brush, corners: readonly Point[]): void {
  const { context, view, size, palette } = brush;
  context.strokeStyle = palette.fence;
  context.lineWidth = 2.5;
  context.setLineDash([8, 6]);
  trace(brush, corners, corners.length > 2);
  context.stroke();
  context.setLineDash([]);
  for (const corner of corners) {
    const [x, y] = onScreen(view, size, corner);
    context.beginPath();
    context.arc(x, y, 6, 0, 2 * Math.PI);
    context.fillStyle = palette.robot_edge;
    context.fill();
    context.stroke();
  }
}

function paintScale({ context, view, size, palette }: Brush): void {
  const { metres, width_px } = scaleBar(view.scale);
  const [x, y] = [14, size.height - 14];
  context.fillStyle = palette.ground;
  context.globalAlpha = 0.82;
  context.fillRect(x - 8, y - 26, Math.max(width_px, 44) + 16, 34);
  context.globalAlpha = 1;
  context.strokeStyle = palette.ink;
  context.lineWidth = 2;
  context.lineCap = 'butt';
  context.beginPath();
  context.moveTo(x, y - 6);
  context.lineTo(x, y);
  context.lineTo(x + width_px, y);
  context.lineTo(x + width_px, y - 6);
  context.stroke();
  context.fillStyle = palette.ink;
  context.font = "14px 'Atkinson Hyperlegible', sans-serif";
  context.textAlign = 'left';
  context.textBaseline = 'alphabetic';
  context.fillText(`${metres} m`, x, y - 9);
}
