// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { Notice } from '../../components/notice';
import { isActive, type Journey, type Target } from './journey';
import { goalName } from './journey_words';

interface Props {
  name: string; // of the robot
  journey: Journey | null; // that it is on, or was on when it was asked
  graph: Graph | null;
  target: Target;
  disabled: boolean;
  onGo: () => void;
  onLeave: () => void;
}

/** The robot is under way and somebody wants it elsewhere: nothing changes until they say so again. */
export function DiversionPrompt({ name, journey, graph, target, disabled, onGo, onLeave }: Props) {
  const goal = journey && isActive(journey.phase) ? goalName(journey, graph) : null;
  return (
    <Notice tone="warn">
      <div class="stack">
        <p role="alert">
          <strong>{goal === null ? `${name} stands now.` : `${name} is on the way to ${goal}.`}</strong>{' '}
          {goal === null ? `Go to ${target.label}?` : `Go to ${target.label} instead?`}
        </p>
        <div class="row">
          <button type="button" class="button main" disabled={disabled} onClick={onGo}>
            {goal === null ? `Go to ${target.label}` : `Go to ${target.label} instead`}
          </button>
          <button type="button" class="button" onClick={onLeave}>
            {goal === null ? 'Stay here' : `Go on to ${goal}`}
          </button>
        </div>
      </div>
    </Notice>
  );
}
