// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Belief, Graph } from '../api/types';
import { placeInWords, placeTitle, titlesApart, whereabouts } from './whereabouts';

/** A graph as a drawing: "hall-a-b-living_room", names longer than two letters are destinations. */
function drawn(line: string): Graph {
  const names = line.split('-');
  return {
    format: 'homeward-graph',
    version: 1,
    map: 'm',
    revision: 1,
    places: names.map((id, i) => ({ id, label: '', prototype: id, members: [], features: 0, x: i, y: 0 })),
    edges: names.slice(1).map((to, i) => ({
      from: names[i] ?? '',
      to,
      bearing_rad: 0,
      turn_rad: 0,
      length_m: 1,
      length_from: 'odometry',
      confidence: 0.9,
      inliers: 40,
      weak: false,
      blocked: false,
      shortcut: false,
      by: 'method',
    })),
    destinations: names
      .filter((id) => id.length > 2)
      .map((id) => ({ id: `d-${id}`, place: id, image: `t/${id}.jpg`, label: id, pictogram: '' as const })),
    hypotheses: [],
    shortcuts: [],
  };
}

function belief(place: string, probability: number, lost = false): Belief {
  return { updates: 9, place, probability, top: [{ place, probability }], lost };
}

const house = drawn('hall-a-b-c-living_room');

describe('placeInWords', () => {
  it('names the place itself, or the nearest one that has a name', () => {
    expect(placeInWords(house, 'living_room')).toBe('in the living room');
    expect(placeInWords(house, 'a')).toBe('near the hall');
    expect(placeInWords(house, 'c')).toBe('near the living room');
    expect(placeInWords(drawn('a-b'), 'a')).toBeNull();
  });

  it('needs no article where a person would use none', () => {
    const graph = {
      ...house,
      places: house.places.map((p) => (p.id === 'b' ? { ...p, label: "Anna's room" } : p)),
    };
    expect(placeInWords(graph, 'b')).toBe("in Anna's room");
    expect(placeTitle(graph, 'hall')).toBe('Hall');
    expect(placeTitle(drawn('a-b'), 'a')).toBe('a');
  });

  it('is told from others in the words of the server, where it has some', () => {
    const told = (name: string) => ({
      ...house,
      places: house.places.map((p) => (p.id === 'b' ? { ...p, name } : p)),
    });
    expect(placeTitle(told('second from the hall'), 'b')).toBe('Second from the hall');
    expect(placeTitle(told('b'), 'b')).toBe('Near the hall');
    expect(placeInWords(told('second from the hall'), 'b')).toBe('near the hall');
    expect(titlesApart(house, 'a', 'b')).toEqual(['Near the hall (a)', 'Near the hall (b)']);
    expect(titlesApart(house, 'hall', 'b')).toEqual(['Hall', 'Near the hall']);
  });
});

describe('whereabouts', () => {
  it('is as sure as the belief is of being there or beside it', () => {
    const split: Belief = {
      updates: 9,
      place: 'hall',
      probability: 0.95,
      top: [
        { place: 'hall', probability: 0.5 },
        { place: 'a', probability: 0.4 },
      ],
      lost: false,
    };
    expect(whereabouts(split, house)).toMatchObject({ sureness: 'sure', share: 0.95, where: 'in the hall' });
    expect(whereabouts(belief('hall', 0.6), house)?.sureness).toBe('fairly sure');
    expect(whereabouts(belief('hall', 0.3), house)?.sureness).toBe('unsure');
  });

  it('says lost when the belief says so, however probable its best place', () => {
    expect(whereabouts(belief('hall', 0.99, true), house)).toMatchObject({ sureness: 'lost', where: null });
  });

  it('knows nothing without a belief, and less without a graph', () => {
    expect(whereabouts(null, house)).toBeNull();
    expect(whereabouts(belief('hall', 0.9), null)).toMatchObject({ sureness: 'sure', where: null });
  });
});
