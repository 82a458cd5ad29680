// SPDX-License-Identifier: Apache-2.0
import type { Difference, Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { count, titled } from '../../lib/words';

export type Tone = 'added' | 'removed' | 'changed';

/** One thing that is other with a draft. */
export interface DifferenceLine {
  tone: Tone;
  words: string;
  place: string | null; // to look at; null: it is gone
}

/** A sign for each that does not need its colour. */
export const kToneSigns: Readonly<Record<Tone, { sign: string; word: string; pill: string }>> = {
  added: { sign: '+', word: 'New', pill: 'good' },
  removed: { sign: '−', word: 'Gone', pill: 'bad' },
  changed: { sign: '≠', word: 'Changed', pill: 'warn' },
};

/** The title of a place that is in either state of a map, in the later one first. */
export function titleIn(after: Graph, before: Graph): (place: string) => string {
  return (place) => placeTitle(indexOf(after).places.has(place) ? after : before, place);
}

/** All that is other, in sentences; both directions of a way that share a change are one. */
export function differenceLines(difference: Difference, before: Graph, after: Graph): DifferenceLine[] {
  const title = titleIn(after, before);
  const there = (place: string) => (indexOf(after).places.has(place) ? place : null);
  return [
    ...partsLine(difference),
    ...difference.places.flatMap((one) => placeLines(one, title)),
    ...wayLines(difference.edges, title, there),
    ...difference.destinations.flatMap(destinationLines),
    ...difference.hypotheses.map((one) => decisionLine(one, before, after)),
  ];
}

function partsLine({ parts_before, parts_after }: Difference): DifferenceLine[] {
  if (parts_after === parts_before) return [];
  if (parts_after === 1)
    return [{ tone: 'added', words: 'Every place can be driven to from every other now.', place: null }];
  const words = `The map falls into ${parts_after} parts that the chair cannot drive between; it was ${parts_before}.`;
  return [{ tone: parts_after > parts_before ? 'removed' : 'changed', words, place: null }];
}

function placeLines(one: Difference['places'][number], title: (place: string) => string): DifferenceLine[] {
  const { id, change, before, after, gained, left } = one;
  const own = title(id);
  if (change === 'added') {
    const words = `${own} is a new place, with ${count(after?.images ?? 0, 'picture')}.`;
    return [{ tone: 'added', words, place: id }];
  }
  if (change === 'removed') return [{ tone: 'removed', words: `${own} is no place any more.`, place: null }];
  const renamed =
    before && after && before.label !== after.label
      ? [
          after.label === ''
            ? `“${before.label}” has no name any more.`
            : before.label === ''
              ? `A place is called “${after.label}” now.`
              : `“${before.label}” is called “${after.label}” now.`,
        ]
      : [];
  const moved = [
    ...(gained.length > 0 ? [`${own} gained ${count(gained.length, 'picture')}.`] : []),
    ...(left.length > 0 ? [`${count(left.length, 'picture')} left ${own}.`] : []),
  ];
  const words = [...renamed, ...moved];
  if (words.length === 0) words.push(`${own} is shown by another picture.`);
  return words.map((said) => ({ tone: 'changed', words: said, place: id }));
}

type EdgeChange = Difference['edges'][number];

function whatOf({ change, before, after }: EdgeChange): string[] {
  if (change === 'added') return ['is new'];
  if (change === 'removed') return ['is no way any more'];
  if (!before || !after) return [];
  const parts = [
    ...(before.blocked !== after.blocked ? [after.blocked ? 'is closed' : 'is open again'] : []),
    ...(before.weak !== after.weak ? [after.weak ? 'is hard to drive now' : 'is easier to drive now'] : []),
    ...(before.shortcut !== after.shortcut
      ? [after.shortcut ? 'is a shortcut now' : 'is no shortcut any more']
      : []),
  ];
  return parts.length > 0 ? parts : ['leads another way'];
}

function wayLines(
  edges: readonly EdgeChange[],
  title: (place: string) => string,
  there: (place: string) => string | null,
): DifferenceLine[] {
  const lines = new Map<string, DifferenceLine>();
  for (const edge of edges)
    for (const what of whatOf(edge)) {
      const { from, to, change: tone } = edge;
      const key = (a: string, b: string) => `${a} ${b} ${what}`;
      const place = there(from) ?? there(to);
      if (lines.delete(key(to, from)))
        lines.set(key(from, to), {
          tone,
          place,
          words: `The way between ${title(to)} and ${title(from)} ${what}.`,
        });
      else
        lines.set(key(from, to), {
          tone,
          place,
          words: `The way from ${title(from)} to ${title(to)} ${what}.`,
        });
    }
  return [...lines.values()];
}

function destinationLines({ change, before, after }: Difference['destinations'][number]): DifferenceLine[] {
  const name = titled(after?.label ?? before?.label ?? '');
  if (change === 'added')
    return [{ tone: 'added', words: `Riders can be sent to ${name}.`, place: after?.place ?? null }];
  if (change === 'removed')
    return [{ tone: 'removed', words: `Riders cannot be sent to ${name} any more.`, place: null }];
  if (!before || !after) return [];
  const words = [
    ...(before.label !== after.label
      ? [`The destination ${titled(before.label)} is called ${name} now.`]
      : []),
    ...(before.pictogram !== after.pictogram ? [`The card of ${name} has another sign.`] : []),
    ...(before.image !== after.image ? [`The chair comes to stand at another picture for ${name}.`] : []),
  ];
  if (words.length === 0) words.push(`${name} is at another place of the map.`);
  return words.map((said) => ({ tone: 'changed', words: said, place: after.place }));
}

function decisionLine(
  { prototype_a, prototype_b, after: decision }: Difference['hypotheses'][number],
  before: Graph,
  after: Graph,
): DifferenceLine {
  const of = (image: string) => indexOf(before).place_of_image.get(image)?.id ?? null;
  const name = (image: string) => {
    const place = of(image);
    return place === null ? 'a place' : placeTitle(before, place);
  };
  const verdict =
    decision === 'accepted' ? 'are one place' : decision === 'rejected' ? 'are two places' : 'is left open';
  const pair = `${name(prototype_a)} and ${name(prototype_b)}`;
  const words =
    decision === 'undecided' ? `Whether ${pair} are one ${verdict}.` : `It is decided: ${pair} ${verdict}.`;
  const place = of(prototype_a);
  return { tone: 'changed', words, place: place !== null && indexOf(after).places.has(place) ? place : null };
}
