// SPDX-License-Identifier: Apache-2.0
import type { Sweep } from '../../api/types';

/** The files of a chosen folder that make a tour. */
export interface TourFiles<F> {
  images: F[]; // in name order
  camera: F | null;
  marks: F | null;
  times: F | null;
  odometry: F | null;
  scans: F | null; // what a range sensor saw, with
  scansAbout: F | null; // where its rays point: neither is of use alone
}

interface FileLike {
  name: string;
  webkitRelativePath: string;
}

const kPicture = /\.(jpe?g|png)$/i;

/** Sorts out a folder: the pictures of its topmost level that has any, and the files that go with a tour. */
export function tourFiles<F extends FileLike>(files: readonly F[]): TourFiles<F> {
  const pictures = files.filter((file) => kPicture.test(file.name) && !file.name.startsWith('.'));
  const top = Math.min(...pictures.map(depth));
  const images = pictures.filter((file) => depth(file) === top).sort((a, b) => (a.name < b.name ? -1 : 1));
  const named = (name: string) => {
    const found = files.filter((file) => file.name.toLowerCase() === name);
    return found.sort((a, b) => depth(a) - depth(b))[0] ?? null;
  };
  // A table of sweeps and what says how to read it are of one robot: beside the pictures, or they are not this tour's.
  const [first] = images;
  const beside = (name: string) =>
    files.find((file) => first && file.name === name && folderOf(file) === folderOf(first)) ?? null;
  return {
    images,
    camera: named('camera.json'),
    marks: named('tour.json'),
    times: named('times.csv'),
    odometry: named('odometry.csv'),
    scans: beside('scans.csv'),
    scansAbout: beside('scans.json'),
  };
}

function folderOf(file: FileLike): string {
  return file.webkitRelativePath.slice(0, -file.name.length);
}

function depth(file: FileLike): number {
  return file.webkitRelativePath.split('/').length;
}

/** The rows of a table of text without its heading; `what` names it in messages. */
export function rowsOf(text: string, heading: string, what: string): string[][] {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() !== '' && !line.startsWith('#'));
  if (lines[0]?.replace(/\s/g, '') !== heading)
    throw new Error(`${what} must begin with the line "${heading}"`);
  const columns = heading.split(',').length;
  return lines.slice(1).map((line, i) => {
    const cells = line.split(',').map((cell) => cell.trim());
    if (cells.length !== columns) throw new Error(`${what}, line ${i + 2}: ${columns} values are expected`);
    return cells;
  });
}

function numberIn(cell: string | undefined, what: string): number {
  const value = Number(cell);
  if (cell === undefined || cell === '' || !Number.isFinite(value))
    throw new Error(`${what}: "${cell}" is not a number`);
  return value;
}

/** When each picture was taken, by its name; from times.csv. */
export function timesOf(text: string): Map<string, number> {
  const rows = rowsOf(text, 'filename,t_us', 'times.csv');
  return new Map(rows.map(([name, t_us]) => [name ?? '', numberIn(t_us, 'times.csv')]));
}

export interface OdometryRow {
  t_us: number;
  x_m: number;
  y_m: number;
  theta_rad: number;
}

export function odometryOf(text: string): OdometryRow[] {
  return rowsOf(text, 't_us,x_m,y_m,theta_rad', 'odometry.csv').map((cells) => {
    const [t_us = 0, x_m = 0, y_m = 0, theta_rad = 0] = cells.map((cell) => numberIn(cell, 'odometry.csv'));
    return { t_us, x_m, y_m, theta_rad };
  });
}

/** Odometry at a time, between the rows around it; outside of all rows the nearest one. */
export function odometryAt(rows: readonly OdometryRow[], t_us: number): OdometryRow | null {
  const after = rows.findIndex((row) => row.t_us >= t_us);
  const b = after < 0 ? rows.at(-1) : rows[after];
  const a = after > 0 ? rows[after - 1] : b;
  if (!a || !b) return null;
  const share = b.t_us > a.t_us ? Math.min(1, (t_us - a.t_us) / (b.t_us - a.t_us)) : 0;
  const turn = Math.atan2(Math.sin(b.theta_rad - a.theta_rad), Math.cos(b.theta_rad - a.theta_rad));
  return {
    t_us,
    x_m: a.x_m + share * (b.x_m - a.x_m),
    y_m: a.y_m + share * (b.y_m - a.y_m),
    theta_rad: a.theta_rad + share * turn,
  };
}

