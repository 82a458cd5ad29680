// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Shortcut } from '../../api/types';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { kPlacePart, type Editor } from './editor';
import { Outcome } from './outcome';
import { evidenceOf, shortcutsAt, shortcutsToShow } from './shortcut_words';

const kShown = 12; // at first, and with each press

const kSaid: Readonly<Record<Shortcut['state'], string>> = {
  proposed: 'Proposed',
  accepted: 'Accepted',
  rejected: 'Rejected',
};

interface Props {
  editor: Editor;
  place: string | null; // of this one alone; null: of the whole map
}

/** Straight ways that no tour drove: two pictures, the evidence in words, and the decision. */
export function Shortcuts({ editor, place }: Props) {
  const { graph, mayEdit, busy } = editor;
  const part = place === null ? 'shortcuts' : kPlacePart;
  const outcome = place === null ? editor.outcomeIn(part) : null; // that of a place is said there
  const [most, setMost] = useState(kShown);
  const all = useMemo(
    () => (place === null ? shortcutsToShow(graph) : shortcutsAt(graph, place)),
    [graph, place],
  );
  if (all.length === 0) return null;
  const shown = all.slice(0, most);
  const title = place === null ? 'Shortcuts' : 'Shortcuts from here';
  const decide = (one: Shortcut, accept: boolean) =>
    editor.edit(
      part,
      [{ kind: 'decide_shortcut', image_a: one.image_a, image_b: one.image_b, accept }],
      accept ? 'The chair may take this shortcut now, slowly.' : 'This shortcut is not offered any more.',
    );
  return (
    <section class={place === null ? 'card stack' : 'stack'} aria-label={title}>
      {place === null ? <h2>{title}</h2> : <h3>{title}</h3>}
      <p class="soft">
        Straight ways that no tour drove. Accept one only if you know that the chair fits through there.
      </p>
      {outcome && <Outcome of={outcome} />}
      <ul class="pairs">
        {shown.map((one) => {
          const from = placeTitle(graph, one.place_a);
          const to = placeTitle(graph, one.place_b);
          return (
            <li key={`${one.image_a}|${one.image_b}`}>
              <div class="pair">
                {[one.image_a, one.image_b].map((image, i) => (
                  <img
                    key={image}
                    class="picture whole"
                    src={calls.imageThumbnailUrl(graph.map, image)}
                    alt={i === 0 ? from : to}
                    loading="lazy"
                  />
                ))}
              </div>
              <p class="small">
                <span class="pill">{kSaid[one.state]}</span>{' '}
                <strong>
                  {from} – {to}
                </strong>
              </p>
              <p class="soft small">{evidenceOf(one)}</p>
              {mayEdit && (
                <p class="row">
                  {one.state !== 'accepted' && (
                    <button
                      type="button"
                      class="button small"
                      disabled={busy}
                      aria-label={`Accept the shortcut from ${from} to ${to}`}
                      onClick={() => decide(one, true)}
                    >
                      Accept
                    </button>
                  )}
                  {one.state !== 'rejected' && (
                    <button
                      type="button"
                      class="button small"
                      disabled={busy}
                      aria-label={`Reject the shortcut from ${from} to ${to}`}
                      onClick={() => decide(one, false)}
                    >
                      Reject
                    </button>
                  )}
                </p>
              )}
            </li>
          );
        })}
      </ul>
      {all.length > most && (
        <button type="button" class="button" onClick={() => setMost(most + kShown)}>
          Show more of {count(all.length, 'shortcut')}
        </button>
      )}
    </section>
  );
}
