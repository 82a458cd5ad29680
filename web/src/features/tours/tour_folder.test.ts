// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { headersOf, odometryAt, odometryOf, sweepsOf, timesOf, tourFiles } from './tour_folder';

const file = (path: string) => ({ name: path.split('/').at(-1) ?? '', webkitRelativePath: path });

describe('tourFiles', () => {
  it('takes the topmost pictures in name order and the files that belong to them', () => {
    const found = tourFiles(
      [
        't/0002.jpg',
        't/0001.JPG',
        't/camera.json',
        't/old/0000.jpg',
        't/tour.json',
        't/.x.jpg',
        't/notes.txt',
      ].map(file),
    );
    expect(found.images.map((one) => one.name)).toEqual(['0001.JPG', '0002.jpg']);
    expect(found.camera?.name).toBe('camera.json');
    expect(found.marks?.name).toBe('tour.json');
    expect(found.times).toBeNull();
  });

  it('takes sweeps only from beside the pictures', () => {
    const paths = ['t/a.jpg', 't/scans.csv', 't/scans.json', 't/old/scans.csv'];
    expect(tourFiles(paths.map(file)).scans?.webkitRelativePath).toBe('t/scans.csv');
    expect(tourFiles(['t/scans.csv', 't/images/a.jpg'].map(file)).scans).toBeNull();
  });

  it('finds pictures that lie one folder deeper', () => {
    expect(tourFiles(['t/images/b.png', 't/camera.json'].map(file)).images).toHaveLength(1);
    expect(tourFiles([]).images).toEqual([]);
  });
});

describe('tables', () => {
  it('reads times and refuses what is none, naming the line', () => {
    expect(timesOf('filename,t_us\na.jpg,5\r\n').get('a.jpg')).toBe(5);
    expect(() => timesOf('name,t\na,5')).toThrow('times.csv must begin');
    expect(() => timesOf('filename,t_us\na.jpg,soon')).toThrow('"soon"');
    expect(() => odometryOf('t_us,x_m,y_m,theta_rad\n1,2,3')).toThrow('line 2');
  });

  it('interpolates odometry and turns the short way round', () => {
    const rows = odometryOf('t_us,x_m,y_m,theta_rad\n0,0,0,3.0\n10,1,2,-3.0');
    const middle = odometryAt(rows, 5);
    expect(middle).toMatchObject({ x_m: 0.5, y_m: 1 });
    expect(Math.cos(middle?.theta_rad ?? 0)).toBeCloseTo(-1, 6);
    expect(odometryAt(rows, 99)?.x_m).toBe(1);
    expect(odometryAt([], 0)).toBeNull();
  });

  it('sends with each picture what is known of it', () => {
    const rows = odometryOf('t_us,x_m,y_m,theta_rad\n0,0,0,0\n10,1,2,0.5');
    expect(headersOf('a.jpg', 1, null, rows)['X-Homeward-Odometry']).toBe('1,2,0.5');
    expect(headersOf('a.jpg', 1, new Map([['a.jpg', 0]]), rows)).toEqual({
      'X-Homeward-Filename': 'a.jpg',
      'X-Homeward-T-Us': '0',
      'X-Homeward-Odometry': '0,0,0',
    });
    expect(headersOf('b.jpg', 0, new Map(), rows)).toEqual({ 'X-Homeward-Filename': 'b.jpg' });
  });
});

describe('sweeps', () => {
  const geometry = {
    angle_min_rad: -1.57,
    angle_step_rad: 0.0087,
    range_max_m: 12,
    robot_from_scan: { x_m: 0.3, y_m: 0, theta_rad: 0 },
  };
  const about = JSON.stringify({ format: 'homeward-scans', version: 1, ...geometry });

  it('are those of the table with the geometry beside it; what saw nothing is null', () => {
    const sweeps = sweepsOf('filename,r0,r1\r\na.jpg,1.25,\r\n\r\nb.jpg,0,12.0\nc.jpg,1e6,.5', about);
    expect(sweeps.get('a.jpg')).toEqual({ ...geometry, ranges_m: [1.25, null] });
    expect(sweeps.get('b.jpg')?.ranges_m).toEqual([0, 12]);
    expect(sweeps.get('c.jpg')?.ranges_m).toEqual([null, 0.5]);
    expect(sweeps.size).toBe(3);
  });

  it('are refused with the line that is wrong', () => {
    const rays = (count: number) => Array.from({ length: count }, (_, i) => `r${i}`).join(',');
    expect(sweepsOf(`filename,${rays(10_000)}`, about).size).toBe(0);
    expect(() => sweepsOf(`filename,${rays(10_001)}`, about)).toThrow('10000 rays at most');
    expect(() => sweepsOf('filename,r1\n', about)).toThrow('scans.csv must begin');
    expect(() => sweepsOf('\nfilename,r0\n', about)).toThrow('scans.csv must begin');
    expect(() => sweepsOf('filename,r0,r1\n\na.jpg,1\n', about)).toThrow('line 3: 3 values');
    for (const cell of ['far', '-1', '0x10', '1 ', 'NaN', 'Infinity'])
      expect(() => sweepsOf(`filename,r0\na.jpg,${cell}\n`, about)).toThrow(
        `line 2: "${cell}" is no distance`,
      );
    expect(() => sweepsOf('filename,r0\na.jpg,1\na.jpg,1\n', about)).toThrow('line 3');
  });

  it('are refused with what is wrong about their geometry', () => {
    const wrong = (value: unknown) => () => sweepsOf('filename,r0\n', JSON.stringify(value));
    const whole = { format: 'homeward-scans', version: 1, ...geometry };
    expect(wrong([])).toThrow('scans.json must be a JSON object');
    expect(wrong({ ...whole, format: 'homeward-tour' })).toThrow('homeward-scans');
    expect(wrong({ ...whole, angle_min_rad: '0' })).toThrow('"angle_min_rad" must be a number');
    expect(wrong({ ...whole, robot_from_scan: null })).toThrow('"robot_from_scan" must be an object');
    expect(wrong({ ...whole, robot_from_scan: { x_m: 0, y_m: 0 } })).toThrow('"theta_rad" must be a number');
    expect(wrong({ ...whole, colour: 1 })).toThrow('"colour" is not known');
  });
});
