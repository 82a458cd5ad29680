// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { MapInfo, Tour } from '../../api/types';
import { Choice, TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { without } from '../../lib/draft';
import { count } from '../../lib/words';
import { offeredTours, suggested } from './tour_choice';

interface Props {
  tours: readonly Tour[];
  maps: readonly MapInfo[];
  wanted: string | null; // the tour that whoever opens the page wants a map of
}

/** Building a map from complete tours, or adding them to one that is there. */
export function BuildMap({ tours, maps, wanted }: Props) {
  const [target, setTarget] = useState('');
  const ready = maps.filter((one) => one.state === 'ready');
  const grown = ready.find((one) => one.id === target) ?? null;
  const complete = offeredTours(tours, grown);
  const [name, setName] = useState('');
  const [ticks, setTicks] = useState<ReadonlyMap<string, boolean>>(new Map()); // as somebody has set them
  const [asPath, setAsPath] = useState(false);
  const [begun, setBegun] = useState<string | null>(null);
  const { busy, problem, run } = useCommand();
  const likely = complete.some((one) => one.id === wanted) ? wanted : suggested(complete, maps);
  useEffect(() => {
    if (wanted !== null) document.getElementById('build-map')?.scrollIntoView();
  }, [wanted]);
  const isChosen = (tour: Tour) => ticks.get(tour.id) ?? tour.id === likely;
  const chosen = complete.filter(isChosen);
  // Once somebody has chosen, no tour that comes later changes what is chosen.
  const toggle = (tour: Tour) =>
    setTicks(new Map([...complete.map((one) => [one.id, isChosen(one) !== (one === tour)] as const)]));
  const submit = (event: Event) => {
    event.preventDefault();
    const called = name.trim();
    setBegun(null);
    run(async () => {
      const ids = chosen.map((one) => one.id);
      if (grown) {
        await calls.addToMap(grown.id, ids);
        setBegun(`Adding to ${grown.name}`);
        setTicks(new Map());
        return;
      }
      await calls.buildMap({ name: called, tours: ids, path: asPath });
      setBegun(asPath ? `Teaching ${called}` : `Building ${called}`);
      setName(without(name));
      setTicks(new Map());
    });
  };
  return (
    <section class="card stack" aria-labelledby="build-map">
      <h2 id="build-map">Build a map</h2>
      {ready.length > 0 && (
        <Choice
          label="What to make of the tours"
          value={grown?.id ?? ''}
          onChange={setTarget}
          options={[
            { value: '', label: 'A new map' },
            ...ready.map((one) => ({ value: one.id, label: `More of the map ${one.name}` })),
          ]}
          hint={
            grown
              ? 'Places that the tours show again gain their pictures, other places are new. Names and changes made by hand stay.'
              : undefined
          }
        />
      )}
      {complete.length === 0 ? (
        <p class="soft">
          {grown
            ? 'Every complete tour is in this map already.'
            : 'A map is built from complete tours. There is none yet.'}
        </p>
      ) : (
        <form class="stack" onSubmit={submit}>
          <fieldset>
            <legend class="label">From these tours</legend>
            {!grown && complete.length > 1 && (
              <p class="soft small">Choose tours of one building that go through some of the same rooms.</p>
            )}
            {complete.map((one) => (
              <label class="check" key={one.id}>
                <input type="checkbox" checked={isChosen(one)} onChange={() => toggle(one)} />
                {one.name} <span class="soft small">{count(one.images, 'picture')}</span>
              </label>
            ))}
          </fieldset>
          {!grown && (
            <div class="stack">
              <label class="check">
                <input type="checkbox" checked={asPath} onChange={() => setAsPath(!asPath)} />
                Teach it as a path
              </label>
              <p class="soft small">
                For one ordinary camera instead of one that sees all round: the robot follows the way of one
                tour again, forwards, from wherever on it it stands. The tour needs pictures no more than 0.1
                m apart.
              </p>
            </div>
          )}
          {!grown && asPath && chosen.length > 1 && (
            <Notice tone="bad">A path is taught by one tour. Choose one.</Notice>
          )}
          {!grown && <TextField label="Name of the map" value={name} onInput={setName} />}
          <div class="row">
            <button
              type="submit"
              class="button main"
              disabled={
                busy ||
                chosen.length === 0 ||
                (!grown && (name.trim() === '' || (asPath && chosen.length > 1)))
              }
            >
              {busy ? 'Starting …' : grown ? 'Add to the map' : asPath ? 'Teach the path' : 'Build the map'}
            </button>
          </div>
        </form>
      )}
      {begun !== null && <Notice>{begun}. Its progress is shown under Maps.</Notice>}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </section>
  );
}
