// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { asProblem, problemFrom, sentence } from './problem';

describe('problemFrom', () => {
  it('shows the detail of a problem document as a sentence and keeps its code', () => {
    const error = problemFrom(409, {
      type: 'about:blank',
      title: 'lease held',
      status: 409,
      detail: 'anna is driving this robot',
      code: 'lease_held',
    });
    expect(error.code).toBe('lease_held');
    expect(error.message).toBe('Anna is driving this robot.');
  });

  it('describes an answer that is no problem document by its status', () => {
    expect(problemFrom(502, '<html>').message).toContain('502');
    expect(problemFrom(401, null).code).toBe('not_signed_in');
  });

  it('tells a refused request from a server that does not answer', () => {
    expect(asProblem(new TypeError('Failed to fetch')).code).toBe('unreachable');
    expect(asProblem(new RangeError('odd')).code).toBe('unexpected');
  });
});

describe('sentence', () => {
  it('never shows an empty reason', () => {
    expect(sentence('  ')).toBe('No reason was given.');
    expect(sentence('no route')).toBe('No route.');
    expect(sentence('Stop!')).toBe('Stop!');
  });
});
