// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Job } from '../../api/types';
import { driveNews } from './drive_news';

const job = (part: Partial<Job>): Job => ({
  id: 'j',
  kind: 'refine',
  map: 'm',
  state: 'offered',
  progress: { stage: 'places', share: 1 },
  error: null,
  skipped: 0,
  gained: 3,
  notes: [
    {
      code: 'place_would_gain',
      parameters: { place: { code: 'place_named', parameters: { label: 'kitchen' } }, appearances: 3 },
    },
  ],
  created_us: 1,
  ...part,
});

it('says what drives would teach and where', () => {
  expect(driveNews(job({}), null)).toBe(
    '3 new appearances from drives. kitchen would gain 3 new appearances.',
  );
  expect(driveNews(job({ gained: 1, notes: [] }), null)).toBe('1 new appearance from drives. ');
});

it('says nothing of drives that taught nothing or that a person discarded', () => {
  expect(driveNews(job({ state: 'done', gained: 0, notes: [] }), null)).toBeNull();
  expect(driveNews(job({ state: 'cancelled' }), null)).toBeNull();
});

it('says why nothing could be learnt', () => {
  const error = { type: 'about:blank', title: 'No', status: 422, detail: 'they cannot be compared' };
  expect(driveNews(job({ state: 'failed', error: error as Job['error'] }), null)).toContain(
    'They cannot be compared',
  );
});
