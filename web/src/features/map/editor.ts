// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { learnDraft } from '../../api/drafts';
import { asProblem } from '../../api/problem';
import { wantGraph } from '../../api/server';
import type { Draft, Edit, Graph, MapInfo } from '../../api/types';
import { useCommand } from '../../lib/command';
import { concernedPictures } from './concerned';
import type { OutcomeOf } from './outcome';

/** What is done once a change was made. */
export interface After {
  choose?: string | null; // the place to show then, where the old one may be gone
  told_in?: string; // the part in which it is said then; without it, beside the place to show
  then?: () => void;
}

/** What the parts of the map page need to change the map, or the draft that is open. */
export interface Editor {
  map: MapInfo;
  graph: Graph; // as it is with the draft
  draft: Draft | null;
  mayEdit: boolean;
  busy: boolean;
  /** Asks for edits as one change; what becomes of it is said in `part` of the page, or beside the place to show then. */
  edit: (part: string, edits: Edit[], said: string, after?: After) => void;
  undo: () => void;
  redo: () => void;
  outcomeIn: (part: string) => OutcomeOf | null;
  forget: () => void;
}

interface Latest {
  part: string;
  done: string | null;
  edits: readonly Edit[];
}

/** The part in which the place itself is shown. */
export const kPlacePart = 'place';
export const kHistoryPart = 'history';

export function useEditor(
  map: MapInfo,
  graph: Graph,
  draft: Draft | null,
  mayEdit: boolean,
  onChoose: (place: string | null) => void,
): Editor {
  const command = useCommand();
  const [latest, setLatest] = useState<Latest | null>(null);

  const change = (
    part: string,
    edits: readonly Edit[],
    ask: () => Promise<unknown>,
    said: string,
    after?: After,
  ) => {
    setLatest({ part, done: null, edits });
    command.run(async () => {
      try {
        await ask();
      } catch (thrown) {
        if (asProblem(thrown).code === 'stale_revision') await loadAgain(map, draft);
        throw thrown;
      }
      const told_in = after?.told_in ?? (after?.choose === undefined ? part : kPlacePart);
      setLatest({ part: told_in, done: said, edits });
      if (after?.choose !== undefined) onChoose(after.choose);
      after?.then?.();
      if (!draft) wantGraph(map, true);
    });
  };
  const asked = (onMap: () => Promise<unknown>, onDraft: (draft: Draft) => Promise<Draft>) => () =>
    draft ? onDraft(draft).then(learnDraft) : onMap();
  return {
    map,
    graph,
    draft,
    mayEdit,
    busy: command.busy,
    edit: (part, edits, said, after) => {
      const ask = asked(
        () => calls.edit(map.id, graph.revision, edits),
        (one) => calls.editDraft(one, edits),
      );
      change(part, edits, ask, said, after);
    },
    undo: () => {
      const ask = asked(() => calls.undo(map.id, graph.revision), calls.undoInDraft);
      change(kHistoryPart, [], ask, 'The newest change was taken back.');
    },
    redo: () => {
      const ask = asked(() => calls.redo(map.id, graph.revision), calls.redoInDraft);
      change(kHistoryPart, [], ask, 'The change was made again.');
    },
    outcomeIn: (part) => {
      if (latest?.part !== part || command.busy) return null;
      const { problem } = command;
      const pictures = problem ? concernedPictures(problem, latest.edits, graph) : [];
      return { done: latest.done, problem, map: map.id, pictures };
    },
    forget: () => {
      setLatest(null);
      command.forget();
    },
  };
}

/** What somebody else has changed meanwhile. */
async function loadAgain(map: MapInfo, draft: Draft | null): Promise<void> {
  if (draft) learnDraft(await calls.draft(draft));
  else wantGraph(map, true);
}
