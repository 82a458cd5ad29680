// SPDX-License-Identifier: Apache-2.0
import type { Core } from 'cytoscape';
import { describe, expect, it } from 'vitest';
import { LinkedDrawings } from './linked_drawings';

/** What of a drawing is asked here. */
function drawingAt(zoom: number) {
  const listeners = new Set<() => void>();
  const look = { zoom, pan: { x: 0, y: 0 } };
  return {
    zoom: () => look.zoom,
    pan: () => look.pan,
    viewport: (next: typeof look) => {
      Object.assign(look, next);
      for (const one of listeners) one();
    },
    on: (_: string, listener: () => void) => listeners.add(listener),
    off: (_: string, listener: () => void) => listeners.delete(listener),
  };
}

describe('linked drawings', () => {
  it('show the same part until one leaves', () => {
    const linked = new LinkedDrawings();
    const [a, b] = [drawingAt(1), drawingAt(2)];
    linked.join(a as unknown as Core);
    const leave = linked.join(b as unknown as Core);
    expect(b.zoom()).toBe(1);
    b.viewport({ zoom: 3, pan: { x: 5, y: 6 } });
    expect([a.zoom(), a.pan()]).toEqual([3, { x: 5, y: 6 }]);
    leave();
    a.viewport({ zoom: 4, pan: { x: 0, y: 0 } });
    expect(b.zoom()).toBe(3);
  });
});
