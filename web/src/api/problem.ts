// SPDX-License-Identifier: Apache-2.0
import type { Problem } from './types';

/** What went wrong with a request, ready to be shown. `code` is the contract's error code, or one of ours. */
export class ProblemError extends Error {
  constructor(
    readonly code: string,
    readonly status: number,
    message: string,
    readonly where?: string,
  ) {
    super(message);
    this.name = 'ProblemError';
  }
}

/** Sentences for the codes that people meet; every other code shows the server's own words. */
const kSentences: Readonly<Record<string, string>> = {
  not_signed_in: 'Please sign in again.',
  unauthenticated: 'Please sign in again.',
  stale_revision:
    'Somebody else changed the map in the meantime. It has been loaded again: please look and repeat.',
};

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

/** Whether `value` has the members of a problem document (RFC 9457) that we read. */
export function isProblem(value: unknown): value is Problem {
  return isRecord(value) && typeof value.code === 'string' && typeof value.title === 'string';
}

/** A refused answer as an error; an answer that is no problem document is described by its status. */
export function problemFrom(status: number, body: unknown): ProblemError {
  if (isProblem(body)) {
    const said = body.detail || body.title;
    return new ProblemError(body.code, status, kSentences[body.code] ?? sentence(said), body.where);
  }
  if (status === 401) return new ProblemError('not_signed_in', status, 'Please sign in again.');
  if (status === 403) return new ProblemError('forbidden', status, 'Your account may not do this.');
  if (status === 503) return new ProblemError('busy', status, 'The house server is busy. Please try again.');
  return new ProblemError(`http_${status}`, status, `The house server answered with error ${status}.`);
}

/** An exception of fetch itself: nothing was answered. */
export function unreachable(): ProblemError {
  return new ProblemError('unreachable', 0, 'The house server does not answer.');
}

export function asProblem(thrown: unknown): ProblemError {
  if (thrown instanceof ProblemError) return thrown;
  if (thrown instanceof TypeError) return unreachable();
  return new ProblemError(
    'unexpected',
    0,
    thrown instanceof Error ? sentence(thrown.message) : 'Something unexpected happened.',
  );
}

/** First letter large, a full stop at the end: server texts become sentences. */
export function sentence(text: string): string {
  const trimmed = text.trim();
  if (trimmed === '') return 'No reason was given.';
  const first = trimmed.charAt(0).toUpperCase() + trimmed.slice(1);
  return /[.!?]$/.test(first) ? first : `${first}.`;
}
