// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { now_ms } from '../../api/server';
import type { Graph, Robot } from '../../api/types';
import { Icon } from '../../components/icons';
import { Bar } from '../../components/notice';
import { connected } from '../../lib/chosen';
import { explorePath } from '../../lib/explore_address';
import { follow } from '../../lib/router';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { isActive, placesToGo, progressOf, type Journey } from './journey';
import { arrivalSureness, heading, reasonOf, recordWords, toneOf } from './journey_words';

const kShownSteps = 6;

interface Props {
  robot: Robot;
  journey: Journey;
  graph: Graph | null;
  onAgain: (() => void) | null;
  onDismiss: () => void;
}

/** The newest journey: asked, driving, done or refused, with its way and the reason when it ended early. */
export function JourneyCard({ robot, journey, graph, onAgain, onDismiss }: Props) {
  const { phase } = journey;
  const reason = reasonOf(journey);
  const sureness = arrivalSureness(journey, graph);
  const record = recordWords(journey, now_ms.value);
  const active = isActive(phase) || phase === 'asking';
  const steps = Math.max(0, journey.path.length - 1);
  return (
    <section
      class={`card journey ${toneOf(phase)}`}
      aria-label="Journey"
      data-phase={phase}
      data-testid="journey"
    >
      <div class="row journey-head">
        {active && connected.value ? (
          <span class="spinner" />
        ) : (
          <Icon name={phase === 'arrived' ? 'done' : 'warn'} size={30} />
        )}
        <h2>{heading(journey, graph)}</h2>
      </div>
      {active && !connected.value && (
        <p>
          <span class="pill warn">As last heard</span>
        </p>
      )}
      {reason !== null && <p>{reason}</p>}
      {sureness !== null && <p>{sureness}</p>}
      {isActive(phase) && steps > 0 && (
        <div class="stack tight">
          <Bar share={progressOf(journey)} label="Progress" />
          <p class="soft small">
            {journey.path_index >= steps ? 'Almost there' : `${count(placesToGo(journey), 'place')} to go`}
          </p>
        </div>
      )}
      {isActive(phase) && graph && <Way journey={journey} graph={graph} />}
      {journey.explores && <ToExploration robot={robot} active={active} />}
      {record !== null && <p class="soft small">{record}</p>}
      {!active && (
        <div class="row">
          {onAgain && (
            <button type="button" class="button" onClick={onAgain}>
              Try again
            </button>
          )}
          <button type="button" class="button quiet" onClick={onDismiss}>
            Hide this
          </button>
        </div>
      )}
    </section>
  );
}

function ToExploration({ robot, active }: { robot: Robot; active: boolean }) {
  return (
    <div class="row">
      <a class="button" href={explorePath(robot.id)} onClick={follow}>
        {active ? 'Watch it' : 'See how far it came'}
      </a>
    </div>
  );
}

/** The next places of the way as small pictures, the goal last. */
function Way({ journey, graph }: { journey: Journey; graph: Graph }) {
  const rest = journey.path.slice(journey.path_index);
  const shown = rest.length <= kShownSteps ? rest : [...rest.slice(0, kShownSteps - 1), ...rest.slice(-1)];
  const left_out = rest.length - shown.length;
  return (
    <ol class="way" aria-label="Next places on the way">
      {shown.map((place, i) => (
        <li key={`${place}-${i}`} class={i === shown.length - 1 ? 'goal' : ''}>
          {left_out > 0 && i === shown.length - 1 && <span class="soft small way-gap">+{left_out}</span>}
          <img
            src={calls.placeThumbnailUrl(graph.map, place, graph.revision)}
            alt={placeTitle(graph, place)}
            loading="lazy"
          />
        </li>
      ))}
    </ol>
  );
}
