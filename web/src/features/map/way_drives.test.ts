// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, LoggedEdit, WayDrives } from '../../api/types';
import { dayText } from '../../lib/words';
import { drivesOf, drivesWords, isSlow } from './way_drives';

const at = (month: number, day: number) => new Date(2026, month - 1, day, 12).getTime() * 1000;
const now_ms = at(6, 1) / 1000;
const day = (t_us: number) => dayText(t_us, now_ms);
const drives = (part: Partial<WayDrives> = {}): WayDrives => ({
  from: 'p1',
  to: 'p2',
  driven: 12,
  failed: 0,
  last_driven_us: at(5, 3),
  last_failed_us: null,
  ...part,
});

describe('how missions fared on a way', () => {
  const said = (part: Partial<WayDrives> = {}) => drivesWords(drives(part), now_ms);

  it('is said with how often and when last', () => {
    expect(said()).toBe(`Driven 12 times, last on ${day(at(5, 3))}.`);
    expect(said({ failed: 1, last_failed_us: at(4, 1) })).toBe(
      `Driven 12 times, failed once, last on ${day(at(5, 3))}.`,
    );
    expect(said({ driven: 1, failed: 2, last_failed_us: at(5, 9) })).toBe(
      `Driven once, failed twice, last on ${day(at(5, 9))}, when it failed.`,
    );
    expect(said({ driven: 0, last_driven_us: null, failed: 3, last_failed_us: at(5, 9) })).toBe(
      `Failed 3 times, last on ${day(at(5, 9))}. Never driven to its end.`,
    );
  });

  it('is nothing where none came', () => {
    expect(drivesWords(null, now_ms)).toBe('Not driven yet.');
    expect(drivesOf([drives()], 'p1', 'p2')).toEqual(drives());
    expect(drivesOf([drives()], 'p2', 'p1')).toBeNull();
  });
});

describe('a way that a person drew', () => {
  const graph = {
    places: [
      { id: 'p1', label: '', members: ['t/1.jpg'] },
      { id: 'p2', label: '', members: ['t/2.jpg'] },
    ],
    edges: [],
    destinations: [],
  } as unknown as Graph;
  const edge = { from: 'p1', to: 'p2', by: 'person' as const, shortcut: false };
  const edit = (part: Partial<LoggedEdit>) =>
    ({
      kind: 'move',
      image_a: 't/2.jpg',
      image_b: null,
      images: [],
      t_us: at(5, 10),
      undone: false,
      ...part,
    }) as LoggedEdit;

  it('is slow until it was driven, and after it failed', () => {
    expect(isSlow(edge, null, graph, [])).toBe(true);
    expect(isSlow(edge, drives(), graph, [])).toBe(false);
    expect(isSlow({ ...edge, shortcut: true }, null, graph, [])).toBe(false);
    expect(isSlow(edge, drives({ failed: 1, last_failed_us: at(5, 4) }), graph, [])).toBe(true);
    expect(isSlow(edge, drives({ failed: 1, last_failed_us: at(5, 2) }), graph, [])).toBe(false);
    expect(isSlow({ ...edge, by: 'method' }, null, graph, [])).toBe(false);
  });

  it('is slow again after its places were changed', () => {
    expect(isSlow(edge, drives(), graph, [edit({})])).toBe(true);
    expect(isSlow(edge, drives(), graph, [edit({ image_a: 't/9.jpg', images: ['t/1.jpg'] })])).toBe(true);
    expect(isSlow(edge, drives(), graph, [edit({ undone: true })])).toBe(true);
    expect(isSlow(edge, drives(), graph, [edit({ t_us: at(5, 1) })])).toBe(false);
    expect(isSlow(edge, drives(), graph, [edit({ image_a: 't/9.jpg' })])).toBe(false);
    expect(isSlow(edge, drives(), graph, [edit({ kind: 'rename' }), edit({ kind: 'set_aside' })])).toBe(
      false,
    );
  });
});
