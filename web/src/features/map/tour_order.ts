// SPDX-License-Identifier: Apache-2.0

/** Pictures of one tour, in the order in which they were taken. */
export interface TourPictures {
  tour: string; // its id
  images: readonly string[];
}

const order = new Intl.Collator('en', { numeric: true });

export function fileOf(image: string): string {
  return image.split('/').at(-1) ?? image;
}

/** Pictures by tour; a tour takes its pictures in the order of their names. */
export function byTour(images: readonly string[]): TourPictures[] {
  const tours = new Map<string, string[]>();
  for (const image of images) {
    const tour = image.split('/')[0] ?? '';
    tours.set(tour, [...(tours.get(tour) ?? []), image]);
  }
  return [...tours]
    .sort(([a], [b]) => order.compare(a, b))
    .map(([tour, own]) => ({ tour, images: own.sort((a, b) => order.compare(a, b)) }));
}
