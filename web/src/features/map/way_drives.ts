// SPDX-License-Identifier: Apache-2.0
import type { Edge, Graph, LoggedEdit, WayDrives } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { dayText } from '../../lib/words';

export function drivesOf(ways: readonly WayDrives[], from: string, to: string): WayDrives | null {
  return ways.find((one) => one.from === from && one.to === to) ?? null;
}

const kTimes: Readonly<Record<number, string>> = { 1: 'once', 2: 'twice' };
const times = (n: number) => kTimes[n] ?? `${n} times`;

/** How missions fared on one direction of a way; null: none came to it. */
export function drivesWords(drives: WayDrives | null, now_ms: number): string {
  if (!drives || drives.driven + drives.failed === 0) return 'Not driven yet.';
  const { driven, failed, last_driven_us, last_failed_us } = drives;
  const failing = (last_failed_us ?? 0) > (last_driven_us ?? 0);
  const latest_us = failing ? last_failed_us : last_driven_us;
  const counts = [
    ...(driven > 0 ? [`driven ${times(driven)}`] : []),
    ...(failed > 0 ? [`failed ${times(failed)}`] : []),
    ...(latest_us === null ? [] : [`last on ${dayText(latest_us, now_ms)}`]),
    ...(failing && driven > 0 ? ['when it failed'] : []),
  ].join(', ');
  const never = driven === 0 ? ' Never driven to its end.' : '';
  return `${counts.charAt(0).toUpperCase()}${counts.slice(1)}.${never}`;
}

// Changes of names and destinations leave a way as it is; so does a doubt that somebody left open.
const kOfPlaces: ReadonlySet<LoggedEdit['kind']> = new Set([
  'merge',
  'split',
  'delete',
  'move',
  'add_edge',
  'remove_edge',
  'block_edge',
  'decide',
  'decide_shortcut',
]);

/** When somebody last changed one of two places, or the ways at them. */
function changedUs(graph: Graph, edits: readonly LoggedEdit[], from: string, to: string): number {
  const { places } = indexOf(graph);
  const images = new Set([from, to].flatMap((one) => places.get(one)?.members ?? []));
  const here = ({ image_a, image_b, images: more }: LoggedEdit) =>
    images.has(image_a) || (image_b !== null && images.has(image_b)) || more.some((one) => images.has(one));
  return Math.max(
    0,
    // Also what was taken back: the chair may have driven while it stood.
    ...edits.filter((one) => kOfPlaces.has(one.kind) && here(one)).map((one) => one.t_us),
  );
}

/**
 * Whether the chair drives a direction slowly: a person put it there, and no mission has driven it since its places were last
 * changed and without failing there since.
 */
export function isSlow(
  edge: Pick<Edge, 'from' | 'to' | 'by' | 'shortcut'>,
  drives: WayDrives | null,
  graph: Graph,
  edits: readonly LoggedEdit[],
): boolean {
  if (edge.by !== 'person' || edge.shortcut) return false;
  const driven_us = drives?.last_driven_us ?? null;
  if (driven_us === null || driven_us < (drives?.last_failed_us ?? 0)) return true;
  return driven_us <= changedUs(graph, edits, edge.from, edge.to);
}
