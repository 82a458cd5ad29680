// SPDX-License-Identifier: Apache-2.0
import type { Graph, Shortcut } from '../../api/types';
import { percent } from '../../lib/words';

const kOrder: Readonly<Record<Shortcut['state'], number>> = { proposed: 0, accepted: 1, rejected: 2 };

/** All of a map: those that wait for a decision first, and of these what saves most. */
export function shortcutsToShow(graph: Graph): Shortcut[] {
  const saved_m = (one: Shortcut) => one.way_m - one.length_m;
  return [...graph.shortcuts].sort((a, b) => kOrder[a.state] - kOrder[b.state] || saved_m(b) - saved_m(a));
}

/** Those that begin or end at a place. */
export function shortcutsAt(graph: Graph, place: string): Shortcut[] {
  return shortcutsToShow(graph).filter((one) => one.place_a === place || one.place_b === place);
}

/** What speaks for a shortcut, in a sentence. */
export function evidenceOf(one: Shortcut): string {
  return (
    `${one.length_m.toFixed(1)} m straight instead of ${one.way_m.toFixed(1)} m by the way that was driven. ` +
    `On the tour ${one.clear_m.toFixed(1)} m of floor were seen free all along. ` +
    `The two pictures have ${one.inliers} things in common and tell the direction that the tour tells; ` +
    `by themselves they would be ${percent(one.confidence)} sure of it.`
  );
}

/** Lines to draw for shortcuts that are not edges yet. */
export function proposedLines(graph: Graph): { id: string; from: string; to: string }[] {
  const places = new Set(graph.places.map((place) => place.id));
  return graph.shortcuts
    .filter((one) => one.state === 'proposed' && places.has(one.place_a) && places.has(one.place_b))
    .map((one) => ({ id: `shortcut:${one.place_a}|${one.place_b}`, from: one.place_a, to: one.place_b }));
}
