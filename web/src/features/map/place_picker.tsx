// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph } from '../../api/types';
import { TextField } from '../../components/field';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { nearestPlaces } from './nearest_places';
import { picking } from './picking';
import { matching, placeViews } from './place_views';

const kOffered = 8;

interface Props {
  graph: Graph;
  from: string; // whose neighbours are offered first; not itself one to choose
  legend: string;
  chosen: string | null;
  onChoose: (place: string) => void;
}

let groups = 0;

/** Another place to choose: one nearby, one found by its name, or one pressed in the drawing. */
export function PlacePicker({ graph, from, legend, chosen, onChoose }: Props) {
  const [text, setText] = useState('');
  const [name] = useState(() => `places-${(groups += 1)}`);
  const [own, setOwn] = useState<object | null>(null); // the picking that this one has begun
  const drawn = own !== null && picking.value === own;
  const near = useMemo(() => nearestPlaces(graph, from, kOffered), [graph, from]);
  const found =
    text.trim() === ''
      ? near
      : matching(placeViews(graph), text)
          .map((view) => view.id)
          .filter((id) => id !== from)
          .slice(0, kOffered);
  const shown = chosen === null || found.includes(chosen) ? found : [chosen, ...found];
  const stop = () => {
    if (picking.peek() === own) picking.value = null;
    setOwn(null);
  };
  const begin = () => {
    const pick = (place: string) => {
      picking.value = null;
      if (place !== from) onChoose(place);
    };
    const begun = { what: legend, pick };
    picking.value = begun;
    setOwn(begun);
  };
  useEffect(
    () => () => {
      if (own !== null && picking.peek() === own) picking.value = null;
    },
    [own],
  );
  return (
    <fieldset class="stack tight">
      <legend class="label">{legend}</legend>
      <TextField label="Find by name" value={text} onInput={setText} required={false} />
      <ul class="choices narrow">
        {shown.map((id) => (
          <li key={id}>
            <label class="choice beside">
              <input type="radio" name={name} checked={id === chosen} onChange={() => onChoose(id)} />
              <img
                src={calls.imageThumbnailUrl(graph.map, indexOf(graph).places.get(id)?.prototype ?? '')}
                alt=""
                loading="lazy"
              />
              <span>{placeTitle(graph, id)}</span>
            </label>
          </li>
        ))}
      </ul>
      {shown.length === 0 && <p class="soft">No other place is called so.</p>}
      <p>
        <button
          type="button"
          class="button small"
          aria-pressed={drawn}
          onClick={() => (drawn ? stop() : begin())}
        >
          {drawn ? 'Do not choose in the drawing' : 'Choose in the drawing'}
        </button>
      </p>
    </fieldset>
  );
}
