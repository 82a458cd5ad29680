// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { nameOf, placeTitle, withArticle } from '../../lib/whereabouts';
import type { Cell } from './matrix_view';
import { matching, placeViews } from './place_views';

/** Pictures of one tour that follow each other in the matrix. */
export interface TourRun {
  tour: string;
  start: number;
  end: number; // the first picture after it
}

export function tourRuns(images: readonly string[]): TourRun[] {
  const runs: TourRun[] = [];
  images.forEach((image, i) => {
    const tour = image.split('/')[0] ?? '';
    const last = runs.at(-1);
    if (last?.tour === tour) last.end = i + 1;
    else runs.push({ tour, start: i, end: i + 1 });
  });
  return runs;
}

/** What the page says of pictures by their numbers in the matrix. */
export interface Pictures {
  images: readonly string[];
  runs: readonly TourRun[];
  tourName: (tour: string) => string;
}

/** "Picture 12 of Ground floor". */
export function pictureTitle(picture: number, { runs, tourName }: Pictures): string {
  const run = runs.find((one) => picture < one.end);
  return run ? `Picture ${picture - run.start + 1} of ${tourName(run.tour)}` : `Picture ${picture + 1}`;
}

/** The place that a picture is of; null: the map has left it out. */
export function placeOf(picture: number, { images }: Pictures, graph: Graph): string | null {
  return indexOf(graph).place_of_image.get(images[picture] ?? '')?.id ?? null;
}

function spoken(picture: number, pictures: Pictures, graph: Graph): string {
  const place = placeOf(picture, pictures, graph);
  const title = pictureTitle(picture, pictures);
  if (place === null) return `${title}, at no place of the map`;
  const name = nameOf(graph, place);
  return `${title}, ${name === null ? lower(placeTitle(graph, place)) : withArticle(name)}`;
}

const lower = (text: string) => `${text.charAt(0).toLowerCase()}${text.slice(1)}`;

/** Both pictures of a cell in one sentence, with how the map has them. */
export function cellWords(cell: Cell, pictures: Pictures, graph: Graph): string {
  if (cell.column === cell.row) return `${spoken(cell.column, pictures, graph)}, with itself.`;
  const [a, b] = [cell.column, cell.row].map((one) => spoken(one, pictures, graph)) as [string, string];
  return `${a}, and ${lower(b)}. ${verdictWords(cell, pictures, graph)}`;
}

export type Verdict = 'same' | 'one' | 'open' | 'apart' | 'none';

const verdicts = new WeakMap<Graph, ReadonlyMap<string, Verdict>>();
const pairOf = (a: string, b: string) => (a < b ? `${a} ${b}` : `${b} ${a}`);

/** How the map has two places that it asked about, by their pair; found once for each graph. */
function verdictsOf(graph: Graph): ReadonlyMap<string, Verdict> {
  let found = verdicts.get(graph);
  if (!found) {
    const { place_of_image } = indexOf(graph);
    found = new Map(
      graph.hypotheses.flatMap(({ prototype_a, prototype_b, decision }): [string, Verdict][] => {
        const [a, b] = [place_of_image.get(prototype_a)?.id, place_of_image.get(prototype_b)?.id];
        if (a === undefined || b === undefined || a === b || decision === 'accepted') return [];
        return [[pairOf(a, b), decision === 'undecided' ? 'open' : 'apart']];
      }),
    );
    verdicts.set(graph, found);
  }
  return found;
}

/** What the lower half of the matrix shows at a cell. */
export function verdictOf({ column, row }: Cell, pictures: Pictures, graph: Graph): Verdict {
  if (column === row) return 'same';
  const [a, b] = [placeOf(column, pictures, graph), placeOf(row, pictures, graph)];
  if (a === null || b === null) return 'none';
  return a === b ? 'one' : (verdictsOf(graph).get(pairOf(a, b)) ?? 'none');
}

const kVerdicts: Readonly<Record<Verdict, string>> = {
  same: 'One and the same picture.',
  one: 'The map takes both for one place.',
  open: 'The map leaves open whether they are one place.',
  apart: 'The map has looked at them and keeps their places apart.',
  none: 'They are of different places; the map did not ask whether these are one.',
};

export function verdictWords(cell: Cell, pictures: Pictures, graph: Graph): string {
  return kVerdicts[verdictOf(cell, pictures, graph)];
}

/** The picture that somebody means by its number in the matrix, from 1, or by a place; null: there is no such one. */
export function meantPicture(text: string, { images }: Pictures, graph: Graph): number | null {
  const said = text.trim();
  if (/^\d+$/.test(said)) {
    const picture = Number(said) - 1;
    return picture >= 0 && picture < images.length ? picture : null;
  }
  if (said === '') return null;
  const titled = placeViews(graph).filter((one) => one.title.toLowerCase() === said.toLowerCase());
  for (const { id } of [...titled, ...matching(placeViews(graph), said)]) {
    const place = indexOf(graph).places.get(id);
    const own = [place?.prototype ?? '', ...(place?.members ?? [])].map((one) => images.indexOf(one));
    const found = own.find((one) => one >= 0);
    if (found !== undefined) return found;
  }
  return null;
}

/** The cell that an address names by the numbers of its pictures, from 1. */
export function cellOf(of: readonly number[], count: number): Cell | null {
  const [column = 0, row = 0] = of.map((one) => one - 1);
  const inside = (one: number) => one >= 0 && one < count;
  return of.length === 2 && inside(column) && inside(row) ? { column, row } : null;
}
