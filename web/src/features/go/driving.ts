// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import * as calls from '../../api/calls';
import { connection, me } from '../../api/server';
import { asProblem } from '../../api/problem';
import type { Lease } from '../../api/types';
import { isActive, journeyOf, wishOf, type Command, type Journey, type Target } from './journey';

/** What this page asked of each robot, and the leases that it holds. */
export const commands = signal<Readonly<Record<string, Command>>>({});
const leases = new Map<
  string,
  { lease: Lease; timer: ReturnType<typeof setTimeout>; idle_since_ms: number | null }
>();

// A lease is given back this long after the robot has nothing left to do, so that others need not take it over.
const kIdleBeforeReleaseMs = 15_000;

function tell(robot: string, command: Command): void {
  commands.value = { ...commands.peek(), [robot]: command };
}

export function forgetCommand(robot: string): void {
  commands.value = Object.fromEntries(Object.entries(commands.peek()).filter(([id]) => id !== robot));
}

/** What somebody has said yes to: taking over from whoever drives, giving up the drive that is under way. */
export interface Sure {
  take_over?: boolean;
  divert?: boolean;
}

/** The newest journey of a robot, as this page knows it. */
function journeyNow(robot: string): Journey | null {
  const reported = connection.peek().server?.robots.find((one) => one.id === robot);
  return reported ? journeyOf(reported, commands.peek()[robot]) : null;
}

/**
 * Sends a robot: takes its lease when need be (from somebody else only with `take_over`) and starts the mission. One that
 * is under way to somewhere else goes on until somebody is sure.
 */
export async function send(robot: string, target: Target, sure: Sure = {}): Promise<void> {
  const { take_over = false, divert = take_over } = sure;
  const holder = holderOf(robot);
  const ours = holder === null || holder === me.peek()?.name; // of somebody else's drive the lease asks
  const wish = divert || !ours ? 'new' : wishOf(journeyNow(robot), target);
  if (wish === 'same') return;
  if (wish === 'diversion') {
    tell(robot, { kind: 'diversion', target });
    return;
  }
  await begin(robot, target, take_over);
}

async function begin(robot: string, target: Target, take_over: boolean): Promise<void> {
  tell(robot, { kind: 'asking', target });
  try {
    const mission = await withLease(robot, (lease_id) => start(robot, lease_id, target), take_over);
    tell(robot, { kind: 'sent', target, mission });
  } catch (thrown) {
    const problem = asProblem(thrown);
    if (problem.code === 'lease_held') tell(robot, { kind: 'held', target, holder: holderOf(robot) });
    else tell(robot, { kind: 'refused', target, reason: problem.message });
  }
}

/** Does what needs the lease, and takes it when need be; from somebody else only with `take_over`. */
export async function withLease<T>(
  robot: string,
  work: (lease_id: string) => Promise<T>,
  take_over = false,
): Promise<T> {
  try {
    return await work(await ensureLease(robot, take_over));
  } catch (thrown) {
    const holder = holderOf(robot);
    // Another window of the same person gives way without a question.
    const own = holder !== null && holder === me.peek()?.name;
    if (asProblem(thrown).code === 'lease_held' && !take_over && own) return withLease(robot, work, true);
    throw thrown;
  }
}

/**
 * Does once what needs the lease of a robot that is driven elsewhere or not at all. It is not kept: another window of the same
 * person has the same one and keeps it, and one that nobody had ends by itself. Never takes it from somebody else.
 */
export async function withLeaseOnce<T>(robot: string, work: (lease_id: string) => Promise<T>): Promise<T> {
  const held = leases.get(robot);
  return work(held ? held.lease.id : (await calls.takeLease(robot, false)).lease.id);
}

/** Says whether the robot is where it asks about. Takes the lease when nobody has it, never from somebody else. */
export async function answer(robot: string, mission: string, question: number, here: boolean): Promise<void> {
  const lease_id = await ensureLease(robot, false);
  await calls.answerQuestion(robot, mission, { lease_id, question, here });
}

async function start(robot: string, lease_id: string, target: Target) {
  const what =
    target.destination === undefined ? { place: target.place } : { destination: target.destination };
  return calls.startMission(robot, { lease_id, ...what });
}

function holderOf(robot: string): string | null {
  return connection.peek().server?.robots.find((one) => one.id === robot)?.lease?.holder ?? null;
}

async function ensureLease(robot: string, take_over: boolean): Promise<string> {
  const held = leases.get(robot);
  if (held) {
    try {
      keep(robot, (await calls.keepLease(robot, held.lease.id)).lease);
      return held.lease.id;
    } catch (thrown) {
      drop(robot);
      if (asProblem(thrown).code === 'unreachable') throw thrown;
    }
  }
  const { lease } = await calls.takeLease(robot, take_over);
  keep(robot, lease);
  return lease.id;
}

function keep(robot: string, lease: Lease): void {
  const before = leases.get(robot);
  if (before) clearTimeout(before.timer);
  const pause_ms = Math.max(500, lease.expires_in_ms / 3);
  leases.set(robot, {
    lease: { ...before?.lease, ...lease },
    idle_since_ms: before?.idle_since_ms ?? null,
    timer: setTimeout(() => void renew(robot), pause_ms),
  });
  remember();
}

function drop(robot: string): void {
  const held = leases.get(robot);
  if (held) clearTimeout(held.timer);
  leases.delete(robot);
  remember();
}

/** Keeps the lease while the robot is under way, and gives it back some time after. */
async function renew(robot: string): Promise<void> {
  const held = leases.get(robot);
  if (!held) return;
  const journey = journeyNow(robot);
  const busy = journey !== null && (isActive(journey.phase) || journey.phase === 'asking');
  held.idle_since_ms = busy ? null : (held.idle_since_ms ?? Date.now());
  try {
    if (held.idle_since_ms !== null && Date.now() - held.idle_since_ms > kIdleBeforeReleaseMs) {
      drop(robot);
      await calls.releaseLease(robot, held.lease.id);
    } else {
      keep(robot, (await calls.keepLease(robot, held.lease.id)).lease);
    }
  } catch (thrown) {
    // Out of reach: try again soon, the lease may still be ours. Anything else: it is gone.
    if (asProblem(thrown).code === 'unreachable' && leases.has(robot)) keep(robot, held.lease);
    else drop(robot);
  }
}

const kKey = 'homeward.leases';

/** Keeps the leases over a reload of the page, and no longer than this tab is open. */
function remember(): void {
  try {
    sessionStorage.setItem(kKey, JSON.stringify([...leases].map(([robot, { lease }]) => [robot, lease])));
  } catch {
    // storage may be forbidden; a reload then lets the robot stop when the lease ends
  }
}

/** Takes up the leases of this tab again after a reload, so that a robot under way goes on. */
export async function resumeLeases(): Promise<void> {
  for (const [robot, lease] of remembered())
    await calls.keepLease(robot, lease.id).then(
      (answer) => keep(robot, { ...lease, ...answer.lease }),
      () => undefined, // it has ended; the next press takes a new one
    );
}

function remembered(): [string, Lease][] {
  try {
    return JSON.parse(sessionStorage.getItem(kKey) ?? '[]') as [string, Lease][];
  } catch {
    return [];
  }
}

/** Gives every lease back, on signing out. */
export async function releaseAll(): Promise<void> {
  const held = [...leases].map(([robot, { lease }]) => ({ robot, lease }));
  for (const { robot } of held) drop(robot);
  await Promise.allSettled(held.map(({ robot, lease }) => calls.releaseLease(robot, lease.id)));
}
