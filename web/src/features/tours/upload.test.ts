// SPDX-License-Identifier: Apache-2.0
import { File as NodeFile } from 'node:buffer'; // Node 18 has none that is global
import { afterEach, expect, it, vi } from 'vitest';
import * as calls from '../../api/calls';
import { ProblemError } from '../../api/problem';
import type { Tour } from '../../api/types';
import { tourFiles } from './tour_folder';
import { arrived, tourListVersion, upload, uploadTour } from './upload';

afterEach(() => vi.restoreAllMocks());

const file = (name: string, text = '') => {
  const made = new NodeFile([text], name) as unknown as File;
  Object.defineProperty(made, 'webkitRelativePath', { value: `t/${name}` });
  return made;
};
const kScans = file(
  'scans.json',
  '{"format":"homeward-scans","version":1,"angle_min_rad":0,"angle_step_rad":0.1,"range_max_m":12,' +
    '"robot_from_scan":{"x_m":0,"y_m":0,"theta_rad":0}}',
);
const kPictures = ['0.jpg', '1.jpg', '2.jpg'].map((name) => file(name));

function pretendServer() {
  return {
    begun: vi
      .spyOn(calls, 'addTour')
      .mockResolvedValue({ id: 't1', images: 0, missing: [] as number[] } as Tour),
    pictures: vi.spyOn(calls, 'putImage').mockResolvedValue(undefined),
    sweeps: vi.spyOn(calls, 'putSweep').mockResolvedValue(undefined),
    complete: vi.spyOn(calls, 'completeTour').mockResolvedValue(undefined),
  };
}

it('sends the sweeps of pictures that had arrived before as well, by the name of their picture', async () => {
  const server = pretendServer();
  const table = file('scans.csv', 'filename,r0\n0.jpg,1\n2.jpg,\n');
  const open = { id: 't1', images: 2, missing: [] as number[] } as unknown as Tour;
  await uploadTour('house', tourFiles([...kPictures, table, kScans]), null, open);
  expect(upload.value).toEqual({ kind: 'done', name: 'house', total: 3 });
  expect(server.pictures.mock.calls.map(([, n]) => n)).toEqual([2]);
  expect(server.sweeps.mock.calls.map(([, n, name, sweep]) => [n, name, sweep.ranges_m])).toEqual([
    [0, '0.jpg', [1]],
    [2, '2.jpg', [null]],
  ]);
});

it('begins no tour where a table is broken, and says where a sweep is refused', async () => {
  const server = pretendServer();
  const camera = file('camera.json', '{}');
  const broken = file('scans.csv', 'filename,r0\n0.jpg,far\n');
  await uploadTour('house', tourFiles([...kPictures, broken, kScans]), camera, null);
  expect(upload.value).toMatchObject({ kind: 'failed' });
  expect(server.begun).not.toHaveBeenCalled();

  server.sweeps.mockRejectedValue(
    new ProblemError('invalid_input', 422, 'A range is wrong.', 'body/ranges_m/0'),
  );
  const table = file('scans.csv', 'filename,r0\n0.jpg,1\n');
  await uploadTour('house', tourFiles([...kPictures, table, kScans]), camera, null);
  expect(upload.value).toMatchObject({ reason: 'scans.csv, 0.jpg: A range is wrong. (body/ranges_m/0)' });
  expect(server.complete).not.toHaveBeenCalled();
});

it('says that the list of tours is old when it has begun one and when it has ended, however it ends', async () => {
  const server = pretendServer();
  const camera = file('camera.json', '{}');
  const before = tourListVersion.value;
  let during = before;
  server.pictures.mockImplementation(() => {
    during = tourListVersion.value;
    return Promise.resolve(undefined);
  });
  await uploadTour('house', tourFiles(kPictures), camera, null);
  expect(during).toBeGreaterThan(before);
  expect(tourListVersion.value).toBeGreaterThan(during);
  const ended = tourListVersion.value;
  server.complete.mockRejectedValue(new ProblemError('conflict', 409, 'No.'));
  await uploadTour('house', tourFiles(kPictures), camera, null);
  expect(upload.value).toMatchObject({ kind: 'failed' });
  expect(tourListVersion.value).toBeGreaterThan(ended + 1);
});

it('goes on after what has arrived, and fills the gaps', () => {
  const tour = { images: 3, missing: [1] }; // 0, 2 and 3 are there
  expect([0, 1, 2, 3, 4].map((n) => arrived(tour, n))).toEqual([true, false, true, true, false]);
  expect(arrived({ images: 0, missing: [] }, 0)).toBe(false);
});

it('sends again where the list of what is missing may have been cut off', () => {
  const missing = Array.from({ length: 100 }, (_, i) => 2 * i);
  expect(arrived({ images: 500, missing }, 1)).toBe(true);
  expect(arrived({ images: 500, missing }, 199)).toBe(false);
});
