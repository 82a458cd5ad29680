// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, MapInfo, MapPlan, PlanLines } from '../../api/types';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { placeTitle } from '../../lib/whereabouts';
import { PlaceList } from '../map/place_list';
import { kFewestPins, pinsOf, placed, spotOf, tieOf, troubleOf, type Pin } from './pins';
import { PlanDrawing, type Mark } from './plan_drawing';

interface Props {
  map: MapInfo;
  graph: Graph;
  lines: PlanLines;
  tie: MapPlan | null; // what to begin with
  onDone: () => void;
}

/** Says where places are on the plan: by a press on it for the chosen place, or by numbers. */
export function PinEditor({ map, graph, lines, tie, onDone }: Props) {
  const [pins, setPins] = useState<readonly Pin[]>(() => pinsOf(tie));
  const [chosen, setChosen] = useState<string | null>(null);
  const { busy, problem, run, forget } = useCommand();
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => heading.current?.focus(), []);
  const wanted = tieOf(lines.plan, lines.version, pins);
  const marks = useMemo(() => marksOfPins(pins, graph, chosen), [pins, graph, chosen]);
  const change = (next: readonly Pin[]) => {
    setPins(next);
    forget();
  };
  const save = () =>
    run(async () => {
      if (!wanted) return;
      await calls.tieMap(map.id, wanted);
      onDone();
    });
  const title = chosen === null ? null : placeTitle(graph, chosen);
  return (
    <>
      <h3 tabIndex={-1} ref={heading}>
        Where places are on the plan
      </h3>
      <p class="soft">
        Choose a place in the list, then press the plan where its picture was taken; or type how far it is to
        the right and up, in metres. Two places are enough; a few more, far apart, show how well the map fits.
      </p>
      <p role="status">
        <strong>{title === null ? 'No place is chosen.' : `Press the plan where this is: ${title}.`}</strong>
      </p>
      <div class="map-layout">
        <PlanDrawing
          lines={lines}
          marks={marks}
          words={`The plan, with ${pins.length} pinned places`}
          onPress={chosen === null ? undefined : (spot) => change(placed(pins, chosen, spot))}
        />
        <div class="map-side">
          <section class="card stack" aria-labelledby="pins">
            <h4 id="pins">Pinned places</h4>
            {pins.length < kFewestPins && (
              <p class="soft">{pins.length === 0 ? 'None yet: two are needed.' : 'One more is needed.'}</p>
            )}
            <ul class="list">
              {pins.map((pin) => (
                <PinRow
                  key={pin.place}
                  pin={pin}
                  title={placeTitle(graph, pin.place)}
                  onChange={(next) => change(pins.map((one) => (one.place === pin.place ? next : one)))}
                  onRemove={() => change(pins.filter((one) => one.place !== pin.place))}
                />
              ))}
            </ul>
            {chosen !== null && !pins.some((one) => one.place === chosen) && (
              <p>
                <button
                  type="button"
                  class="button"
                  onClick={() => change([...pins, { place: chosen, image: null, x: '', y: '', degrees: '' }])}
                >
                  Type numbers for {title}
                </button>
              </p>
            )}
            {problem && <Notice tone="bad">{problem.message}</Notice>}
            <div class="row">
              <button type="button" class="button main" disabled={busy || !wanted} onClick={save}>
                {busy ? 'Saving …' : 'Save'}
              </button>
              <button type="button" class="button" disabled={busy} onClick={onDone}>
                Leave it as it was
              </button>
            </div>
          </section>
          <PlaceList graph={graph} belief={null} chosen={chosen} onChoose={setChosen} />
        </div>
      </div>
    </>
  );
}

function marksOfPins(pins: readonly Pin[], graph: Graph, chosen: string | null): Mark[] {
  return pins.flatMap((pin): Mark[] => {
    const spot = spotOf(pin);
    const kind = pin.place === chosen ? 'chosen' : 'pinned';
    return spot ? [{ key: pin.place, kind, ...spot, label: placeTitle(graph, pin.place) }] : [];
  });
}

interface RowProps {
  pin: Pin;
  title: string;
  onChange: (pin: Pin) => void;
  onRemove: () => void;
}

function PinRow({ pin, title, onChange, onRemove }: RowProps) {
  const trouble = pin.x === '' && pin.y === '' ? null : troubleOf(pin);
  return (
    <li>
      <div class="stack tight pin-row" role="group" aria-label={title}>
        <div class="row apart">
          <strong>{title}</strong>
          <button type="button" class="button small" aria-label={`Remove ${title}`} onClick={onRemove}>
            Remove
          </button>
        </div>
        <div class="pin-numbers">
          <TextField label="Right, m" value={pin.x} onInput={(x) => onChange({ ...pin, x })} maxLength={20} />
          <TextField label="Up, m" value={pin.y} onInput={(y) => onChange({ ...pin, y })} maxLength={20} />
          <TextField
            label="Faces, °"
            value={pin.degrees}
            onInput={(degrees) => onChange({ ...pin, degrees })}
            required={false}
            maxLength={20}
          />
        </div>
        {trouble !== null && <p class="small warn-text">{trouble}</p>}
      </div>
    </li>
  );
}
