// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Robot } from '../../api/types';
import { stopWords } from './stop_words';

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
const sent = { kind: 'sent', at_ms: 1000 } as const;

describe('stopWords', () => {
  it('says stopped only when the robot itself was heard after the press, standing', () => {
    const stopped: Robot = { ...chair, state: 'stopped' };
    expect(stopWords(sent, stopped, 900, 1200)?.text).toBe('Stop received …');
    expect(stopWords(sent, chair, 1100, 1200)?.text).toBe('Stop received …');
    expect(stopWords(sent, stopped, 1100, 1200)).toEqual({ text: 'Chair has stopped.', bad: false });
    expect(stopWords(sent, stopped, 1100, 60_000)).toBeNull();
  });

  it('raises the alarm when the robot does not confirm', () => {
    expect(stopWords(sent, chair, 5500, 6000)).toMatchObject({ bad: true });
    expect(stopWords(sent, { ...chair, online: false }, 1100, 1200)?.text).toContain('not connected');
  });

  it('sends the rider to the button on the chair when the server is out of reach', () => {
    expect(stopWords({ kind: 'sending', tries: 1 }, chair, 0, 0)).toMatchObject({ bad: false });
    expect(stopWords({ kind: 'sending', tries: 2 }, chair, 0, 0)?.text).toContain('button on the chair');
    expect(stopWords({ kind: 'failed', reason: 'No answer.' }, chair, 0, 0)?.text).toContain('No answer.');
    expect(stopWords({ kind: 'ready' }, chair, 0, 0)).toBeNull();
  });
});