/** The headers that go with a picture: its name, and when and where it was taken as far as that is known. */
export function headersOf(
  name: string,
  n: number,
  times: ReadonlyMap<string, number> | null,
  odometry: readonly OdometryRow[] | null,
): Record<string, string> {
  const headers: Record<string, string> = { 'X-Homeward-Filename': name };
  const t_us = times?.get(name);
  if (t_us !== undefined) headers['X-Homeward-T-Us'] = String(t_us);
  // Without times the table has one row for each picture.
  const row =
    odometry && (t_us === undefined ? (times ? null : (odometry[n] ?? null)) : odometryAt(odometry, t_us));
  if (row) headers['X-Homeward-Odometry'] = [row.x_m, row.y_m, row.theta_rad].join(',');
  return headers;
}

const kMostRays = 10_000;
const kFarthest_m = 100_000;

/**
 * The sweeps of a tour by the name of their picture: scans.csv, with the geometry of scans.json; read as strictly as
 * the robot's own program reads them.
 */
export function sweepsOf(table: string, about: string): Map<string, Sweep> {
  const geometry = geometryOf(about);
  const [heading = '', ...lines] = table.split('\n').map((line) => line.replace(/\r$/, ''));
  const [first, ...rays] = heading.split(',');
  if (first !== 'filename' || rays.length === 0 || rays.some((name, i) => name !== `r${i}`))
    throw new Error('scans.csv must begin with the line "filename,r0,r1,..."');
  if (rays.length > kMostRays) throw new Error(`scans.csv: a sweep may have ${kMostRays} rays at most`);
  const sweeps = new Map<string, Sweep>();
  lines.forEach((line, i) => {
    if (line === '') return;
    const [name = '', ...cells] = line.split(',');
    const where = `scans.csv, line ${i + 2}`;
    if (cells.length !== rays.length) throw new Error(`${where}: ${rays.length + 1} values are expected`);
    if (name === '' || sweeps.has(name)) throw new Error(`${where}: each line names a picture of its own`);
    sweeps.set(name, { ...geometry, ranges_m: cells.map((cell) => rangeIn(cell, where)) });
  });
  return sweeps;
}

/** Null for what saw nothing: an empty cell, or a range further than anything sees. */
function rangeIn(cell: string, where: string): number | null {
  if (cell === '') return null;
  if (!/^\d*\.?\d+(e[+-]?\d+)?$|^\d+\.$/i.test(cell))
    throw new Error(`${where}: "${cell}" is no distance in metres`);
  const range = Number(cell);
  return range <= kFarthest_m ? range : null;
}

const kGeometry = ['angle_min_rad', 'angle_step_rad', 'range_max_m'] as const;
const kScanner = ['x_m', 'y_m', 'theta_rad'] as const;

function geometryOf(about: string): Omit<Sweep, 'ranges_m'> {
  const value = objectIn(about);
  if (value.format !== 'homeward-scans' || value.version !== 1)
    throw new Error('scans.json must say "format": "homeward-scans", "version": 1');
  const scanner = value.robot_from_scan;
  if (!isRecord(scanner)) throw new Error('scans.json: "robot_from_scan" must be an object');
  needNumbers(value, kGeometry, ['format', 'version', 'robot_from_scan']);
  needNumbers(scanner, kScanner, []);
  // How large they may be the server says.
  const { angle_min_rad, angle_step_rad, range_max_m, robot_from_scan } = value as unknown as Sweep;
  return { angle_min_rad, angle_step_rad, range_max_m, robot_from_scan };
}

function needNumbers(
  value: Record<string, unknown>,
  numbers: readonly string[],
  others: readonly string[],
): void {
  for (const key of numbers)
    if (typeof value[key] !== 'number') throw new Error(`scans.json: "${key}" must be a number`);
  const unknown = Object.keys(value).find((key) => !numbers.includes(key) && !others.includes(key));
  if (unknown !== undefined) throw new Error(`scans.json: "${unknown}" is not known`);
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function objectIn(text: string): Record<string, unknown> {
  let value: unknown = null;
  try {
    value = JSON.parse(text);
  } catch {
    // No JSON is no object either.
  }
  if (!isRecord(value)) throw new Error('scans.json must be a JSON object');
  return value;
}
