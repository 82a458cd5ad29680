// SPDX-License-Identifier: Apache-2.0
import type { Destination } from '../api/types';

/** What the contract can say of a destination; '' leaves it to the label. */
export type PictogramName = Exclude<Destination['pictogram'], ''>;

interface Meaning {
  said: string; // in a list to choose from
  words: RegExp; // in a label, that suggest it
}

/** In the order in which labels are tried: a bathroom is not a room with a bed. */
const kMeanings: Readonly<Record<PictogramName, Meaning>> = {
  toilet: { said: 'Toilet', words: /\b(toilet|wc|lavatory|restroom)s?\b/ },
  bath: { said: 'Bath', words: /\b(bath|bathroom|shower|washroom)s?\b/ },
  kitchen: { said: 'Kitchen', words: /\b(kitchen|kitchenette|galley|stove)s?\b/ },
  dining: { said: 'Meals', words: /\b(dining|diner|canteen|cafeteria|cafe|breakfast|restaurant)\b/ },
  bed: { said: 'Bed', words: /\b(bed|bedroom|bedside|ward)s?\b/ },
  seat: {
    said: 'Seat',
    words: /\b(seat|sofa|couch|armchair|living room|lounge|television|tv|sitting room)s?\b/,
  },
  reception: { said: 'Reception', words: /\b(reception|front desk|nurses'? station)\b/ },
  desk: { said: 'Desk', words: /\b(desk|office|study|library|computer)s?\b/ },
  garden: { said: 'Garden', words: /\b(garden|terrace|balcony|patio|yard|conservatory)s?\b/ },
  lift: { said: 'Lift', words: /\b(lift|elevator)s?\b/ },
  therapy: { said: 'Exercise', words: /\b(therapy|physio|physiotherapy|gym|exercise)\b/ },
  treatment: { said: 'Treatment', words: /\b(treatment|doctor|nurse|clinic|surgery|infirmary)s?\b/ },
  wardrobe: { said: 'Wardrobe', words: /\b(wardrobe|closet|cloakroom|coat stand|dressing room)s?\b/ },
  door: { said: 'Door', words: /\b(door|entrance|exit|hall|hallway|porch|lobby)s?\b/ },
};

/** All that there are, in the order of their names. */
export const kPictograms = (Object.keys(kMeanings) as PictogramName[]).sort();

export function pictogramWords(name: PictogramName): string {
  return kMeanings[name].said;
}

/** What a label suggests; null where it suggests nothing. */
export function suggestedBy(label: string): PictogramName | null {
  const text = label.replace(/_/g, ' ').toLowerCase();
  const found = (Object.keys(kMeanings) as PictogramName[]).find((name) => kMeanings[name].words.test(text));
  return found ?? null;
}

/** By which picture a destination is known: the one that a person gave it, else what its name suggests. */
export function pictogramOf(chosen: Destination['pictogram'], name: string): PictogramName | null {
  return chosen === '' ? suggestedBy(name) : chosen;
}
