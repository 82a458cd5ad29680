// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph } from '../../api/types';
import type { Change } from './changes';
import { around, numbersOf, standing, statesOf, stateTitle } from './states';

const change = (number: number, undone = false): Change => ({
  number,
  by: 'anna',
  t_us: 0,
  undone,
  redoable: false,
  edits: [],
});
const stand = [change(2), change(5), change(9)];

describe('two states of a map', () => {
  it('are after changes that stand, in their order', () => {
    expect(standing([change(5), change(2), change(3, true)]).map((one) => one.number)).toEqual([2, 5]);
  });

  it('are as built and as now where the address says nothing that there is', () => {
    expect(statesOf([], stand)).toEqual({ from: 0, to: null });
    expect(statesOf([3, 4], stand)).toEqual({ from: 0, to: null });
    expect(statesOf([2, 5], stand)).toEqual({ from: 2, to: 5 });
    expect(statesOf([5, 2], stand)).toEqual({ from: 5, to: null });
    expect(statesOf([0, 9], stand)).toEqual({ from: 0, to: null });
    expect(statesOf([9], stand)).toEqual({ from: 9, to: null });
  });

  it('are written as they are read', () => {
    for (const states of [
      { from: 0, to: 5 },
      { from: 2, to: null },
    ])
      expect(statesOf(numbersOf(states), stand)).toEqual(states);
  });

  it('lie around a change', () => {
    expect(around(change(2), stand)).toEqual({ from: 0, to: 2 });
    expect(around(change(5), stand)).toEqual({ from: 2, to: 5 });
    expect(around(change(9), stand)).toEqual({ from: 5, to: null });
  });

  it('have titles', () => {
    const graph = { places: [], edges: [], destinations: [] } as unknown as Graph;
    expect(stateTitle(0, stand, graph)).toBe('As it was built');
    expect(stateTitle(null, stand, graph)).toBe('As it is now');
    expect(stateTitle(5, stand, graph)).toMatch(/^After anna /);
    expect(stateTitle(4, stand, graph)).toBe('After change 4');
  });
});
