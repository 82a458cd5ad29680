// SPDX-License-Identifier: Apache-2.0
import type { Place, Tour } from '../../api/types';
import { dateText } from '../../lib/words';

/** One appearance by which a place is recognised. */
export interface KnownAppearance {
  image: string | null; // null: it was seen on a drive
  brightness: number; // the mean of all its colours, 0 to 1
}

// Pictures of lit rooms, real and rendered, have 0.33 to 0.75, such by night 0.12 to 0.42, as cameras adapt.
const kDark = 0.15;
const kDim = 0.33;

/** The looks that a place is recognised by, its own picture's first; none where the server does not tell. */
export function appearancesOf({ prototype, brightness, learnt }: Place): readonly KnownAppearance[] {
  return brightness === undefined ? [] : [{ image: prototype, brightness }, ...(learnt ?? [])];
}

/** In which light a picture was taken. */
export function lightWords(brightness: number): string {
  if (brightness < kDark) return 'in the dark';
  return brightness < kDim ? 'in dim light' : 'in good light';
}

/** From where a look is, of when, and in which light. */
export function appearanceWords(
  { image, brightness }: KnownAppearance,
  tours: readonly Pick<Tour, 'id' | 'name' | 'created_us'>[],
): string {
  const light = lightWords(brightness);
  if (image === null) return `Seen on a drive, ${light}`;
  const tour = tours.find(({ id }) => id === image.split('/')[0]);
  if (!tour) return `A picture of a tour, ${light}`;
  return `From the tour ${tour.name}, brought ${dateText(tour.created_us)}, ${light}`;
}
