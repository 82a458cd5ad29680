// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Limits } from '../../api/calls';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { limitsOf, type TypedLimits } from './limit_words';

export interface LimitsHandle {
  typed: TypedLimits;
  type: (part: Partial<TypedLimits>) => void;
  limits: Limits | null; // null: what is typed is none
}

export function useLimits(): LimitsHandle {
  const [typed, setTyped] = useState<TypedLimits>({ minutes: '', metres: '', back: '' });
  return {
    typed,
    type: (part) => setTyped((before) => ({ ...before, ...part })),
    limits: limitsOf(typed),
  };
}

/** How long and how far it may go; all of it may stay empty. */
export function LimitFields({ typed, type, limits }: LimitsHandle) {
  return (
    <div class="stack">
      <div class="form-columns">
        <TextField
          label="Minutes at most"
          hint="In all, without what it is paused. Empty: as long as it takes."
          value={typed.minutes}
          onInput={(minutes) => type({ minutes })}
          required={false}
        />
        <TextField
          label="Metres at most"
          hint="In all. Empty: as far as it takes."
          value={typed.metres}
          onInput={(metres) => type({ metres })}
          required={false}
        />
        <TextField
          label="Be back after minutes"
          hint="From now on: then it stands where it began."
          value={typed.back}
          onInput={(back) => type({ back })}
          required={false}
        />
      </div>
      {limits === null && <Notice tone="warn">Limits are numbers: 1 minute or 1 metre at least.</Notice>}
    </div>
  );
}
