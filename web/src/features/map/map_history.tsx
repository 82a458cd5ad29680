// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { asProblem } from '../../api/problem';
import type { LoggedEdit } from '../../api/types';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { dateText } from '../../lib/words';
import { changesOf, changeWords, lostBecause, redoable, undoable, type Change } from './changes';
import { kHistoryPart, type Editor } from './editor';
import { Outcome } from './outcome';

const kShown = 8;

/** What people changed, newest first, taking the newest back, and making again what was taken back. */
export function MapHistory({ editor }: { editor: Editor }) {
  const { graph, busy, mayEdit } = editor;
  const outcome = editor.outcomeIn(kHistoryPart);
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
  const changes = changesOf(edits ?? []);
  const back = undoable(changes);
  const forth = redoable(changes);
  const name = (what: string, change: Change | null) =>
    change ? `${what}: ${change.by} ${changeWords(change, graph)}` : what;
  return (
    <section class="card stack" aria-label="Changes by people">
      <div class="row apart">
        <h2>Changes by people</h2>
        {mayEdit && (
          <div class="row">
            <button
              type="button"
              class="button"
              disabled={busy || !back}
              aria-label={name('Take the newest back', back)}
              onClick={editor.undo}
            >
              <Icon name="undo" /> Take the newest back
            </button>
            <button
              type="button"
              class="button"
              disabled={busy || !forth}
              aria-label={name('Make it again', forth)}
              onClick={editor.redo}
            >
              <Icon name="redo" /> Make it again
            </button>
          </div>
        )}
      </div>
      {outcome && <Outcome of={outcome} />}
      {problem !== null && <Notice tone="warn">The changes could not be loaded. {problem}</Notice>}
      {edits?.length === 0 && <p class="soft">Nobody has changed this map yet.</p>}
      <ul class="list">
        {changes
          .slice(-kShown)
          .reverse()
          .map((one) => (
            <li key={one.number}>
              <span>
                <strong>{one.by}</strong> {changeWords(one, graph)}
                {one.undone && <span class="soft"> (taken back)</span>}
              </span>
              <span class="soft small">{dateText(one.t_us)}</span>
              {lostBecause(one).map((why) => (
                <Notice key={why} tone="warn" still>
                  The map could not keep this when it was last built. {why}
                </Notice>
              ))}
            </li>
          ))}
      </ul>
    </section>
  );
}
