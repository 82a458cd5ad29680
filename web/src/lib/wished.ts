// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';

/** A choice that is saved at once: shown as chosen while it is under way, and as it was where it was refused. */
export function useWished<T>(present: T, refused: boolean): [T, (wish: T) => void] {
  const [kept, setKept] = useState<{ wish: T; over: T } | null>(null);
  const holds = kept !== null && kept.over === present && !refused;
  return [holds ? kept.wish : present, (wish) => setKept({ wish, over: present })];
}
