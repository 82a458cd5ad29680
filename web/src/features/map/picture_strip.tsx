// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { stripInView } from './matrix_view';

const kLeast_px = { level: 72, upright: 40 }; // of a picture along the strip

interface Props {
  map: string;
  images: readonly string[];
  from: number; // the picture at its beginning
  scale: number; // screen pixels a picture
  length_px: number;
  mark: number | null; // the picture that is chosen
  letter: string; // by which it is called elsewhere on the page
  upright?: boolean;
}

/** Some of the pictures along an edge of the matrix, moving with it; for the eyes alone, as words say the chosen ones. */
export function PictureStrip({ map, images, from, scale, length_px, mark, letter, upright = false }: Props) {
  const least_px = upright ? kLeast_px.upright : kLeast_px.level;
  const shown = length_px > 0 ? stripInView(from, scale, length_px, images.length, least_px) : [];
  const at_px = mark === null ? null : Math.round((mark + 0.5 - from) * scale);
  const along = (start: number, length: number) =>
    upright ? { top: `${start}px`, height: `${length}px` } : { left: `${start}px`, width: `${length}px` };
  return (
    <div
      class={upright ? 'strip upright' : 'strip'}
      aria-hidden="true"
      data-testid={upright ? 'strip-side' : 'strip-top'}
    >
      {shown.map(({ picture, start_px, length_px: own_px }) => (
        <img
          key={picture}
          src={calls.imageThumbnailUrl(map, images[picture] ?? '')}
          alt=""
          loading="lazy"
          draggable={false}
          style={along(start_px, own_px)}
        />
      ))}
      {at_px !== null && at_px >= 0 && at_px <= length_px && (
        <span class="strip-mark" style={upright ? { top: `${at_px}px` } : { left: `${at_px}px` }}>
          {letter}
        </span>
      )}
    </div>
  );
}
