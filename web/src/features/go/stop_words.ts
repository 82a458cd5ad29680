// SPDX-License-Identifier: Apache-2.0
import type { Robot } from '../../api/types';
import type { StopState } from './stop';

export interface StopWords {
  text: string;
  bad: boolean;
}

// A stop is commanded within a fraction of a second; longer than this without a word from the robot is worth saying.
const kSilenceMs = 4000;
const kShownMs = 12_000;

/** What is told about the last press on STOP; null when there is nothing to tell (any more). `robot`: that it was of. */
export function stopWords(state: StopState, robot: Robot | null, now_ms: number): StopWords | null {
  switch (state.kind) {
    case 'ready':
      return null;
    case 'sending':
      return state.unheard
        ? {
            text: 'STOP was not heard: the house server does not answer. Use the stop button on the chair! Trying again …',
            bad: true,
          }
        : { text: 'Stopping …', bad: false };
    case 'failed':
      return {
        text: `STOP did not get through: ${state.reason} Use the stop button on the chair!`,
        bad: true,
      };
    case 'stands':
      if (!robot || now_ms - state.at_ms > kShownMs) return null;
      return { text: `${robot.name} has stopped.`, bad: false };
    case 'sent': {
      if (!robot) return { text: 'Stop received.', bad: false };
      if (!robot.online)
        return {
          text: `Stop received, but ${robot.name} is not connected. It stops by itself then.`,
          bad: true,
        };
      return now_ms - state.at_ms > kSilenceMs
        ? {
            text: `Stop received, but ${robot.name} has not confirmed it. Use the stop button on the chair!`,
            bad: true,
          }
        : { text: 'Stop received …', bad: false };
    }
  }
}
