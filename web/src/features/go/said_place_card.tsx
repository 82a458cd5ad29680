// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, Robot } from '../../api/types';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { whereabouts } from '../../lib/whereabouts';
import { askWords, needsWord, offerWords, spotsOf, thanksWords, type Spot } from './said_place';

interface Props {
  robot: Robot;
  graph: Graph;
}

/** Lets a person say where the robot is: offered plainly where it does not know, quietly elsewhere. */
export function SaidPlaceCard({ robot, graph }: Props) {
  const [open, setOpen] = useState(false);
  const [said, setSaid] = useState<Spot | null>(null);
  const rest = useRef<HTMLDivElement>(null);
  const spots = spotsOf(graph);
  if (spots.length === 0) return null;
  const needed = needsWord(whereabouts(robot.belief, graph));
  const close = (spot: Spot | null) => {
    setOpen(false);
    setSaid(spot);
    // The button that was pressed is gone; keyboards go on from here.
    requestAnimationFrame(() => rest.current?.focus());
  };
  if (open) return <Asking robot={robot} graph={graph} spots={spots} onClose={close} />;
  return (
    <div class="said-place" tabIndex={-1} ref={rest}>
      {said && <Notice>{thanksWords(said)}</Notice>}
      {/* Just told, it has not looked yet. */}
      {!(said && robot.belief === null) && (
        <button
          type="button"
          class={needed ? 'button main' : 'button quiet'}
          onClick={() => {
            setSaid(null);
            setOpen(true);
          }}
        >
          <Icon name="map" />
          {offerWords(robot.name, needed)}
        </button>
      )}
    </div>
  );
}

interface AskingProps extends Props {
  spots: readonly Spot[];
  onClose: (said: Spot | null) => void;
}

function Asking({ robot, graph, spots, onClose }: AskingProps) {
  const [label, setLabel] = useState<string | null>(null);
  const { busy, problem, run } = useCommand();
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => heading.current?.focus(), []);
  const spot = spots.find((one) => one.label === label);
  const submit = (event: Event) => {
    event.preventDefault();
    if (!spot) return;
    run(async () => {
      await calls.setPlace(robot.id, spot.label);
      onClose(spot);
    });
  };
  return (
    <form class="card stack" aria-labelledby="said-place" data-testid="said-place" onSubmit={submit}>
      <h2 id="said-place" tabIndex={-1} ref={heading}>
        {askWords(robot.name)}
      </h2>
      <div class="spots" role="radiogroup" aria-labelledby="said-place">
        {spots.map((one) => (
          <label key={one.label} class="spot">
            <input
              type="radio"
              name="said-place"
              checked={one.label === label}
              onChange={() => setLabel(one.label)}
            />
            <img src={calls.placeThumbnailUrl(graph.map, one.place, graph.revision)} alt="" loading="lazy" />
            <span>{one.name}</span>
          </label>
        ))}
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
      <div class="row">
        <button type="submit" class="button main" disabled={busy || !spot}>
          {busy ? 'Telling …' : `${robot.name} is here`}
        </button>
        <button type="button" class="button" onClick={() => onClose(null)}>
          Cancel
        </button>
      </div>
    </form>
  );
}
