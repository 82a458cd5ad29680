// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, Robot } from '../../api/types';
import { Icon } from '../../components/icons';
import { chosenAge, connected } from '../../lib/chosen';
import { whereabouts, type Whereabouts } from '../../lib/whereabouts';
import { ageText, percent } from '../../lib/words';
import { exploresNow } from './journey';

const kStaleMs = 5000;

/** Where the robot is, how sure it is, and how old that is. */
export function WhereaboutsCard({ robot, graph }: { robot: Robot; graph: Graph | null }) {
  const found = exploresNow(robot) ? null : whereabouts(robot.belief, graph); // it is on no map then
  const age = chosenAge.value;
  const stale = age !== null && age > kStaleMs;
  const known = found && found.sureness !== 'lost' && robot.online;
  return (
    <section class="card where" aria-label={`Where ${robot.name} is`}>
      <WherePicture robot={robot} graph={graph} />
      <div class="where-text">
        <p class="soft row small">
          <strong>{robot.name}</strong>
          {connected.value ? (
            <span class={robot.online ? 'pill good' : 'pill bad'}>
              {robot.online ? 'Connected' : 'Not connected'}
            </span>
          ) : (
            <span class="pill warn">As last heard</span>
          )}
        </p>
        <p class="where-words" aria-live="polite">
          {words(robot, found)}
        </p>
        {known && <Sureness found={found} />}
        {age !== null && (stale || !robot.online || !connected.value) && (
          <p class="soft small">Last heard {ageText(age)} ago.</p>
        )}
      </div>
    </section>
  );
}

function words(robot: Robot, found: Whereabouts | null): string {
  if (!robot.online) return `${robot.name} is not connected.`;
  if (exploresNow(robot)) return 'I map the building by myself.';
  if (robot.map === null) return 'I have no map yet.';
  if (!found) return 'I have not looked around yet.';
  if (found.sureness === 'lost') return 'I am not sure where I am.';
  if (found.where === null) return 'I am somewhere on the map.';
  return found.sureness === 'unsure' ? `I am not sure. Perhaps I am ${found.where}.` : `I am ${found.where}.`;
}

function Sureness({ found }: { found: Whereabouts }) {
  const level = found.sureness === 'sure' ? 3 : found.sureness === 'fairly sure' ? 2 : 1;
  const said = { sure: 'Sure', 'fairly sure': 'Fairly sure', unsure: 'Not sure', lost: 'Lost' }[
    found.sureness
  ];
  return (
    <p class="row small sureness">
      <span class={`steps level-${level}`} aria-hidden="true">
        <i />
        <i />
        <i />
      </span>
      <span>
        {said} <span class="soft">({percent(found.share)})</span>
      </span>
    </p>
  );
}

/** The picture of the place; a sign when the robot does not know its place. */
function WherePicture({ robot, graph }: { robot: Robot; graph: Graph | null }) {
  const exploring = exploresNow(robot);
  const place = !exploring && robot.belief && !robot.belief.lost && robot.online ? robot.belief.place : null;
  const src = place !== null && graph ? calls.placeThumbnailUrl(graph.map, place, graph.revision) : null;
  const [failed, setFailed] = useState<string | null>(null);
  useEffect(() => setFailed(null), [src]);
  if (src === null || failed === src)
    return (
      <div class="where-picture unknown">
        <Icon name={!robot.online ? 'warn' : exploring ? 'map' : 'question'} size={48} />
      </div>
    );
  return <img class="where-picture" src={src} alt="" onError={() => setFailed(src)} />;
}
