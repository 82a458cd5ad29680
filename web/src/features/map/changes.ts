// SPDX-License-Identifier: Apache-2.0
import type { Graph, LoggedEdit } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';

/** What one request of a person changed on a map: undone and redone as a whole. */
export interface Change {
  number: number;
  by: string;
  t_us: number;
  undone: boolean;
  redoable: boolean;
  edits: readonly LoggedEdit[];
}

/** The changes of a log, oldest first. */
export function changesOf(edits: readonly LoggedEdit[]): Change[] {
  const changes = new Map<number, Change>();
  for (const edit of edits) {
    const { change: number, by, t_us, undone, redoable } = edit;
    const known = changes.get(number);
    changes.set(number, { number, by, t_us, undone, redoable, edits: [...(known?.edits ?? []), edit] });
  }
  return [...changes.values()];
}

/** The one that an undo takes back; null: there is none. */
export function undoable(changes: readonly Change[]): Change | null {
  return changes.filter((one) => !one.undone).at(-1) ?? null;
}

/** The one that a redo makes again; null: there is none. */
export function redoable(changes: readonly Change[]): Change | null {
  return changes.find((one) => one.redoable) ?? null;
}

/** What somebody was not sure of, by the kind of the doubt. */
const kOf: Readonly<Record<string, string | undefined>> = {
  same_place: 'whether two places are one',
  mixed_place: 'whether a place is one',
  way: 'whether there is a way',
};

const kVerbs: Readonly<Record<LoggedEdit['kind'], (text: string) => string>> = {
  rename: (text) => (text === '' ? 'took the name of a place away' : `named a place “${text}”`),
  merge: () => 'joined two places',
  split: () => 'split a place',
  delete: () => 'removed a place',
  move: () => 'moved pictures',
  add_edge: () => 'added a way',
  remove_edge: () => 'removed a way',
  block_edge: (text) => (text === 'true' ? 'closed a way' : 'opened a way'),
  decide: () => 'decided whether two places are one',
  decide_shortcut: (text) => (text === 'accept' ? 'accepted a shortcut' : 'rejected a shortcut'),
  set_aside: (text) => `was not sure ${kOf[text] ?? 'of a doubt'}`,
  add_destination: (text) => `added the destination “${text}”`,
  remove_destination: () => 'removed a destination',
  name_destination: (text) => `named a destination “${text}”`,
  set_pictogram: (text) =>
    text === '' ? 'took the pictogram of a destination away' : `gave a destination the pictogram “${text}”`,
  set_destination_picture: () => 'moved a destination to another picture',
};

function titleOf(graph: Graph, image: string | null): string | null {
  const place = image === null ? undefined : indexOf(graph).place_of_image.get(image);
  return place ? placeTitle(graph, place.id) : null;
}

/** Why the map could not keep some of a change when it was last built, each reason once. */
export function lostBecause(change: Change): string[] {
  return [...new Set(change.edits.flatMap(({ lost, undone }) => (lost !== null && !undone ? [lost] : [])))];
}

/** What was done, and to which places: completes "anna …". Both directions of a way are one way. */
export function changeWords(change: Change, graph: Graph): string {
  const parts = new Map<string, number>();
  const seen = new Set<string>();
  for (const { kind, text, image_a, image_b } of change.edits) {
    const pair = [image_a, image_b ?? ''].sort().join(' ');
    if (seen.has(`${kind} ${text} ${pair}`)) continue;
    seen.add(`${kind} ${text} ${pair}`);
    const [from, to] = [titleOf(graph, image_a), titleOf(graph, image_b)];
    const ends = [...new Set([from, to])].join(' – ');
    const between = from !== null && to !== null ? `: ${ends}` : '';
    const words = kVerbs[kind](text) + between;
    parts.set(words, (parts.get(words) ?? 0) + 1);
  }
  return [...parts].map(([words, times]) => (times > 1 ? `${words} (${times} times)` : words)).join('; ');
}
