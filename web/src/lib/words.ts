// SPDX-License-Identifier: Apache-2.0

/** A label as a person would write it: "living_room" becomes "Living room". */
export function titled(label: string): string {
  const spaced = label.replace(/[_\s]+/g, ' ').trim();
  return spaced.charAt(0).toUpperCase() + spaced.slice(1);
}

/** A label inside a sentence: "living_room" becomes "living room"; a person's own capitals stay. */
export function inSentence(label: string): string {
  return label.replace(/[_\s]+/g, ' ').trim();
}

/** An age that a person reads at a glance: "2 s", "3 min", "5 h", "2 days". */
export function ageText(age_ms: number): string {
  const seconds = Math.max(0, Math.round(age_ms / 1000));
  if (seconds < 60) return `${seconds} s`;
  const minutes = Math.round(seconds / 60);
  if (minutes < 60) return `${minutes} min`;
  const hours = Math.round(minutes / 60);
  if (hours < 48) return `${hours} h`;
  return `${Math.round(hours / 24)} days`;
}

export function percent(share: number): string {
  return `${Math.round(100 * Math.min(1, Math.max(0, share)))} %`;
}

export function count(n: number, one: string, many = `${one}s`): string {
  return `${n} ${n === 1 ? one : many}`;
}

/** Microseconds since the Unix epoch as the reader's time of day, with the date where it is of another day than now. */
export function timeText(t_us: number, now_ms: number): string {
  const then = new Date(t_us / 1000);
  if (then.toDateString() !== new Date(now_ms).toDateString()) return dateText(t_us);
  return then.toLocaleTimeString(undefined, { timeStyle: 'short' });
}

/** Microseconds since the Unix epoch as the reader's day, with the year where it is another than now: "3 May". */
export function dayText(t_us: number, now_ms: number): string {
  const then = new Date(t_us / 1000);
  const year = then.getFullYear() === new Date(now_ms).getFullYear() ? undefined : 'numeric';
  return then.toLocaleDateString(undefined, { day: 'numeric', month: 'long', year });
}

/** Microseconds since the Unix epoch as the reader's date and time. */
export function dateText(t_us: number): string {
  return new Date(t_us / 1000).toLocaleString(undefined, { dateStyle: 'medium', timeStyle: 'short' });
}
