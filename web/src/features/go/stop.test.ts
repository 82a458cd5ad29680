// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { ProblemError } from '../../api/problem';
import { askToStop } from './stop';

const noPause = () => Promise.resolve();

describe('askToStop', () => {
  it('asks again after a lost request until it gets through', async () => {
    let asked = 0;
    const tries: number[] = [];
    const problem = await askToStop(
      () => (++asked < 4 ? Promise.reject(new TypeError('Failed to fetch')) : Promise.resolve({})),
      noPause,
      (n) => tries.push(n),
    );
    expect(problem).toBeNull();
    expect(tries).toEqual([1, 2, 3, 4]);
  });

  it('repeats when the server is busy, but not when it refuses', async () => {
    let asked = 0;
    const answer = (status: number) => () => {
      ++asked;
      return Promise.reject(new ProblemError('x', status, 'No.'));
    };
    expect((await askToStop(answer(503), noPause, () => undefined))?.status).toBe(503);
    expect(asked).toBeGreaterThan(5);
    asked = 0;
    expect((await askToStop(answer(404), noPause, () => undefined))?.message).toBe('No.');
    expect(asked).toBe(1);
  });
});
