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
const sent = { kind: 'sent', robot: 'r', at_ms: 1000 } as const;

describe('stopWords', () => {
  it('says for a while that the chair has stopped', () => {
    const stands = { kind: 'stands', robot: 'r', at_ms: 1000 } as const;
    expect(stopWords(sent, chair, 1200)?.text).toBe('Stop received …');
    expect(stopWords(stands, chair, 1200)).toEqual({ text: 'Chair has stopped.', bad: false });
    expect(stopWords(stands, chair, 60_000)).toBeNull();
  });

  it('raises the alarm when the robot does not confirm', () => {
    expect(stopWords(sent, chair, 6000)).toMatchObject({ bad: true });
    expect(stopWords(sent, { ...chair, online: false }, 1200)?.text).toContain('not connected');
  });

  it('sends the rider to the button on the chair when the server does not hear', () => {
    const sending = { kind: 'sending', robot: 'r', at_ms: 0, unheard: false } as const;
    expect(stopWords(sending, chair, 0)).toMatchObject({ bad: false });
    const words = stopWords({ ...sending, unheard: true }, chair, 0);
    expect(words).toMatchObject({ bad: true });
    expect(words?.text).toContain('STOP was not heard');
    expect(words?.text).toContain('Use the stop button on the chair!');
    const refused = { kind: 'failed', robot: 'r', at_ms: 0, reason: 'No answer.' } as const;
    expect(stopWords(refused, chair, 0)?.text).toContain('No answer.');
    expect(stopWords({ kind: 'ready' }, chair, 0)).toBeNull();
  });
});
