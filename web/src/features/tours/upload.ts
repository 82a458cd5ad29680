// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import * as calls from '../../api/calls';
import { asProblem, ProblemError } from '../../api/problem';
import type { Sweep, Tour } from '../../api/types';
import { headersOf, odometryOf, sweepsOf, timesOf, type TourFiles } from './tour_folder';

/** The upload under way, or how the last one ended; it goes on while other pages are shown. */
export type UploadState =
  | { kind: 'none' }
  | { kind: 'running'; name: string; sent: number; total: number; waiting: boolean }
  | { kind: 'done'; name: string; total: number }
  | { kind: 'failed'; name: string; reason: string };

export const upload = signal<UploadState>({ kind: 'none' });

/** Rises when an upload has begun a tour and when one has ended, whatever page is shown: lists of tours are old then. */
export const tourListVersion = signal(0);

const kAtOnce = 3;
const kRetries = 8;
const kPauseMs = 1500;
const kPictureTimeoutMs = 60_000;

let stopper: AbortController | null = null;

/** Stops the upload; what has arrived stays, and the same folder continues it later. */
export function cancelUpload(): void {
  stopper?.abort();
}

/** Begins a tour (or goes on with `open`), sends all pictures, marks and the word that it is complete. */
export async function uploadTour(
  name: string,
  files: TourFiles<File>,
  camera: File | null,
  open: Tour | null,
): Promise<void> {
  stopper = new AbortController();
  const { signal: stop } = stopper;
  const total = files.images.length;
  upload.value = { kind: 'running', name, sent: 0, total, waiting: false };
  try {
    // All that is read here first: what is wrong in it makes no tour that stays open.
    const times = files.times ? timesOf(await files.times.text()) : null;
    const odometry = files.odometry ? odometryOf(await files.odometry.text()) : null;
    const sweeps =
      files.scans && files.scansAbout
        ? sweepsOf(await files.scans.text(), await files.scansAbout.text())
        : null;
    const marks = files.marks ? marksIn(await files.marks.text()) : null;
    const tour = open ?? (await begin(name, camera));
    tourListVersion.value += 1;
    // A sweep is sent again where its picture has arrived: whether it has as well is not known.
    const left = files.images
      .map((file, n) => ({ file, n, known: arrived(tour, n), sweep: sweeps?.get(file.name) }))
      .filter(({ known, sweep }) => !known || sweep);
    let sent = files.images.filter((_, n) => arrived(tour, n)).length;
    const tell = (waiting: boolean) => (upload.value = { kind: 'running', name, sent, total, waiting });
    const worker = async () => {
      for (let next = left.shift(); next && !stop.aborted; next = left.shift()) {
        const { file, n, known, sweep } = next;
        const send = (ask: () => Promise<unknown>) => persistently(ask, stop, () => tell(true));
        if (!known) {
          const headers = headersOf(file.name, n, times, odometry);
          await send(() => calls.putImage(tour.id, n, file, headers, pictureLimit(stop)));
        }
        if (sweep) await send(() => sendSweep(tour.id, n, file.name, sweep, pictureLimit(stop)));
        if (!known) sent += 1;
        tell(false);
      }
    };
    await Promise.all(Array.from({ length: kAtOnce }, worker));
    if (stop.aborted) throw new Error('it was stopped; choose the same folder to go on');
    if (marks) await calls.putMarks(tour.id, marks);
    await calls.completeTour(tour.id);
    upload.value = { kind: 'done', name, total };
  } catch (thrown) {
    const stopped = stop.aborted;
    stopper.abort(); // the other workers need not go on
    const reason = stopped ? 'It was stopped. Choose the same folder to go on.' : asProblem(thrown).message;
    upload.value = { kind: 'failed', name, reason };
  } finally {
    tourListVersion.value += 1;
  }
}

/** A refusal says in which file, of which picture and what of it. */
async function sendSweep(
  tour: string,
  n: number,
  name: string,
  sweep: Sweep,
  limit: AbortSignal,
): Promise<void> {
  try {
    await calls.putSweep(tour, n, name, sweep, limit);
  } catch (thrown) {
    const { code, status, message, where } = asProblem(thrown);
    if (status < 400 || status >= 500 || status === 429) throw thrown;
    const said = `scans.csv, ${name}: ${message}${where ? ` (${where})` : ''}`;
    throw new ProblemError(code, status, said, where);
  }
}

function pictureLimit(stop: AbortSignal): AbortSignal {
  return AbortSignal.any([stop, AbortSignal.timeout(kPictureTimeoutMs)]);
}

async function begin(name: string, camera: File | null): Promise<Tour> {
  if (!camera) throw new Error('a tour needs the file camera.json of its camera');
  return calls.addTour({ name, camera: await jsonIn(camera) });
}

async function jsonIn(file: File): Promise<unknown> {
  try {
    return JSON.parse(await file.text()) as unknown;
  } catch {
    throw new Error(`${file.name} is not a JSON file`);
  }
}

function marksIn(text: string): { image: string; label: string }[] {
  const value = JSON.parse(text) as { marks?: { image: string; label: string }[] };
  return value.marks ?? [];
}

/** Whether the server has picture `n` already; it lists at most 100 of those that are missing. */
export function arrived(tour: Pick<Tour, 'images' | 'missing'>, n: number): boolean {
  const listed_to = tour.missing.length < 100 ? Infinity : Math.max(...tour.missing);
  const highest = tour.images + tour.missing.length;
  return n <= listed_to && n < highest && !tour.missing.includes(n);
}

/** Repeats while the server is out of reach or busy. */
async function persistently(
  ask: () => Promise<unknown>,
  stop: AbortSignal,
  onWait: () => void,
): Promise<void> {
  for (let tries = 1; ; ++tries) {
    try {
      await ask();
      return;
    } catch (thrown) {
      const { status } = asProblem(thrown);
      const passing = status === 0 || status === 503 || status === 429;
      if (!passing || tries > kRetries || stop.aborted) throw thrown;
      onWait();
      await new Promise((done) => setTimeout(done, kPauseMs));
    }
  }
}
