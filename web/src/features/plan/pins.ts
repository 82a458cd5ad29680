// SPDX-License-Identifier: Apache-2.0
import type { MapPlan, PlanTie } from '../../api/types';
import type { Spot } from './plan_geometry';

/** A place that a person puts on the plan, as it is typed; `image` where the pin was kept before. */
export interface Pin {
  place: string;
  image: string | null;
  x: string; // metres
  y: string;
  degrees: string; // where the robot faced, counter-clockwise from the right of the plan; empty: not said
}

export const kFewestPins = 2;
const kFarthest_m = 100_000;

/** The pins that a map has; those whose pictures are gone are left out. */
export function pinsOf(tie: MapPlan | null): Pin[] {
  return (tie?.pins ?? []).flatMap(({ image, place, x_m, y_m, theta_rad }) =>
    place === null
      ? []
      : [
          {
            place,
            image,
            x: String(x_m),
            y: String(y_m),
            degrees: theta_rad === null ? '' : String(Math.round((theta_rad * 1800) / Math.PI) / 10),
          },
        ],
  );
}

/** With the place put there: a new pin, or its own one moved. */
export function placed(pins: readonly Pin[], place: string, { x_m, y_m }: Spot): Pin[] {
  const [x, y] = [String(x_m), String(y_m)];
  if (!pins.some((one) => one.place === place)) return [...pins, { place, image: null, x, y, degrees: '' }];
  return pins.map((one) => (one.place === place ? { ...one, x, y } : one));
}

/** A number as people type it, also with a comma; null for what is none or too far. */
export function numberIn(text: string, most: number): number | null {
  const plain = text.trim().replace(',', '.');
  if (!/^[-+]?(\d+\.?\d*|\.\d+)$/.test(plain)) return null;
  const value = Number(plain);
  return Math.abs(value) <= most ? value : null;
}

/** Where a pin is; null while its numbers are none. */
export function spotOf({ x, y }: Pin): Spot | null {
  const [x_m, y_m] = [numberIn(x, kFarthest_m), numberIn(y, kFarthest_m)];
  return x_m === null || y_m === null ? null : { x_m, y_m };
}

/** What is wrong with a pin, for who types it; null: nothing. */
export function troubleOf(pin: Pin): string | null {
  if (spotOf(pin) === null) return 'Say both distances in metres, such as 4.25.';
  if (pin.degrees.trim() !== '' && numberIn(pin.degrees, 360) === null)
    return 'Say where it faces in degrees from -360 to 360, or leave it empty.';
  return null;
}

/** What to send; null while there is something wrong or too little. */
export function tieOf(plan: string, version: number, pins: readonly Pin[]): PlanTie | null {
  if (pins.length < kFewestPins) return null;
  const sent: PlanTie['pins'] = [];
  for (const pin of pins) {
    const spot = spotOf(pin);
    if (spot === null || troubleOf(pin) !== null) return null;
    const degrees = pin.degrees.trim() === '' ? null : numberIn(pin.degrees, 360);
    const where = { ...spot, theta_rad: degrees === null ? null : wrapped((degrees * Math.PI) / 180) };
    sent.push(pin.image === null ? { place: pin.place, ...where } : { image: pin.image, ...where });
  }
  return { plan, version, pins: sent };
}

function wrapped(angle_rad: number): number {
  return angle_rad - 2 * Math.PI * Math.ceil(angle_rad / (2 * Math.PI) - 0.5);
}
