// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { EventSocket, parseEvent, type EventSocketView, type SocketLike } from './event_socket';

class FakeSocket implements SocketLike {
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: ((event: { code: number }) => void) | null = null;
  closed = false;
  close(): void {
    this.closed = true;
  }
  say(message: object): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
}

function bench() {
  const sockets: FakeSocket[] = [];
  const timers: { at_ms: number; delay_ms: number; call: () => void }[] = [];
  const views: EventSocketView[] = [];
  let now_ms = 5000;
  const events = new EventSocket({
    open: () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    now_ms: () => now_ms,
    after: (delay_ms, call) => {
      const timer = { at_ms: now_ms + delay_ms, delay_ms, call };
      timers.push(timer);
      return () => {
        if (timers.includes(timer)) timers.splice(timers.indexOf(timer), 1);
      };
    },
    random: () => 0.5,
  });
  const snapshot = (seq: number) => ({
    type: 'snapshot',
    v: 1,
    seq,
    build: 'b',
    robots: [],
    jobs: [],
    maps: [],
  });
  /** Lets time pass, and what is due happen at its time. */
  const pass = (time_ms: number) => {
    const end_ms = now_ms + time_ms;
    for (;;) {
      const [next] = timers.filter((one) => one.at_ms <= end_ms).sort((a, b) => a.at_ms - b.at_ms);
      if (!next) break;
      timers.splice(timers.indexOf(next), 1);
      now_ms = next.at_ms;
      next.call();
    }
    now_ms = end_ms;
  };
  return {
    sockets,
    timers,
    pass,
    views,
    events,
    snapshot,
    listen: (view: EventSocketView) => void views.push(view),
  };
}

describe('EventSocket', () => {
  it('opens one connection for many subscribers and closes it with the last', () => {
    const { events, sockets, listen } = bench();
    const first = events.subscribe(listen);
    const second = events.subscribe(() => undefined);
    expect(sockets).toHaveLength(1);
    first();
    first();
    expect(sockets[0]?.closed).toBe(false);
    second();
    expect(sockets[0]?.closed).toBe(true);
  });

  it('is live after the snapshot', () => {
    const { events, sockets, views, listen, snapshot } = bench();
    events.subscribe(listen);
    expect(views.at(-1)?.state).toBe('connecting');
    sockets[0]?.say(snapshot(1));
    expect(views.at(-1)).toMatchObject({ state: 'live', last_message_ms: 5000 });
  });

  it('asks for a snapshot when there was none, and keeps the old state on screen as offline meanwhile', () => {
    const { events, sockets, pass, views, listen, snapshot } = bench();
    events.subscribe(listen);
    sockets[0]?.say(snapshot(1));
    sockets[0]?.onclose?.({ code: 1006 });
    expect(views.at(-1)).toMatchObject({ state: 'offline', server: { seq: 1 } });
    pass(400);
    expect(sockets).toHaveLength(2);
    sockets[1]?.say({ type: 'map', v: 1, seq: 2, map: { id: 'm' } }); // a change without its snapshot
    expect(sockets[1]?.closed).toBe(true);
    pass(800);
    sockets[2]?.say(snapshot(9));
    expect(views.at(-1)).toMatchObject({ state: 'live', server: { seq: 9 } });
  });

  it('waits longer after each failure, up to a bound, and starts small again once live', () => {
    const { events, sockets, timers, listen, snapshot } = bench();
    events.subscribe(listen);
    const waits: number[] = [];
    for (let i = 0; i < 8; ++i) {
      sockets.at(-1)?.onclose?.({ code: 1006 });
      const timer = timers.shift();
      waits.push(timer?.delay_ms ?? -1);
      timer?.call();
    }
    expect(waits.slice(0, 3)).toEqual([400, 800, 1600]);
    expect(waits.at(-1)).toBe(8000);
    sockets.at(-1)?.say(snapshot(1));
    sockets.at(-1)?.onclose?.({ code: 1006 });
    expect(timers.at(-1)?.delay_ms).toBe(400);
  });

  it('does not reconnect when nobody listens any more', () => {
    const { events, sockets, timers, listen } = bench();
    const stop = events.subscribe(listen);
    sockets[0]?.onclose?.({ code: 1006 });
    stop();
    expect(timers).toHaveLength(0);
  });

  it('says within 3 s that a connection has fallen silent, and shows meanwhile what it knew', () => {
    const { events, sockets, pass, views, listen, snapshot } = bench();
    events.subscribe(listen);
    sockets[0]?.say(snapshot(1));
    for (let seq = 2; seq < 6; ++seq) {
      pass(1000);
      sockets[0]?.say({ type: 'heartbeat', v: 1, seq });
    }
    expect(views.every((view) => view.state !== 'offline')).toBe(true);
    pass(2400);
    expect(views.at(-1)?.state).toBe('live');
    pass(500);
    expect(views.at(-1)).toMatchObject({ state: 'offline', last_message_ms: 9000, server: { seq: 5 } });
    sockets[0]?.say({ type: 'heartbeat', v: 1, seq: 6 }); // it was only late
    expect(views.at(-1)).toMatchObject({ state: 'live', server: { seq: 6 } });
    expect(sockets).toHaveLength(1);
  });

  it('gives a silent connection up for a new one, and each new one that nobody answers', () => {
    const { events, sockets, pass, views, listen, snapshot } = bench();
    events.subscribe(listen);
    sockets[0]?.say(snapshot(1));
    pass(6500);
    expect(sockets.map((one) => one.closed)).toEqual([true, false]);
    pass(6500);
    pass(6500);
    expect(sockets.map((one) => one.closed)).toEqual([true, true, true, false]);
    expect(views.at(-1)?.state).toBe('offline');
    sockets[3]?.say(snapshot(1));
    expect(views.at(-1)?.state).toBe('live');
    expect(sockets).toHaveLength(4);
  });
});

describe('parseEvent', () => {
  it('refuses what is no event', () => {
    expect(parseEvent('{')).toBeNull();
    expect(parseEvent('null')).toBeNull();
    expect(parseEvent('{"type":"robot"}')).toBeNull();
    expect(parseEvent(new ArrayBuffer(2))).toBeNull();
    expect(parseEvent('{"type":"news","seq":4}')).toMatchObject({ type: 'news' });
  });
});
