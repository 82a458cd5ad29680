// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { asProblem } from '../../api/problem';
import type { Graph, LoggedEdit } from '../../api/types';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { dateText } from '../../lib/words';

const kShown = 8;

const kVerbs: Readonly<Record<LoggedEdit['kind'], string>> = {
  rename: 'named a place',
  merge: 'joined two places',
  split: 'split a place',
  delete: 'removed a place',
  move: 'moved pictures',
  add_edge: 'added a way',
  remove_edge: 'removed a way',
  block_edge: 'closed or opened a way',
  decide: 'decided whether two places are one',
  decide_shortcut: 'accepted or rejected a shortcut',
};

interface Props {
  graph: Graph;
  busy: boolean;
  onUndo: (() => void) | null;
}

/** What people changed, newest first, and taking the newest back. */
export function MapHistory({ graph, busy, onUndo }: Props) {
  const [edits, setEdits] = useState<readonly LoggedEdit[] | null>(null);
  const [problem, setProblem] = useState<string | null>(null);
  useEffect(() => {
    let wanted = true;
    calls.history(graph.map).then(
      (answer) => {
        if (!wanted) return;
        setEdits(answer.edits);
        setProblem(null);
      },
      (thrown: unknown) => {
        if (wanted) setProblem(asProblem(thrown).message);
      },
    );
    return () => {
      wanted = false;
    };
  }, [graph.map, graph.revision]);
  const newest = edits?.slice(-kShown).reverse() ?? [];
  const undoable = newest.some((one) => !one.undone);
  return (
    <section class="card stack" aria-label="Changes by people">
      <div class="row apart">
        <h2>Changes by people</h2>
        {onUndo && (
          <button type="button" class="button" disabled={busy || !undoable} onClick={onUndo}>
            <Icon name="undo" /> Take the newest back
          </button>
        )}
      </div>
      {problem !== null && <Notice tone="warn">The changes could not be loaded. {problem}</Notice>}
      {edits?.length === 0 && <p class="soft">Nobody has changed this map yet.</p>}
      <ul class="list">
        {newest.map((one, i) => (
          <li key={`${one.t_us}-${i}`}>
            <span>
              <strong>{one.by}</strong> {kVerbs[one.kind]}
              {one.kind === 'rename' && one.text !== '' && <> “{one.text}”</>}
              {one.undone && <span class="soft"> (taken back)</span>}
            </span>
            <span class="soft small">{dateText(one.t_us)}</span>
          </li>
        ))}
      </ul>
    </section>
  );
}
