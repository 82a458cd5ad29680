// SPDX-License-Identifier: Apache-2.0
import type { Edit, Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle, titlesApart } from '../../lib/whereabouts';
import { count } from '../../lib/words';

/** What an edit would do, as a sentence. */
export function effectWords(edit: Edit, graph: Graph): string {
  const title = (place: string) => placeTitle(graph, place);
  const pair = (a: string, b: string) => titlesApart(graph, a, b).join(' and ');
  switch (edit.kind) {
    case 'rename':
      return edit.label === ''
        ? `${title(edit.place)} loses its name.`
        : `${title(edit.place)} is called “${edit.label}”.`;
    case 'merge':
      return `${pair(edit.place, edit.into)} become one place.`;
    case 'split':
      return edit.images.length === 1
        ? `1 picture leaves ${title(edit.place)} and becomes a place of its own.`
        : `${edit.images.length} pictures leave ${title(edit.place)} and become a place of their own.`;
    case 'delete':
      return `${title(edit.place)} is removed.`;
    case 'move':
      return `${count(edit.images.length, 'picture')} go to ${title(edit.into)}.`;
    case 'add_edge':
      return `There is a way between ${pair(edit.from, edit.to)}.`;
    case 'remove_edge':
      return `The way between ${pair(edit.from, edit.to)} is removed.`;
    case 'block_edge':
      return `The way from ${title(edit.from)} to ${title(edit.to)} is ${edit.blocked ? 'closed' : 'open'}.`;
    case 'decide':
      return decisionWords(edit.prototype_a, edit.prototype_b, edit.accept, graph);
    case 'decide_shortcut':
      return edit.accept ? 'The shortcut may be driven.' : 'The shortcut is not offered any more.';
    case 'set_aside':
      return 'The map stays as it is. This comes last from now on, and says that you were not sure.';
    case 'add_destination':
      return `Riders can be sent to ${edit.label}.`;
    case 'remove_destination':
      return 'A destination goes.';
    case 'name_destination':
      return `A destination is called ${edit.label}.`;
    case 'set_pictogram':
      return 'A destination has another sign.';
    case 'set_destination_picture':
      return 'The chair comes to stand elsewhere for a destination.';
  }
}

function decisionWords(image_a: string, image_b: string, accept: boolean, graph: Graph): string {
  const { place_of_image } = indexOf(graph);
  const [a, b] = [place_of_image.get(image_a)?.id, place_of_image.get(image_b)?.id];
  if (a === undefined || b === undefined)
    return accept
      ? 'The two pictures show one place from now on.'
      : 'The two pictures show two places from now on.';
  if (a === b)
    return accept
      ? `${placeTitle(graph, a)} stays one place.`
      : `${placeTitle(graph, a)} becomes two places.`;
  const pair = titlesApart(graph, a, b).join(' and ');
  return accept ? `${pair} become one place.` : `${pair} stay two places, also when the map is built again.`;
}

/** What several would do; none does nothing. */
export function effectsWords(edits: readonly Edit[], graph: Graph): string {
  const each = [...new Set(edits.map((edit) => effectWords(edit, graph)))];
  return each.length === 0 ? 'The map stays as it is.' : each.join(' ');
}
