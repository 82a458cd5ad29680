// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { Icon } from '../../components/icons';
import { Pictogram } from '../../components/pictogram';
import type { Goal } from './goals';
import type { Phase } from './journey';
import { toneOf } from './journey_words';

interface Props {
  goal: Goal;
  graph: Graph;
  phase: Phase | null; // of the newest journey, when it leads here
  here: boolean;
  disabled: boolean;
  onGo: () => void;
}

const kMarks: Readonly<Record<Phase, string>> = {
  asking: 'Asking …',
  accepted: 'About to start',
  driving: 'On the way',
  arrived: 'Arrived',
  refused: 'Refused',
  stopped: 'Stopped',
  failed: 'Not reached',
};

/** One place to go to: its picture, its name, and how far a journey there has come. */
export function DestinationCard({ goal, graph, phase, here, disabled, onGo }: Props) {
  const [attempt, setAttempt] = useState(0);
  const sources = [
    calls.imageThumbnailUrl(graph.map, goal.image),
    calls.placeThumbnailUrl(graph.map, goal.place, graph.revision),
  ];
  const src = sources[attempt];
  const mark = phase ? kMarks[phase] : here ? 'I am here' : null;
  return (
    <li>
      <button
        type="button"
        class={`destination ${phase ?? ''}`}
        aria-disabled={disabled}
        onClick={() => {
          if (!disabled) onGo();
        }}
      >
        {src === undefined ? (
          <span class="picture no-picture">
            <Icon name="go" size={48} />
          </span>
        ) : (
          <img class="picture" src={src} alt="" onError={() => setAttempt(attempt + 1)} />
        )}
        <span class="destination-name">
          <span class="destination-title">
            {goal.pictogram && <Pictogram name={goal.pictogram} size={36} />}
            <span>{goal.name}</span>
          </span>
          {mark && <span class={`pill ${phase ? toneOf(phase) : ''}`}>{mark}</span>}
        </span>
      </button>
    </li>
  );
}
