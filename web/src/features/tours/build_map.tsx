// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Tour } from '../../api/types';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { count } from '../../lib/words';

/** Building a map from complete tours. */
export function BuildMap({ tours }: { tours: readonly Tour[] }) {
  const complete = tours.filter((one) => one.state === 'complete');
  const [name, setName] = useState('');
  const [left_out, setLeftOut] = useState<ReadonlySet<string>>(new Set());
  const [begun, setBegun] = useState<string | null>(null);
  const { busy, problem, run } = useCommand();
  const chosen = complete.filter((one) => !left_out.has(one.id));
  const toggle = (tour: string) => {
    const next = new Set(left_out);
    if (!next.delete(tour)) next.add(tour);
    setLeftOut(next);
  };
  const submit = (event: Event) => {
    event.preventDefault();
    const wanted = name.trim();
    setBegun(null);
    run(async () => {
      await calls.buildMap({ name: wanted, tours: chosen.map((one) => one.id) });
      setBegun(wanted);
      setName('');
    });
  };
  return (
    <section class="card stack" aria-labelledby="build-map">
      <h2 id="build-map">Build a map</h2>
      {complete.length === 0 ? (
        <p class="soft">A map is built from complete tours. There is none yet.</p>
      ) : (
        <form class="stack" onSubmit={submit}>
          <fieldset>
            <legend class="label">From these tours</legend>
            {complete.map((one) => (
              <label class="check" key={one.id}>
                <input type="checkbox" checked={!left_out.has(one.id)} onChange={() => toggle(one.id)} />
                {one.name} <span class="soft small">{count(one.images, 'picture')}</span>
              </label>
            ))}
          </fieldset>
          <TextField label="Name of the map" value={name} onInput={setName} />
          <div class="row">
            <button
              type="submit"
              class="button main"
              disabled={busy || chosen.length === 0 || name.trim() === ''}
            >
              {busy ? 'Starting …' : 'Build the map'}
            </button>
          </div>
        </form>
      )}
      {begun !== null && <Notice>Building {begun}. Its progress is shown under Maps.</Notice>}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </section>
  );
}
