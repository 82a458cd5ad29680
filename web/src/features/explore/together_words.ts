// SPDX-License-Identifier: Apache-2.0
import type { Exploration, Robot } from '../../api/types';
import { count } from '../../lib/words';
import type { Tone } from './phase_words';

/** A robot of the house with its exploration; null: none is known. */
export interface Party {
  robot: Robot;
  exploration: Exploration | null;
}

/** With whom a robot maps the building, and how far the two are. */
export type Bond =
  | { kind: 'none' }
  | { kind: 'silent'; other: Party | null } // what it shares with is not heard of
  | { kind: 'one_sided'; other: Party } // which does not share with it
  | { kind: 'looking'; other: Party } // how the floors lie to each other is not known yet
  | { kind: 'joined'; other: Party };

const companionOf = ({ exploration }: Party) => exploration?.companion?.exploration ?? null;

/** Whether its exploration can be shared: it is there, and not over. */
export function goesOn({ robot, exploration }: Party): boolean {
  return robot.online && exploration !== null && !['ended', 'uploaded'].includes(exploration.phase);
}

/** Whether it shares with none, so that it can be told without parting it from another. */
export const isFree = (party: Party) => companionOf(party) === null;

export function bondOf(exploration: Exploration, others: readonly Party[]): Bond {
  const { companion } = exploration;
  if (!companion) return { kind: 'none' };
  const other = others.find((one) => one.exploration?.id === companion.exploration) ?? null;
  if (!other || !goesOn(other)) return { kind: 'silent', other };
  if (companionOf(other) !== exploration.id) return { kind: 'one_sided', other };
  return { kind: companion.joined ? 'joined' : 'looking', other };
}

interface BondWords {
  pill: string;
  tone: Tone;
  says: string;
}

/** What there is to say of it; null where it shares with none. */
export function bondWords(bond: Bond, name: string, exploration: Exploration): BondWords | null {
  if (bond.kind === 'none') return null;
  const who = bond.other?.robot.name ?? 'the other robot';
  const pictures = count(exploration.companion?.pictures ?? 0, 'picture');
  switch (bond.kind) {
    case 'silent':
      return bond.other?.robot.online
        ? { pill: 'Over', tone: 'warn', says: `${who} is done. ${name} goes on by itself.` }
        : {
            pill: 'Not heard of',
            tone: 'warn',
            says: bond.other
              ? `Nothing is heard of ${who}. Until it is, ${name} goes on by itself.`
              : `Nothing is heard of the other robot. It is gone, or has begun another exploration: choose it anew. ${name} goes on by itself.`,
          };
    case 'one_sided':
      return {
        pill: 'Half done',
        tone: 'warn',
        says: `${name} shares with ${who}, but ${who} not with ${name}. Until both do, each goes on by itself.`,
      };
    case 'looking':
      return {
        pill: 'Not joined yet',
        tone: 'warn',
        says: `${name} has ${pictures} of ${who} and looks for a place that both have seen. Until it has found one, it goes on by itself.`,
      };
    case 'joined': {
      const drives = bond.other.exploration?.phase === 'exploring';
      const leaves = drives
        ? `leaves to ${who} what that one sees to`
        : `sees to all that ${who}, which stands, has not covered`;
      return {
        pill: 'Joined',
        tone: 'good',
        says: `${name} knows how the floor of ${who} lies in its own. It has ${pictures} of it, and ${leaves}.`,
      };
    }
  }
}

/** Of a robot with which it could map the building: how far that one is. */
export function offerWords(offer: Party, own: Exploration): string {
  const { phase = null, pictures = 0 } = offer.exploration ?? {};
  const says = [phase === 'paused' ? 'Paused' : 'Maps the building', count(pictures, 'picture')];
  if (companionOf(offer) === own.id) says.push('shares with this one already');
  else if (companionOf(offer) !== null) says.push('shares with another one');
  return `${says.join(', ')}.`;
}

/** What was told to a robot, and what it said before. */
export interface Told {
  robot: string;
  exploration: string;
  from: string | null;
  to: string | null;
}

export function told(party: Party, to: string | null): Told {
  return { robot: party.robot.id, exploration: party.exploration?.id ?? '', from: companionOf(party), to };
}

/** The name of the first one that has not said yet that it knows; null when all have. */
export function unheard(all: readonly Told[], parties: readonly Party[]): string | null {
  const waited = all.flatMap(({ robot, exploration, from, to }) =>
    parties.filter(
      (one) =>
        one.robot.id === robot &&
        one.exploration?.id === exploration &&
        companionOf(one) === from &&
        from !== to,
    ),
  );
  return waited[0]?.robot.name ?? null;
}
