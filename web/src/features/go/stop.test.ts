// SPDX-License-Identifier: Apache-2.0
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import * as calls from '../../api/calls';
import { ProblemError } from '../../api/problem';
import { connection } from '../../api/server';
import type { Robot } from '../../api/types';
import { afterWord, askToStop, followStops, stop, stopState } from './stop';

const noPause = () => Promise.resolve();
const always = () => true;

const chair: Robot = {
  id: 'r',
  name: 'Chair',
  online: true,
  map: 'm',
  state: 'driving',
  belief: null,
  mission: null,
  lease: null,
  status_age_ms: 0,
};

describe('askToStop', () => {
  it('asks again after a lost request until it gets through, however often', async () => {
    let asked = 0;
    const ask = () => (++asked < 40 ? Promise.reject(new TypeError('Failed to fetch')) : Promise.resolve({}));
    expect(await askToStop(ask, noPause, always)).toBeNull();
    expect(asked).toBe(40);
  });

  it('repeats when the server is busy, but not when it refuses, nor when it is wanted no more', async () => {
    let asked = 0;
    const answer = (status: number) => () => {
      ++asked;
      return Promise.reject(new ProblemError('x', status, 'No.'));
    };
    expect(await askToStop(answer(503), noPause, () => asked < 5)).toBeNull();
    expect(asked).toBe(5);
    asked = 0;
    expect((await askToStop(answer(404), noPause, always))?.message).toBe('No.');
    expect(asked).toBe(1);
  });
});

describe('afterWord', () => {
  const sent = { kind: 'sent', robot: 'r', at_ms: 1000 } as const;
  const stopped: Robot = { ...chair, state: 'stopped' };

  it('takes the robot for standing only when it was itself heard after the press, standing', () => {
    expect(afterWord(sent, [stopped], { r: 900 }, 1200)).toBe(sent);
    expect(afterWord(sent, [chair], { r: 1100 }, 1200)).toBe(sent);
    expect(afterWord(sent, [{ ...stopped, online: false }], { r: 1100 }, 1200)).toBe(sent);
    expect(afterWord(sent, [stopped], { r: 1100 }, 1200)).toEqual({
      kind: 'stands',
      robot: 'r',
      at_ms: 1200,
    });
  });

  it('ends an alarm by a robot that has arrived meanwhile, and no later drive brings it back', () => {
    const alarm = { kind: 'sending', robot: 'r', at_ms: 1000, unheard: true } as const;
    const stands = afterWord(alarm, [{ ...chair, state: 'arrived' }], { r: 9000 }, 9000);
    expect(stands).toMatchObject({ kind: 'stands' });
    expect(afterWord(stands, [chair], { r: 9500 }, 9500)).toBe(stands);
  });
});

describe('stop', () => {
  beforeEach(() => {
    vi.useFakeTimers();
    let keys = 0;
    vi.spyOn(calls, 'randomId').mockImplementation(() => `key ${++keys}`);
    connection.value = { ...connection.peek(), state: 'live' };
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.restoreAllMocks();
    stopState.value = { kind: 'ready' };
    connection.value = { state: 'closed', server: null, last_message_ms: null };
  });

  const deaf = () => new Promise<never>((_, fail) => setTimeout(() => fail(new TypeError('aborted')), 2500));

  it('says within a second that nobody has heard it, and goes on until somebody does', async () => {
    const asked = vi.spyOn(calls, 'stopRobot').mockImplementation(deaf);
    void stop('r');
    expect(stopState.value).toMatchObject({ kind: 'sending', unheard: false });
    await vi.advanceTimersByTimeAsync(900);
    expect(stopState.value).toMatchObject({ kind: 'sending', unheard: true });
    await vi.advanceTimersByTimeAsync(60_000);
    expect(stopState.value).toMatchObject({ kind: 'sending', unheard: true });
    asked.mockResolvedValue({ stop_id: 's' });
    await vi.advanceTimersByTimeAsync(3000);
    expect(stopState.value).toMatchObject({ kind: 'sent', robot: 'r' });
    expect(new Set(asked.mock.calls.map(([, key]) => key)).size).toBe(1);
  });

  it('says so at once where the server was silent before, and is over when the chair is seen to stand', async () => {
    const end = followStops();
    const asked = vi.spyOn(calls, 'stopRobot').mockImplementation(deaf);
    connection.value = { ...connection.peek(), state: 'offline' };
    void stop('r');
    expect(stopState.value).toMatchObject({ kind: 'sending', unheard: true });
    await vi.advanceTimersByTimeAsync(5000);
    const arrived: Robot = { ...chair, state: 'arrived' };
    const server = {
      seq: 1,
      build: 'b',
      robots: [arrived],
      jobs: [],
      maps: [],
      heard_ms: { r: Date.now() },
      since: 1,
      drafts: {},
      explorations: {},
      plan_poses: {},
    };
    connection.value = { state: 'live', server, last_message_ms: Date.now() };
    expect(stopState.value).toMatchObject({ kind: 'stands' });
    const before = asked.mock.calls.length;
    await vi.advanceTimersByTimeAsync(20_000);
    expect(asked.mock.calls.length).toBe(before);
    end();
  });
});
