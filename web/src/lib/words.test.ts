// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { ageText, count, dateText, dayText, percent, timeText, titled } from './words';

describe('words', () => {
  it('writes labels as people do', () => {
    expect(titled('living_room')).toBe('Living room');
    expect(titled("  anna's   room ")).toBe("Anna's room");
    expect(titled('')).toBe('');
  });

  it('gives ages that are read at a glance', () => {
    expect(ageText(-5)).toBe('0 s');
    expect(ageText(59_400)).toBe('59 s');
    expect(ageText(90_000)).toBe('2 min');
    expect(ageText(3 * 3600e3)).toBe('3 h');
    expect(ageText(72 * 3600e3)).toBe('3 days');
  });

  it('gives the time of day, and the date where it was another day', () => {
    const noon_us = new Date(2026, 4, 7, 12, 5).getTime() * 1000;
    expect(timeText(noon_us, noon_us / 1000 + 3600e3)).toMatch(/^12:05/);
    expect(timeText(noon_us, noon_us / 1000 + 24 * 3600e3)).toBe(dateText(noon_us));
  });

  it('gives the day, and the year where it was another one', () => {
    const day = (year: number) =>
      dayText(new Date(year, 4, 3, 12).getTime() * 1000, new Date(2026, 7, 1).getTime());
    expect(day(2026)).toMatch(/3/);
    expect(day(2026)).not.toMatch(/2026/);
    expect(day(2025)).toMatch(/2025/);
  });

  it('keeps shares between 0 and 100 %', () => {
    expect(percent(0.944)).toBe('94 %');
    expect(percent(1.2)).toBe('100 %');
    expect(count(1, 'place')).toBe('1 place');
    expect(count(0, 'place')).toBe('0 places');
  });
});
