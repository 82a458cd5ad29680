// SPDX-License-Identifier: Apache-2.0
import type { Exploration, Robot } from '../../api/types';
import { count } from '../../lib/words';
import { reasonSentence } from '../../words/reasons';
import { exploresNow, isActive } from '../go/journey';

export type Tone = 'good' | 'warn' | 'bad';

/** How far it is, for the page: as the robot tells it, and 'starting' until it tells of what it was sent to. */
export type Stage = Exploration['phase'] | 'starting' | 'none';

export function stageOf(robot: Robot, exploration: Exploration | null): Stage {
  const { mission } = robot;
  const told = exploration && (!exploresNow(robot) || exploration.id === mission?.exploration);
  if (!told) return exploresNow(robot) ? 'starting' : 'none';
  // Sent on, it tells of that in a moment.
  return exploration.phase === 'paused' && mission?.state === 'accepted' ? 'starting' : exploration.phase;
}

interface Words {
  title: string;
  pill: string;
  tone: Tone;
}

const kWords: Readonly<Record<Exclude<Stage, 'none'>, (name: string) => Words>> = {
  starting: (name) => ({ title: `${name} is about to set out`, pill: 'Starting', tone: 'good' }),
  waiting: (name) => ({ title: `${name} reads what it has seen before`, pill: 'Reading', tone: 'good' }),
  exploring: (name) => ({ title: `${name} maps the building by itself`, pill: 'Exploring', tone: 'good' }),
  paused: (name) => ({ title: `${name} stands; the exploration is paused`, pill: 'Paused', tone: 'warn' }),
  ended: (name) => ({
    title: `${name} has ended; its pictures go to the server`,
    pill: 'Ended',
    tone: 'good',
  }),
  uploaded: () => ({ title: 'Its pictures are a tour now', pill: 'Done', tone: 'good' }),
};

/** Of one that was ended before its first picture, or that the robot could not read again, there is no tour. */
const kNoTour: Words = { title: 'It has ended, and no tour came of it', pill: 'Ended', tone: 'warn' };

export function stageWords(
  stage: Exclude<Stage, 'none'>,
  name: string,
  exploration: Exploration | null,
): Words {
  return stage === 'uploaded' && exploration?.tour === null ? kNoTour : kWords[stage](name);
}

/** Why it is so, as sentences, each once: what the exploration says, and how the drive ended that was to go on with it. */
export function whyWords(robot: Robot, exploration: Exploration | null): string[] {
  const { mission } = robot;
  // What is over says itself why; how its last drive ended is no news then.
  const over = exploration?.phase === 'ended' || exploration?.phase === 'uploaded';
  const ended = mission?.kind === 'explore' && !exploresNow(robot) && !over ? mission : null;
  const own = ended && (exploration === null || ended.exploration === exploration.id) ? ended.reason : null;
  const said = [exploration?.reason ?? null, own].flatMap((one) => (one ? [reasonSentence(one)] : []));
  return [...new Set(said)];
}

/** "2 h 5 min", "5 min", "40 s". */
export function durationText(seconds: number): string {
  if (seconds < 60) return `${Math.floor(seconds)} s`;
  const minutes = Math.floor(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

export function metresText(metres: number): string {
  return metres < 100 ? `${metres.toFixed(1)} m` : `${Math.round(metres)} m`;
}

/** What there is to be counted, by its name. */
export function figures({ pictures, driven_m, explored_s, unreached }: Exploration): [string, string][] {
  return [
    ['Pictures', String(pictures)],
    ['Driven', metresText(driven_m)],
    ['Time', durationText(explored_s)],
    ['Could not get to', count(unreached, 'place')],
  ];
}

/** The plan in words, for those who do not see it. */
export function planWords(exploration: Exploration | null, stage: Stage, name: string): string {
  if (!exploration || stage === 'none') return 'Plan of the building: nothing was seen yet.';
  const { pictures, driven_m, loops, fences, floor, pose } = exploration;
  const parts = [
    `${stageWords(stage, name, exploration).title}.`,
    `${count(pictures, 'picture')}, ${metresText(driven_m)} driven,`,
    `${count(loops.length, 'place')} known again, ${count(fences.length, 'fence')}.`,
  ];
  if (!floor) parts.push('Nothing of the floor was seen yet.');
  if (!pose) parts.push('Where the robot is, is not known.');
  return `Plan of the building. ${parts.join(' ')}`;
}

/** Why the robot cannot be told anything just now; null when it can. */
export function barrierOf(robot: Robot, connected: boolean): string | null {
  if (!connected) return 'The house server is out of reach, so the robot cannot be told anything.';
  if (!robot.online) return `${robot.name} is not connected, so it cannot be told anything.`;
  if (robot.mission?.kind === 'drive' && isActive(robot.mission.state))
    return `${robot.name} is on its way to a place. Stop it first.`;
  return null;
}
