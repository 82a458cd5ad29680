// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { dateText } from '../../lib/words';
import { changeWords, type Change } from './changes';

/** Two states of a map: after the change `from`, 0 for none, and after `to`; null: as it is now. */
export interface TwoStates {
  from: number;
  to: number | null;
}

/** The changes that stand, oldest first: the map was in a state after each of them. */
export function standing(changes: readonly Change[]): Change[] {
  return changes.filter((one) => !one.undone).sort((a, b) => a.number - b.number);
}

/** Two states that there are, the earlier one first, from what an address says; as built and now where it says nothing. */
export function statesOf(of: readonly number[], stand: readonly Change[]): TwoStates {
  const [from = 0, to = null] = of;
  const newest = stand.at(-1)?.number ?? 0;
  const known = (number: number) => number === 0 || stand.some((one) => one.number === number);
  const later = to !== null && to > from && to !== newest && known(to) ? to : null;
  return { from: known(from) ? from : 0, to: later };
}

export function numbersOf({ from, to }: TwoStates): number[] {
  return to === null ? [from] : [from, to];
}

/** Before and after one change. */
export function around(change: Change, stand: readonly Change[]): TwoStates {
  const at = stand.findIndex((one) => one.number === change.number);
  const newest = at === stand.length - 1;
  return { from: stand[at - 1]?.number ?? 0, to: newest ? null : change.number };
}

/** What a state is called; null: as the map is now. */
export function stateTitle(number: number | null, stand: readonly Change[], graph: Graph): string {
  if (number === null) return 'As it is now';
  const change = stand.find((one) => one.number === number);
  if (!change) return number === 0 ? 'As it was built' : `After change ${number}`;
  return `After ${change.by} ${changeWords(change, graph)}, ${dateText(change.t_us)}`;
}
