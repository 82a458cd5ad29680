// SPDX-License-Identifier: Apache-2.0
import type { ProblemError } from '../../api/problem';
import type { Edit, Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';

const kMost = 6;

/**
 * The pictures that a refused change is about, so that a person sees what the words mean: those that the words name, else
 * those of the places that they name, else those of the edit itself.
 */
export function concernedPictures(problem: ProblemError, edits: readonly Edit[], graph: Graph): string[] {
  const { places, place_of_image } = indexOf(graph);
  const named = problem.message.match(/[^\s'",()]+/g)?.map((word) => word.replace(/[.:;]+$/, '')) ?? [];
  const told = named.filter((word) => place_of_image.has(word));
  const of_places = named.flatMap((word) => places.get(word)?.prototype ?? []);
  const number = /^body\/edits\/(\d+)/.exec(problem.where ?? '')?.[1];
  const edit = number === undefined ? undefined : edits[Number(number)];
  const found = [told, of_places, edit ? picturesOf(edit, graph) : []].find((some) => some.length > 0) ?? [];
  return [...new Set(found)].slice(0, kMost);
}

/** The pictures that an edit names, and those of the places that it names. */
export function picturesOf(edit: Edit, graph: Graph): string[] {
  const { places } = indexOf(graph);
  const prototype = (place: string) => places.get(place)?.prototype ?? [];
  const dock = (id: string) => graph.destinations.find((one) => one.id === id)?.image ?? [];
  switch (edit.kind) {
    case 'rename':
    case 'delete':
      return [prototype(edit.place)].flat();
    case 'merge':
      return [prototype(edit.place), prototype(edit.into)].flat();
    case 'split':
    case 'move':
      return edit.images;
    case 'add_edge':
    case 'remove_edge':
    case 'block_edge':
      return [prototype(edit.from), prototype(edit.to)].flat();
    case 'decide':
      return [edit.prototype_a, edit.prototype_b];
    case 'decide_shortcut':
    case 'set_aside':
      return [edit.image_a, edit.image_b];
    case 'add_destination':
    case 'set_destination_picture':
      return [edit.image];
    default:
      return [dock(edit.destination)].flat();
  }
}
