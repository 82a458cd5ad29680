// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';

const kKey = 'homeward.dismissed';
const kMost = 200; // older ones are of jobs that the server does not tell of any more

function remembered(): readonly string[] {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(kKey) ?? '[]');
    return Array.isArray(kept) ? kept.filter((one) => typeof one === 'string') : [];
  } catch {
    return []; // storage may be forbidden; then nothing is remembered
  }
}

const dismissed = signal<readonly string[]>(typeof localStorage === 'undefined' ? [] : remembered());

/** Whether the reader has put a message away, in this browser; `id` names the message. */
export function isDismissed(id: string): boolean {
  return dismissed.value.includes(id);
}

export function dismiss(id: string): void {
  dismissed.value = [...dismissed.peek().filter((one) => one !== id), id].slice(-kMost);
  try {
    localStorage.setItem(kKey, JSON.stringify(dismissed.peek()));
  } catch {
    // put away for as long as this page is open
  }
}
