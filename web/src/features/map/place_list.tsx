// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Belief, Graph } from '../../api/types';
import { TextField } from '../../components/field';
import { count, percent } from '../../lib/words';
import { matching, placeViews } from './place_views';

interface Props {
  graph: Graph;
  belief: Belief | null;
  chosen: string | null;
  onChoose: (place: string) => void;
}

/** Every place of the map, to be found by name and chosen. */
export function PlaceList({ graph, belief, chosen, onChoose }: Props) {
  const [text, setText] = useState('');
  const found = matching(placeViews(graph, belief), text);
  return (
    <section class="card stack" aria-label="Places">
      <div class="row apart">
        <h2>Places</h2>
        <span class="soft small" role="status">
          {count(found.length, 'place')}
        </span>
      </div>
      <TextField label="Find a place" value={text} onInput={setText} required={false} />
      <ul class="place-list" tabIndex={-1}>
        {found.map((view) => (
          <li key={view.id}>
            <button
              type="button"
              class="place-row"
              aria-pressed={view.id === chosen}
              onClick={() => onChoose(view.id)}
            >
              <img src={calls.placeThumbnailUrl(graph.map, view.id, graph.revision)} alt="" loading="lazy" />
              <span class={view.named ? 'place-title' : 'soft'}>{view.title}</span>
              {view.probability > 0.02 && <span class="pill warn">Chair {percent(view.probability)}</span>}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
