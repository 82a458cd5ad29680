// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { connection, me, now_ms } from '../../api/server';
import { statusAgeMs } from '../../api/server_state';
import type { Robot } from '../../api/types';
import { Choice, TextField } from '../../components/field';
import { Notice, Waiting } from '../../components/notice';
import { SecretOnce } from '../../components/secret_once';
import { connected, maps, robots } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { without } from '../../lib/draft';
import { explorePath, exploringRobot } from '../../lib/explore_address';
import { atLeast } from '../../lib/roles';
import { follow, path } from '../../lib/router';
import { ageText, percent } from '../../lib/words';
import { ExplorePage } from '../explore/explore_page';
import { exploresNow } from '../go/journey';
import { LivePicture } from './live_picture';
import { directionWord, endOf, stateTone, stateWord, whyStopped } from './robot_words';

/** The robots; at /robots/r1/explore the page on which one of them maps a building by itself. */
export function RobotsPage() {
  const exploring = exploringRobot(path.value);
  return exploring === null ? <RobotList /> : <ExplorePage id={exploring} />;
}

function RobotList() {
  const mayInstall = atLeast(me.value?.role, 'installer');
  if (connection.value.server === null) return <Waiting what="Asking the server …" />;
  return (
    <>
      <h1>Robots</h1>
      {robots.value.length === 0 && <Notice still>There is no robot yet.</Notice>}
      <ul class="stack">
        {robots.value.map((one) => (
          <li key={one.id}>
            <RobotCard robot={one} mayInstall={mayInstall} />
          </li>
        ))}
      </ul>
      {mayInstall && <AddRobot />}
    </>
  );
}

function RobotCard({ robot, mayInstall }: { robot: Robot; mayInstall: boolean }) {
  const why = whyStopped(robot);
  const ended = endOf(robot, now_ms.value);
  return (
    <section class="card robot" aria-labelledby={`robot-${robot.id}`}>
      <LivePicture robot={robot} />
      <div class="stack">
        <div class="row apart">
          <h2 id={`robot-${robot.id}`}>{robot.name}</h2>
          {connected.value ? (
            <span class={`pill ${stateTone(robot)}`}>{stateWord(robot)}</span>
          ) : (
            <span class="pill warn">As last heard: {stateWord(robot)}</span>
          )}
        </div>
        {why !== null && (
          <Notice tone="warn" still>
            <strong>Why it stopped:</strong> {why}
            {ended !== null && <span class="soft"> {ended}</span>}
          </Notice>
        )}
        <Exploring robot={robot} mayInstall={mayInstall} />
        <Facts robot={robot} />
        {mayInstall && <MapChoice robot={robot} />}
      </div>
    </section>
  );
}

/** That it maps the building by itself, or has, and the way to where that is watched and begun. */
function Exploring({ robot, mayInstall }: { robot: Robot; mayInstall: boolean }) {
  const now = exploresNow(robot);
  if (!now && !mayInstall && robot.mission?.kind !== 'explore') return null;
  const words = now ? 'Watch it' : mayInstall ? 'Let it map a building by itself' : 'See what it mapped';
  return (
    <div class="row apart">
      {now && <strong>Maps the building by itself</strong>}
      <a class="button" href={explorePath(robot.id)} onClick={follow}>
        {words}
        <span class="hidden-text">: {robot.name}</span>
      </a>
    </div>
  );
}

function Facts({ robot }: { robot: Robot }) {
  const age = statusAgeMs(robot, connection.value.server?.heard_ms[robot.id], now_ms.value);
  const map =
    maps.value.find((one) => one.id === robot.map)?.name ?? (robot.map === null ? 'None' : robot.map);
  const { speed_mps = null, min_range_m = null, home = null } = robot.online ? robot : {};
  const facts: [string, string][] = [
    ['Last heard', age === null ? 'Never' : age < 2000 ? 'Just now' : `${ageText(age)} ago`],
    ['Map', map],
    ['Driven by', robot.lease?.holder ?? 'Nobody'],
  ];
  if (speed_mps !== null) facts.push(['Speed', `${speed_mps.toFixed(2)} m/s`]);
  if (min_range_m !== null) facts.push(['Nearest thing', `${min_range_m.toFixed(2)} m`]);
  if (home !== null)
    facts.push(['Next picture is', `${directionWord(home.bearing_rad)} (${percent(home.confidence)} sure)`]);
  return (
    <dl class="facts">
      {facts.map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

function MapChoice({ robot }: { robot: Robot }) {
  const { busy, problem, run } = useCommand();
  const ready = maps.value.filter((one) => one.state === 'ready' || one.id === robot.map);
  return (
    <>
      <Choice
        label={`Map of ${robot.name}`}
        value={robot.map ?? ''}
        disabled={busy}
        onChange={(map) => run(() => calls.assignMap(robot.id, map === '' ? null : map))}
        options={[{ value: '', label: 'None' }, ...ready.map((one) => ({ value: one.id, label: one.name }))]}
        hint={ready.length === 0 ? 'There is no map yet. Build one under Tours.' : undefined}
      />
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </>
  );
}

function AddRobot() {
  const [name, setName] = useState('');
  const [made, setMade] = useState<{ name: string; token: string } | null>(null);
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    run(async () => {
      setMade(await calls.addRobot({ name: name.trim() }));
      setName(without(name));
    });
  };
  return (
    <section class="card stack" aria-labelledby="add-robot">
      <h2 id="add-robot">Add a robot</h2>
      {made && (
        <SecretOnce
          title={`This is the token with which ${made.name} signs in.`}
          token={made.token}
          onClose={() => setMade(null)}
        />
      )}
      <form class="rename" onSubmit={submit}>
        <TextField label="Name of the robot" value={name} onInput={setName} />
        <button type="submit" class="button main" disabled={busy || name.trim() === ''}>
          {busy ? 'Adding …' : 'Add'}
        </button>
      </form>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </section>
  );
}
