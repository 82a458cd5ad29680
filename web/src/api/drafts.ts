// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from '@preact/signals';
import * as calls from './calls';
import { asProblem, type ProblemError } from './problem';
import { connection } from './server';
import type { Draft } from './types';

/** By id; null: it is gone. */
export type HeardDrafts = Readonly<Record<string, Draft | null>>;

/** The drafts of a map as they were loaded: by which connection's beginning, and why they could not be. */
interface Loaded {
  drafts: readonly Draft[] | null;
  problem: ProblemError | null;
  since: number; // the snapshot that it was loaded after
}

const loaded = signal<Readonly<Record<string, Loaded>>>({});
const answered = signal<HeardDrafts>({}); // what this page's own requests told

/** A list brought up to date with what was heard since, whichever came first. */
export function withHeard(drafts: readonly Draft[], ...told: HeardDrafts[]): readonly Draft[] {
  const present = new Map(drafts.map((one) => [one.id, one]));
  for (const heard of told)
    for (const one of Object.values(heard)) {
      if (!one) continue;
      const known = present.get(one.id);
      if (!known || one.version >= known.version) present.set(one.id, one);
    }
  const gone = (id: string) => told.some((heard) => heard[id] === null);
  return [...present.values()]
    .filter((one) => !gone(one.id))
    .sort((a, b) => a.created_us - b.created_us || a.id.localeCompare(b.id));
}

const kNone: HeardDrafts = {};
const told = computed<HeardDrafts>(() => connection.value.server?.drafts ?? kNone);

// Made anew only when a draft is told of, not with every other event.
const everyones = computed(() => {
  const heard = told.value;
  return new Map(
    Object.entries(loaded.value).map(([map, { drafts, problem }]) => {
      const own = (all: HeardDrafts) =>
        Object.fromEntries(Object.entries(all).filter(([, one]) => one === null || one.map === map));
      return [map, { problem, drafts: drafts && withHeard(drafts, own(answered.value), own(heard)) }];
    }),
  );
});

/** The drafts of a map as they are now; null while nobody has told. */
export function draftsOf(map: string): { drafts: readonly Draft[] | null; problem: ProblemError | null } {
  return everyones.value.get(map) ?? { drafts: null, problem: null };
}

/** Loads them unless they were since the connection began: from then on it tells each change. */
export function wantDrafts(map: string): void {
  const since = connection.peek().server?.since ?? 0;
  const before = loaded.peek()[map];
  if (before?.since === since) return;
  const keep = (part: Partial<Loaded>) => {
    const present = loaded.peek()[map] ?? { drafts: null, problem: null, since };
    loaded.value = { ...loaded.peek(), [map]: { ...present, ...part } };
  };
  keep({ since });
  calls.drafts(map).then(
    (answer) => keep({ drafts: answer.drafts, problem: null }),
    (thrown: unknown) => keep({ problem: asProblem(thrown) }),
  );
}

export function learnDraft(draft: Draft): void {
  answered.value = { ...answered.peek(), [draft.id]: draft };
}

export function learnGone(draft: string): void {
  answered.value = { ...answered.peek(), [draft]: null };
}
