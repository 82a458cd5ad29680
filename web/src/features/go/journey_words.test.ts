// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Journey } from './journey';
import type { Graph } from '../../api/types';
import { announcement, arrivalSureness, heading, reasonOf, recordWords } from './journey_words';

const journey: Journey = {
  id: 'one',
  phase: 'arrived',
  explores: false,
  destination: 'kitchen',
  place: 'p5',
  reason: null,
  refusal: null,
  by: 'anna',
  created_us: null,
  ended_us: null,
  path: ['p1', 'p5'],
  path_index: 1,
  arrival_probability: null,
};
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 1,
  places: [
    { id: 'p5', label: '', prototype: 't/5.jpg', members: ['t/5.jpg'], features: 9, x: 0, y: 0 },
    { id: 'p6', label: "Anna's room", prototype: 't/6.jpg', members: ['t/6.jpg'], features: 9, x: 1, y: 0 },
  ],
  edges: [],
  destinations: [{ id: 'kitchen', place: 'p5', image: 't/5.jpg', label: 'south_hall', pictogram: '' }],
  hypotheses: [],
  shortcuts: [],
};

describe('what a journey says', () => {
  it('says where it ended', () => {
    expect(heading(journey, null)).toBe('Arrived: the place you chose');
    expect(reasonOf(journey)).toBeNull();
  });

  it('tells a stop by a person, a driver who went away and a lost connection apart', () => {
    const ended = (code: string, parameters = {}) =>
      heading({ ...journey, phase: 'stopped', reason: { code, parameters } }, graph);
    expect(ended('stopped_by', { by: 'Vera' })).toBe('Stopped by Vera on the way to South hall');
    expect(ended('taken_over_by', { by: 'Ben' })).toBe('Taken over by Ben on the way to South hall');
    expect(ended('nobody_watching')).toBe('Nobody was driving any more on the way to South hall');
    expect(ended('robot_gone')).toBe('Connection lost on the way to South hall');
    expect(ended('server_silent')).toBe('Connection lost on the way to South hall');
    expect(ended('rider_took_over')).toBe('The rider took over on the way to South hall');
    expect(ended('too_long')).toBe('Stopped on the way to South hall');
  });

  it('says who sent it and when it ended, as far as that is known', () => {
    const noon_ms = new Date(2026, 4, 7, 12, 5).getTime();
    const sent = { ...journey, created_us: 1000 * noon_ms };
    expect(recordWords(journey, noon_ms)).toBeNull();
    expect(recordWords(sent, noon_ms)).toMatch(/^Sent by anna at 12:05.*\.$/);
    expect(recordWords({ ...sent, ended_us: 1000 * (noon_ms + 120e3) }, noon_ms)).toMatch(
      / Ended at 12:07.*\.$/,
    );
  });

  it('says what was not right where it arrived', () => {
    const beside = { ...journey, reason: { code: 'heading_not_taken', parameters: {} } };
    expect(reasonOf(beside)).toBe('I am there, but cannot turn to the right heading.');
  });

  it('says how sure an arrival is where that is worth a look, and only then', () => {
    const said = (arrival_probability: number | null) =>
      arrivalSureness({ ...journey, arrival_probability }, graph);
    expect(said(null)).toBeNull();
    expect(said(1)).toBeNull();
    expect(said(0.99)).toBeNull();
    expect(said(0.989)).toBe('I am quite sure that this is the south hall.');
    expect(said(0.95)).toBe('I am quite sure that this is the south hall.');
    expect(said(0.949)).toBe('I am fairly sure that this is the south hall. Please have a look.');
    expect(said(0.9)).toBe('I am fairly sure that this is the south hall. Please have a look.');
    expect(said(0.6)).toBe('I am not sure that this is the south hall. Please have a look.');
  });

  it('says nothing of arriving before it has arrived, nor where it ended otherwise', () => {
    for (const phase of ['driving', 'stopped', 'failed'] as const)
      expect(arrivalSureness({ ...journey, phase, arrival_probability: 0.95 }, graph)).toBeNull();
  });

  it('is announced as whole sentences', () => {
    expect(announcement(journey, graph)).toBe('Arrived: South hall');
    expect(
      announcement(
        { ...journey, reason: { code: 'heading_not_taken', parameters: {} }, arrival_probability: 0.96 },
        graph,
      ),
    ).toBe(
      'Arrived: South hall. I am there, but cannot turn to the right heading. I am quite sure that this is the south hall.',
    );
  });

  it('names where it went as a person would', () => {
    const sure = { ...journey, arrival_probability: 0.96 };
    expect(arrivalSureness({ ...sure, destination: null, place: 'p6' }, graph)).toBe(
      "I am quite sure that this is Anna's room.",
    );
    expect(arrivalSureness(sure, null)).toBe('I am quite sure that this is the place you chose.');
  });
});
