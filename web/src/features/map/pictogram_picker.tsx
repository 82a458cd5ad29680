// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Destination } from '../../api/types';
import { Pictogram } from '../../components/pictogram';
import { kPictograms, pictogramWords, suggestedBy } from '../../lib/pictograms';

interface Props {
  label: string; // of the destination
  value: Destination['pictogram'];
  disabled: boolean;
  onChoose: (name: Destination['pictogram']) => void;
}

let groups = 0;

/** The signs that a destination can carry; the first leaves it to its name. */
export function PictogramPicker({ label, value, disabled, onChoose }: Props) {
  const [name] = useState(() => `pictograms-${(groups += 1)}`);
  const suggested = suggestedBy(label);
  return (
    <fieldset class="stack tight">
      <legend class="label">Sign on its card</legend>
      <div class="signs">
        {(['', ...kPictograms] as const).map((one) => {
          const drawn = one === '' ? suggested : one;
          return (
            <label key={one} class="sign">
              <input
                type="radio"
                name={name}
                checked={one === value}
                disabled={disabled}
                onChange={() => onChoose(one)}
              />
              {drawn ? <Pictogram name={drawn} /> : <span class="no-sign" />}
              <span class="small">{one === '' ? 'By its name' : pictogramWords(one)}</span>
            </label>
          );
        })}
      </div>
    </fieldset>
  );
}
