// SPDX-License-Identifier: Apache-2.0
import { applyEvent, type ServerState } from './server_state';
import type { ServerEvent } from './types';

export type ConnectionState = 'closed' | 'connecting' | 'live' | 'offline';

/** The part of WebSocket that is used, so that tests can hand in their own. */
export interface SocketLike {
  onmessage: ((event: MessageEvent<unknown>) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
  close(): void;
}

export interface EventSocketOptions {
  open: () => SocketLike;
  now_ms: () => number;
  after: (delay_ms: number, call: () => void) => () => void; // returns its cancel
  random: () => number; // [0, 1)
}

export interface EventSocketView {
  state: ConnectionState;
  server: ServerState | null;
  last_message_ms: number | null;
}

type Listener = (view: EventSocketView) => void;

const kFirstRetryMs = 400;
const kLongestRetryMs = 8000;
// The server beats each second (proto/asyncapi.yaml). After this the page says that what it shows is old.
const kSilenceMs = 2500;
// A connection that tells nothing for so long is given up for a new one; until then it may go on where it was.
const kDeadMs = 6000;

/**
 * The one connection for events: opened with the first subscriber, closed with the last, opened again after every loss
 * with growing pauses. What cannot be read drops the connection, because a new one begins with a full snapshot. One that
 * falls silent counts as offline while it lasts: an open connection alone says nothing of whoever is at its other end.
 */
export class EventSocket {
  private readonly listeners_ = new Set<Listener>();
  private socket_: SocketLike | null = null;
  private cancelRetry_: (() => void) | null = null;
  private cancelWatch_: (() => void) | null = null;
  private failures_ = 0;
  private view_: EventSocketView = { state: 'closed', server: null, last_message_ms: null };

  constructor(private readonly options_: EventSocketOptions) {}

  get view(): EventSocketView {
    return this.view_;
  }

  /** Calls `listener` now and at every change; returns its unsubscribe. */
  subscribe(listener: Listener): () => void {
    this.listeners_.add(listener);
    if (this.listeners_.size === 1) this.connect();
    listener(this.view_);
    return () => {
      if (!this.listeners_.delete(listener) || this.listeners_.size > 0) return;
      this.drop();
      this.view_ = { state: 'closed', server: null, last_message_ms: null };
    };
  }

  /** Tries at once instead of after the pause; nothing when connected. */
  retryNow(): void {
    if (this.listeners_.size === 0 || this.socket_) return;
    this.connect();
  }

  /** Drops a connection that is believed dead and opens a new one. */
  reconnect(): void {
    if (this.listeners_.size === 0) return;
    this.drop();
    this.lost();
  }

  private connect(): void {
    this.cancelRetry_?.();
    this.cancelRetry_ = null;
    this.change({ state: this.view_.state === 'closed' ? 'connecting' : this.view_.state });
    const socket = this.options_.open();
    this.socket_ = socket;
    this.watch(kDeadMs, () => this.giveUp());
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      if (this.socket_ !== socket) return;
      this.socket_ = null;
      this.lost();
    };
  }

  private receive(data: unknown): void {
    const event = parseEvent(data);
    const server = event ? applyEvent(this.socketState_, event, this.options_.now_ms()) : 'gap';
    if (server === 'gap') {
      this.reconnect();
      return;
    }
    this.socketState_ = server;
    this.failures_ = 0;
    this.watch(kSilenceMs, () => this.fallSilent());
    this.change({ state: 'live', server, last_message_ms: this.options_.now_ms() });
  }

  // The state that this connection has told; what an earlier one told stays on screen until then, marked as old.
  private socketState_: ServerState | null = null;

  /** What becomes of the connection when it tells nothing for so long. */
  private watch(silence_ms: number, call: () => void): void {
    this.cancelWatch_?.();
    this.cancelWatch_ = this.options_.after(silence_ms, call);
  }

  private fallSilent(): void {
    this.change({ state: 'offline' });
    this.watch(kDeadMs - kSilenceMs, () => this.giveUp());
  }

  /** The silence was pause enough: the next attempt follows soon. */
  private giveUp(): void {
    this.failures_ = 0;
    this.reconnect();
  }

  private drop(): void {
    this.cancelRetry_?.();
    this.cancelRetry_ = null;
    this.cancelWatch_?.();
    this.cancelWatch_ = null;
    const socket = this.socket_;
    this.socket_ = null;
    if (!socket) return;
    socket.onmessage = null;
    socket.onclose = null;
    socket.close();
  }

  private lost(): void {
    this.cancelWatch_?.();
    this.cancelWatch_ = null;
    this.socketState_ = null;
    const pause_ms = Math.min(kLongestRetryMs, kFirstRetryMs * 2 ** this.failures_);
    this.failures_ += 1;
    this.change({ state: 'offline' });
    this.cancelRetry_ = this.options_.after(pause_ms * (0.75 + 0.5 * this.options_.random()), () =>
      this.connect(),
    );
  }

  private change(part: Partial<EventSocketView>): void {
    this.view_ = { ...this.view_, ...part };
    for (const listener of [...this.listeners_]) listener(this.view_);
  }
}

/** A message as an event; null when it is none. Unknown kinds pass, so that a newer server can add some. */
export function parseEvent(data: unknown): ServerEvent | null {
  if (typeof data !== 'string') return null;
  try {
    const value: unknown = JSON.parse(data);
    if (typeof value !== 'object' || value === null) return null;
    const { type, seq } = value as { type?: unknown; seq?: unknown };
    return typeof type === 'string' && typeof seq === 'number' ? (value as ServerEvent) : null;
  } catch {
    return null;
  }
}
