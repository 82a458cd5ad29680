// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { asProblem } from '../../api/problem';
import type { LoggedEdit } from '../../api/types';
import { Choice } from '../../components/field';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { follow } from '../../lib/router';
import { count, dateText } from '../../lib/words';
import { changesOf, changeWords, lostBecause, redoable, undoable, type Change } from './changes';
import { kHistoryPart, type Editor } from './editor';
import { mapAddress, pathOf } from './map_address';
import { Outcome } from './outcome';
import { around, numbersOf, standing } from './states';

const kShown = 8;
const kChanges = { page: 'changes', place: null } as const;

/** What people changed, newest first, taking the newest back, and making again what was taken back. */
export function MapHistory({ editor }: { editor: Editor }) {
  const { graph, draft, busy, mayEdit } = editor;
  const outcome = editor.outcomeIn(kHistoryPart);
  const [loaded, setLoaded] = useState<readonly LoggedEdit[] | null>(null);
  const edits = draft ? draft.edits : loaded;
  const [problem, setProblem] = useState<string | null>(null);
  const [person, setPerson] = useState('');
  const [most, setMost] = useState(kShown);
  const of_draft = draft !== null;
  const title = of_draft ? 'Changes in this draft' : 'Changes by people';
  useEffect(() => {
    if (of_draft) return;
    let wanted = true;
    calls.history(graph.map).then(
      (answer) => {
        if (!wanted) return;
        setLoaded(answer.edits);
        setProblem(null);
      },
      (thrown: unknown) => {
        if (wanted) setProblem(asProblem(thrown).message);
      },
    );
    return () => {
      wanted = false;
    };
  }, [graph.map, graph.revision, of_draft]);
  const changes = changesOf(edits ?? []);
  const stand = standing(changes);
  const people = [...new Set(changes.map((one) => one.by))].sort();
  const wanted = people.includes(person) ? person : '';
  const shown = changes.filter((one) => wanted === '' || one.by === wanted);
  const back = undoable(changes);
  const forth = redoable(changes);
  const name = (what: string, change: Change | null) =>
    change ? `${what}: ${change.by} ${changeWords(change, graph)}` : what;
  return (
    <section class="card stack" aria-label={title}>
      <div class="row apart">
        <h2>{title}</h2>
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
      {edits?.length === 0 && (
        <p class="soft">{of_draft ? 'Nothing was changed yet.' : 'Nobody has changed this map yet.'}</p>
      )}
      {people.length > 1 && (
        <Choice
          label="Show the changes of"
          value={wanted}
          onChange={setPerson}
          options={[{ value: '', label: 'Everybody' }, ...people.map((one) => ({ value: one, label: one }))]}
        />
      )}
      <ul class="list">
        {shown
          .slice(-most)
          .reverse()
          .map((one) => (
            <li key={one.number}>
              <span>
                <strong>{one.by}</strong> {changeWords(one, graph)}
                {one.undone && <span class="soft"> (taken back)</span>}
              </span>
              <span class="row">
                <span class="soft small">{dateText(one.t_us)}</span>
                {!of_draft && !one.undone && (
                  <a
                    class="button small"
                    aria-label={`Before and after: ${one.by} ${changeWords(one, graph)}`}
                    href={pathOf({
                      ...mapAddress.value,
                      ...kChanges,
                      map: graph.map,
                      of: numbersOf(around(one, stand)),
                    })}
                    onClick={follow}
                  >
                    Before and after
                  </a>
                )}
              </span>
              {lostBecause(one).map((why) => (
                <Notice key={why} tone="warn" still>
                  {of_draft
                    ? 'This does not hold any more, as the map has changed.'
                    : 'The map could not keep this when it was last built.'}{' '}
                  {why}
                </Notice>
              ))}
            </li>
          ))}
      </ul>
      {shown.length > most && (
        <button type="button" class="button" onClick={() => setMost(most + 4 * kShown)}>
          Show more of {count(shown.length, 'change')}
        </button>
      )}
    </section>
  );
}
