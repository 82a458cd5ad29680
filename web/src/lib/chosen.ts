// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from '@preact/signals';
import { connection, graphs, now_ms } from '../api/server';
import { statusAgeMs } from '../api/server_state';
import type { MapInfo, Robot } from '../api/types';

const kKey = 'homeward.robot';

function remembered(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null; // storage may be forbidden; then nothing is remembered
  }
}

const wanted = signal<string | null>(typeof localStorage === 'undefined' ? null : remembered());

export function choose(robot: string): void {
  wanted.value = robot;
  try {
    localStorage.setItem(kKey, robot);
  } catch {
    // not remembered then
  }
}

export const robots = computed<readonly Robot[]>(() => connection.value.server?.robots ?? []);
export const maps = computed<readonly MapInfo[]>(() => connection.value.server?.maps ?? []);
export const connected = computed(() => connection.value.state === 'live');

/** The robot that Go and STOP are about: the chosen one, else the first that is connected, else the first. */
export const chosen = computed<Robot | null>(() => {
  const all = robots.value;
  return all.find((one) => one.id === wanted.value) ?? all.find((one) => one.online) ?? all[0] ?? null;
});

export const chosenMap = computed<MapInfo | null>(() => {
  const map = chosen.value?.map ?? null;
  return maps.value.find((one) => one.id === map) ?? null;
});

export const chosenGraph = computed(() => {
  const map = chosenMap.value;
  return map ? (graphs.value[map.id]?.graph ?? null) : null;
});

/** Milliseconds since the chosen robot was last heard of. */
export const chosenAge = computed<number | null>(() => {
  const robot = chosen.value;
  return robot ? statusAgeMs(robot, connection.value.server?.heard_ms[robot.id], now_ms.value) : null;
});
