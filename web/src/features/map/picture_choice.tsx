// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { count } from '../../lib/words';
import { byTour, fileOf } from './tour_order';

const kShown = 24; // at first, and with each press

interface Props {
  map: string;
  legend: string;
  images: readonly string[];
  chosen: ReadonlySet<string>;
  several: boolean;
  onChoose: (chosen: ReadonlySet<string>) => void;
}

let groups = 0;

/** Pictures to choose one or several of, in the order of their tours. */
export function PictureChoice({ map, legend, images, chosen, several, onChoose }: Props) {
  const [most, setMost] = useState(kShown);
  const [name] = useState(() => `pictures-${(groups += 1)}`);
  const ordered = byTour(images).flatMap((one) => one.images);
  const press = (image: string) => {
    const next = new Set(several ? chosen : []);
    if (!next.delete(image)) next.add(image);
    onChoose(next);
  };
  return (
    <fieldset class="stack tight">
      <legend class="label">{legend}</legend>
      <ul class="choices">
        {ordered.slice(0, most).map((image) => (
          <li key={image}>
            <label class="choice">
              <img src={calls.imageThumbnailUrl(map, image)} alt="" loading="lazy" />
              <span class="check">
                <input
                  type={several ? 'checkbox' : 'radio'}
                  name={name}
                  checked={chosen.has(image)}
                  onChange={() => press(image)}
                />
                <span class="small">{fileOf(image)}</span>
              </span>
            </label>
          </li>
        ))}
      </ul>
      {ordered.length > most && (
        <button type="button" class="button small" onClick={() => setMost(most + kShown)}>
          Show more of {count(ordered.length, 'picture')}
        </button>
      )}
    </fieldset>
  );
}
