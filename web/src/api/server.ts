// SPDX-License-Identifier: Apache-2.0
import { effect, signal } from '@preact/signals';
import * as calls from './calls';
import { EventSocket, type EventSocketView } from './event_socket';
import { asProblem, type ProblemError } from './problem';
import type { Graph, MapInfo, User } from './types';

/** Who is signed in: undefined while unknown, null when nobody. */
export const me = signal<User | null | undefined>(undefined);
/** True when the server ended the session of this page; the sign-in page then says so. */
export const wasSignedOut = signal(false);
/** Why it could not be found out who is signed in. */
export const meError = signal<ProblemError | null>(null);
export const connection = signal<EventSocketView>({ state: 'closed', server: null, last_message_ms: null });
/** A clock for ages on screen; one second is enough for people. */
export const now_ms = signal(Date.now());
/** True when the server was replaced by another build while this page was open. */
export const newBuild = signal(false);

export const socket = new EventSocket({
  open: () => {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    return new WebSocket(`${scheme}://${location.host}/api/v1/events`);
  },
  now_ms: () => Date.now(),
  after: (delay_ms, call) => {
    const timer = setTimeout(call, delay_ms);
    return () => clearTimeout(timer);
  },
  random: () => Math.random(),
});

export async function findOutWho(): Promise<void> {
  meError.value = null;
  try {
    me.value = (await calls.whoAmI()).user;
  } catch (thrown) {
    const problem = asProblem(thrown);
    if (problem.status === 401 || problem.status === 403) me.value = null;
    else meError.value = problem;
  }
}

const kAskWhoMs = 12_000;

/** Starts clock and events; called once by main. */
export function startServerConnection(): void {
  calls.whenSignedOut(() => {
    if (me.peek()) wasSignedOut.value = true;
    me.value = null;
  });
  setInterval(() => (now_ms.value = Date.now()), 1000);
  let unsubscribe: (() => void) | null = null;
  let firstBuild: string | null = null;
  effect(() => {
    if (me.value && !unsubscribe) {
      unsubscribe = socket.subscribe((view) => {
        connection.value = view;
        const build = view.server?.build ?? null;
        firstBuild ??= build;
        if (build !== null && build !== firstBuild) newBuild.value = true;
      });
    } else if (!me.value && unsubscribe) {
      unsubscribe();
      unsubscribe = null;
      connection.value = socket.view;
      graphs.value = {};
    }
  });
  addEventListener('online', () => socket.retryNow());
  addEventListener('offline', () => socket.reconnect());
  document.addEventListener('visibilitychange', () => {
    if (!document.hidden) socket.retryNow();
  });
  setInterval(() => void askWho(), kAskWhoMs);
}

/** A socket that is refused does not say why; REST does (401 leads to the sign-in page). */
async function askWho(): Promise<void> {
  if (connection.peek().state === 'offline' && me.peek()) await calls.whoAmI().catch(() => undefined);
}

/** A map's graph as last loaded: what it shows, whether it is being loaded, and why it could not be. */
export interface GraphEntry {
  graph: Graph | null;
  error: ProblemError | null;
  wanted_revision: number;
}

export const graphs = signal<Readonly<Record<string, GraphEntry>>>({});

/** Loads the graph of `map` unless its present revision is there or on its way. */
export function wantGraph(map: MapInfo, again = false): void {
  const entry = graphs.peek()[map.id];
  if (!again && entry && entry.wanted_revision >= map.revision) return;
  setGraph(map.id, { graph: entry?.graph ?? null, error: null, wanted_revision: map.revision });
  calls.graph(map.id).then(
    (graph) =>
      setGraph(map.id, { graph, error: null, wanted_revision: Math.max(graph.revision, map.revision) }),
    (thrown: unknown) =>
      setGraph(map.id, {
        graph: entry?.graph ?? null,
        error: asProblem(thrown),
        wanted_revision: map.revision,
      }),
  );
}

function setGraph(map: string, entry: GraphEntry): void {
  graphs.value = { ...graphs.peek(), [map]: entry };
}
