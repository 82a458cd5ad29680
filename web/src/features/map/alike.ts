// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { percent } from '../../lib/words';
import type { Cell } from './matrix_view';

/** How alike the pictures of a cell are, which the matrix says by its colour alone. */
export function alikeWords(similarity: number): string {
  return `They are ${percent(similarity)} alike.`;
}

/** The same once a cell has been the chosen one for `settled_ms`; null until it is known, and where it cannot be. */
export function useAlike(
  map: string,
  images: readonly string[],
  cell: Cell | null,
  settled_ms: number,
): string | null {
  const [found, setFound] = useState<{ cell: Cell; words: string } | null>(null);
  useEffect(() => {
    const [a, b] = cell ? [images[cell.column], images[cell.row]] : [];
    if (!cell || a === undefined || b === undefined || a === b) return;
    let wanted = true;
    const timer = setTimeout(() => {
      calls.pair(map, a, b).then(
        ({ similarity }) => wanted && setFound({ cell, words: alikeWords(similarity) }),
        () => undefined, // a picture at no place of the map may not be there to compare
      );
    }, settled_ms);
    return () => {
      wanted = false;
      clearTimeout(timer);
    };
  }, [map, images, cell, settled_ms]);
  return found && found.cell === cell ? found.words : null;
}
