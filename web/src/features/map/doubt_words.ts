// SPDX-License-Identifier: Apache-2.0
import type { Doubt, Edit, LoggedEdit, Masses } from '../../api/types';
import { percent } from '../../lib/words';

export const kDoubtKinds: Readonly<Record<Doubt['kind'], string>> = {
  same_place: 'Two places that may be one',
  mixed_place: 'One place that may be two',
  way: 'A way that may not exist',
};

interface Question {
  text: string;
  yes: string;
  no: string;
}

const kQuestions: Readonly<Record<Doubt['kind'], Question>> = {
  same_place: { text: 'Are these one and the same place?', yes: 'Yes, one place', no: 'No, two places' },
  mixed_place: { text: 'Do both pictures show one place?', yes: 'Yes, one place', no: 'No, two places' },
  way: { text: 'Can the chair drive straight between these?', yes: 'Yes, there is a way', no: 'No' },
};

export function questionOf({ kind }: Pick<Doubt, 'kind'>): Question {
  return kQuestions[kind];
}

/** How the map stands and what speaks for that, so that the words agree with what it does. */
export function standWords(doubt: Doubt): string {
  const { kind, state, by, support, plausibility } = doubt;
  if (kind === 'way') {
    if (by === 'person')
      return state === 'rejected' ? 'Somebody has removed this way.' : 'Somebody has put this way there.';
    return state === 'rejected'
      ? 'The map has no way here.'
      : 'The map has a way here, from what was seen on a tour.';
  }
  if (by === 'person' && state !== 'undecided')
    return state === 'accepted'
      ? 'Somebody has decided that they are one place.'
      : 'Somebody has decided that they are two places.';
  if (state === 'accepted')
    return support === null
      ? 'The map takes them for one place.'
      : `The map takes them for one place: what was seen makes it at least ${percent(support)} sure.`;
  if (state === 'rejected')
    return plausibility === null
      ? 'The map keeps them apart.'
      : `The map keeps them apart: that they are one place is at most ${percent(plausibility)} likely.`;
  if (support === null || plausibility === null)
    return 'The map leaves it open, and keeps them apart until somebody decides.';
  return (
    `The map leaves it open, and keeps them apart until somebody decides: ` +
    `it is between ${percent(support)} and ${percent(plausibility)} sure that they are one place.`
  );
}

/** How much a look at it is worth. */
export function worthWords({ probability, effect }: Doubt): string {
  const much = effect >= 0.5 ? 'Much' : effect >= 0.2 ? 'Something' : 'Little';
  return `The map is wrong here with a chance of ${percent(probability)}. ${much} of it depends on that.`;
}

/** That somebody looked and left it open; null where nobody did. */
export function setAsideWords({ set_aside_by: by }: Pick<Doubt, 'set_aside_by'>): string | null {
  return by === null ? null : `${by} was not sure.`;
}

/** When every one of these was looked at. */
export function allSeenWords(doubts: readonly Doubt[]): string {
  const open = doubts.filter((one) => one.set_aside_by !== null).length;
  if (open === 0) return 'You have looked at all of these.';
  const left = `${open} of them ${open === 1 ? 'was' : 'were'} left open`;
  return `All of these were looked at. ${left}: somebody who knows the house well may be sure.`;
}

/** What "not sure" asks for. */
export function setAside({ kind: about, image_a, image_b }: Doubt): Edit {
  return { kind: 'set_aside', about, image_a, image_b };
}

/** Whether one of these edits, of a draft, answers a doubt or leaves it open. */
export function answeredBy(edits: readonly LoggedEdit[], { kind: about, image_a, image_b }: Doubt): boolean {
  return edits.some(
    ({ kind, undone, text, ...one }) =>
      !undone &&
      one.image_a === image_a &&
      one.image_b === image_b &&
      (kind === 'decide' || (kind === 'set_aside' && text === about)),
  );
}

export function massWords({ true: yes, false: no, unknown }: Masses): string {
  return `for one place ${percent(yes)}, not known ${percent(unknown)}, against it ${percent(no)}`;
}

export function keyOf({ kind, image_a, image_b }: Doubt): string {
  return `${kind} ${image_a} ${image_b}`;
}
