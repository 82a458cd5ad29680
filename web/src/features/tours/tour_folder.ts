// SPDX-License-Identifier: Apache-2.0

/** The files of a chosen folder that make a tour. */
export interface TourFiles<F> {
  images: F[]; // in name order
  camera: F | null;
  marks: F | null;
  times: F | null;
  odometry: F | null;
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
  const named = (name: string) => {
    const found = files.filter((file) => file.name.toLowerCase() === name);
    return found.sort((a, b) => depth(a) - depth(b))[0] ?? null;
  };
  return {
    images: pictures.filter((file) => depth(file) === top).sort((a, b) => (a.name < b.name ? -1 : 1)),
    camera: named('camera.json'),
    marks: named('tour.json'),
    times: named('times.csv'),
    odometry: named('odometry.csv'),
  };
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
