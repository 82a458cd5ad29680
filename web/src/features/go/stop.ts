// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import * as calls from '../../api/calls';
import { asProblem, type ProblemError } from '../../api/problem';
import { connection } from '../../api/server';
import type { Robot } from '../../api/types';
import { isActive } from './journey';

/** What became of the last press on STOP, and of which robot it was. */
export type StopState =
  | { kind: 'ready' }
  | { kind: 'sending'; robot: string; at_ms: number; unheard: boolean } // not answered in time
  | { kind: 'sent'; robot: string; at_ms: number } // the server has it
  | { kind: 'stands'; robot: string; at_ms: number } // the robot was heard since, and stands
  | { kind: 'failed'; robot: string; at_ms: number; reason: string }; // the server refuses it

export const stopState = signal<StopState>({ kind: 'ready' });

// A server that lives answers a stop within a few milliseconds; longer than this a rider must not wait to be told.
const kUnheardMs = 700;
const kPauseMs = 400;

/**
 * Asks until the server has answered: a stop that got lost on the way is sent again under the same key, for as long as it
 * is `wanted`. Refusals that repeating cannot mend end it at once. Returns what to tell.
 */
export async function askToStop(
  ask: () => Promise<unknown>,
  pause: (ms: number) => Promise<void>,
  wanted: () => boolean,
): Promise<ProblemError | null> {
  while (wanted()) {
    try {
      await ask();
      return null;
    } catch (thrown) {
      const problem = asProblem(thrown);
      if (problem.status >= 400 && problem.status < 500 && problem.status !== 429) return problem;
    }
    await pause(kPauseMs);
  }
  return null;
}

/**
 * What a word of the robots makes of the state. A robot that was heard after the press and stands needs the stop no more:
 * that ends it, so that neither an alarm nor a stop that is still under way meets a later drive.
 */
export function afterWord(
  state: StopState,
  robots: readonly Robot[],
  heard_ms: Readonly<Record<string, number>>,
  now_ms: number,
): StopState {
  if (state.kind === 'ready' || state.kind === 'stands') return state;
  const robot = robots.find((one) => one.id === state.robot);
  const heard = (heard_ms[state.robot] ?? 0) > state.at_ms;
  const stands = robot?.online && robot.state !== 'driving' && !isActive(robot.mission?.state);
  return heard && stands ? { kind: 'stands', robot: state.robot, at_ms: now_ms } : state;
}

/** Lets what the events tell end alarms; returns its end. */
export function followStops(): () => void {
  return connection.subscribe(({ state, server }) => {
    if (state !== 'live' || !server) return;
    stopState.value = afterWord(stopState.peek(), server.robots, server.heard_ms, Date.now());
  });
}

let presses = 0;

export async function stop(robot: string): Promise<void> {
  const press = ++presses;
  const key = calls.randomId();
  const at_ms = Date.now();
  const present = () => press === presses && stopState.peek().kind === 'sending';
  // Where the server is silent already, nobody need wait to be told.
  const unheard = connection.peek().state !== 'live';
  stopState.value = { kind: 'sending', robot, at_ms, unheard };
  const timer = setTimeout(() => {
    if (present()) stopState.value = { kind: 'sending', robot, at_ms, unheard: true };
  }, kUnheardMs);
  const problem = await askToStop(
    () => calls.stopRobot(robot, key),
    (ms) => new Promise((done) => setTimeout(done, ms)),
    present,
  );
  clearTimeout(timer);
  if (!present()) return;
  stopState.value = problem
    ? { kind: 'failed', robot, at_ms, reason: problem.message }
    : { kind: 'sent', robot, at_ms: Date.now() };
}
