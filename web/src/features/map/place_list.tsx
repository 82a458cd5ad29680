// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Belief, Graph } from '../../api/types';
import { TextField } from '../../components/field';
import { LongList } from '../../components/long_list';
import { indexOf } from '../../lib/graph_index';
import { count, percent } from '../../lib/words';
import { matching, placeViews, probabilities } from './place_views';

interface Props {
  graph: Graph;
  belief: Belief | null;
  chosen: string | null;
  onChoose: (place: string) => void;
}

const kRowPx = 60;
const kToldShare = 0.02;

/** Every place of the map, to be found by name and chosen. */
export function PlaceList({ graph, belief, chosen, onChoose }: Props) {
  const [text, setText] = useState('');
  const found = useMemo(() => matching(placeViews(graph), text), [graph, text]);
  const shares = probabilities(belief);
  const { places } = indexOf(graph);
  return (
    <section class="card stack" aria-label="Places">
      <div class="row apart">
        <h2>Places</h2>
        <span class="soft small" role="status">
          {count(found.length, 'place')}
        </span>
      </div>
      <TextField label="Find a place" value={text} onInput={setText} required={false} />
      <LongList
        key={text} // what is found begins at its top
        items={found}
        keyOf={(view) => view.id}
        row_px={kRowPx}
        row={(view) => {
          const share = shares.get(view.id) ?? 0;
          return (
            <button
              type="button"
              class="place-row"
              aria-pressed={view.id === chosen}
              onClick={() => onChoose(view.id)}
            >
              <img
                src={calls.imageThumbnailUrl(graph.map, places.get(view.id)?.prototype ?? '')}
                alt=""
                loading="lazy"
              />
              <span class={view.named ? 'place-title' : 'soft'}>{view.title}</span>
              {share > kToldShare && <span class="pill warn">Chair {percent(share)}</span>}
            </button>
          );
        }}
      />
    </section>
  );
}
