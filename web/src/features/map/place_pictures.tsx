// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Graph, Place, Tour } from '../../api/types';
import { Section } from '../../components/section';
import { useLoaded } from '../../lib/loaded';
import { count, dateText } from '../../lib/words';
import { RecognisedBy } from './recognised_by';
import { byTour, fileOf, type TourPictures } from './tour_order';

const kAtOnce = 5;
const kShown = 30; // of a tour at first, and with each press

/** The first pictures of a place; all of them, by tour, on a press. */
export function PlacePictures({ graph, place, title }: { graph: Graph; place: Place; title: string }) {
  const first = [place.prototype, ...place.members.filter((one) => one !== place.prototype)].slice(
    0,
    kAtOnce,
  );
  return (
    <div class="stack tight">
      <ul class="pictures">
        {first.map((image, i) => (
          <li key={image}>
            <img
              class={i === 0 ? 'picture whole' : 'picture'}
              src={calls.imageThumbnailUrl(graph.map, image)}
              alt={`${title}, picture ${i + 1}`}
              loading="lazy"
            />
          </li>
        ))}
      </ul>
      <p class="soft small">
        {count(place.members.length, 'picture')}, {count(place.features, 'thing')} to recognise
      </p>
      <Section title="All pictures, by tour" heading={false}>
        <Tours graph={graph} images={place.members} />
      </Section>
      <RecognisedBy graph={graph} place={place} />
    </div>
  );
}

function Tours({ graph, images }: { graph: Graph; images: readonly string[] }) {
  const known = useLoaded(calls.tours).value?.tours ?? [];
  return (
    <>
      {byTour(images).map((one) => (
        <OneTour
          key={one.tour}
          map={graph.map}
          tour={known.find((tour) => tour.id === one.tour) ?? null}
          pictures={one}
        />
      ))}
    </>
  );
}

function OneTour({ map, tour, pictures }: { map: string; tour: Tour | null; pictures: TourPictures }) {
  const [most, setMost] = useState(kShown);
  const { images } = pictures;
  return (
    <div class="stack tight">
      <p>
        <strong>{tour?.name ?? pictures.tour}</strong>{' '}
        <span class="soft small">
          {tour && `brought ${dateText(tour.created_us)}, `}
          {count(images.length, 'picture')}, in their order
        </span>
      </p>
      <ol class="choices">
        {images.slice(0, most).map((image) => (
          <li key={image} class="choice">
            <img src={calls.imageThumbnailUrl(map, image)} alt="" loading="lazy" />
            <span class="small">{fileOf(image)}</span>
          </li>
        ))}
      </ol>
      {images.length > most && (
        <button type="button" class="button small" onClick={() => setMost(most + kShown)}>
          Show more of {count(images.length, 'picture')}
        </button>
      )}
    </div>
  );
}
