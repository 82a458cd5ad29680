// SPDX-License-Identifier: Apache-2.0
import type { PictogramName } from '../lib/pictograms';

const kPaths: Readonly<Record<PictogramName, string>> = {
  bath: 'M2.5 12h19v2a5 5 0 0 1-5 5h-9a5 5 0 0 1-5-5zM6 12V6a2 2 0 0 1 4 0v.5M7 19l-1 2.5M17 19l1 2.5',
  bed: 'M3 5v15M3 16h18v4M21 16v-3a3 3 0 0 0-3-3h-7v6M7 13.5a1.8 1.8 0 1 0 0-3.6 1.8 1.8 0 0 0 0 3.6z',
  desk: 'M2.5 11h19M5 11v9.5M19 11v9.5M13 11v5h6M6.5 4h7v5h-7zM10 9v2',
  dining: 'M7 3v18M4 3v5a3 3 0 0 0 6 0V3M17.5 3v18M17.5 3c-2.6 1.5-3.5 5-3.5 9.5h3.5',
  door: 'M6 21V3h12v18M3 21h18M14.5 12v.1',
  garden:
    'M12 21.5V12M12 17.5l4-3M7 13a4.2 4.2 0 0 1-.2-8 5.4 5.4 0 0 1 10.4 0A4.2 4.2 0 0 1 17 13c-2.9 1-7.1 1-10 0z',
  kitchen: 'M5 11h14v5a4 4 0 0 1-4 4H9a4 4 0 0 1-4-4zM2.5 13H5M19 13h2.5M9 7.5V5M12 7.5V4M15 7.5V5',
  lift: 'M4 3h16v18H4zM12 3v18M6.5 13 8 10.5 9.5 13M14.5 11l1.5 2.5 1.5-2.5',
  reception: 'M3 20.5h18M5 17a7 7 0 0 1 14 0zM12 10V6.5M9.5 6.5h5',
  seat: 'M6.5 11V6a2.5 2.5 0 0 1 2.5-2.5h6A2.5 2.5 0 0 1 17.5 6v5M4.5 10.5a2 2 0 0 1 2 2V15h11v-2.5a2 2 0 1 1 4 0V19h-19v-6.5a2 2 0 0 1 2-2zM5 19v2M19 19v2',
  therapy:
    'M12 6.7a2.3 2.3 0 1 0 0-4.6 2.3 2.3 0 0 0 0 4.6zM3.5 6.5 9 10h6l5.5-3.5M9 10v5.5L7 22M15 10v5.5L17 22M9 15.5h6',
  toilet: 'M6 3h4.5v8.5M6 3v8.5M5 11.5h14.5a7 7 0 0 1-7 6.5h-3A4.5 4.5 0 0 1 5 13.5zM9 18v3.5h7l-1-4.2',
  treatment: 'M9 3h6v6h6v6h-6v6H9v-6H3V9h6z',
  wardrobe: 'M12 9.5V8.5a2.3 2.3 0 1 0-2.3-2.3M12 9.5l8.8 6.3a1.5 1.5 0 0 1-.9 2.7H4.1a1.5 1.5 0 0 1-.9-2.7z',
};

/** The sign by which a destination can be known without reading; its name stands beside it. */
export function Pictogram({ name, size = 32 }: { name: PictogramName; size?: number }) {
  return (
    <svg
      class="pictogram"
      data-pictogram={name}
      width={size}
      height={size}
      viewBox="0 0 24 24"
      fill="none"
      stroke="currentColor"
      stroke-width="1.9"
      stroke-linecap="round"
      stroke-linejoin="round"
      aria-hidden="true"
    >
      <path d={kPaths[name]} />
    </svg>
  );
}
