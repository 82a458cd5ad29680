// SPDX-License-Identifier: Apache-2.0
import { effect } from '@preact/signals';
import { chosen } from '../../lib/chosen';
import { isActive } from './journey';

/**
 * Keeps the screen on while the chosen robot drives: a phone that sleeps lets the lease end, and the robot stops.
 * Returns its end. Does nothing where the browser cannot, as on an address without https.
 */
export function keepScreenOn(): () => void {
  const wakeLock = (navigator as { wakeLock?: WakeLock }).wakeLock;
  if (!wakeLock) return () => undefined;
  let held: Promise<WakeLockSentinel | null> | null = null;
  const release = () => {
    void held?.then((sentinel) => sentinel?.release());
    held = null;
  };
  const update = () => {
    const driving = isActive(chosen.value?.mission?.state) && !document.hidden;
    if (driving) held ??= wakeLock.request('screen').catch(() => null);
    else release();
  };
  const end = effect(update);
  document.addEventListener('visibilitychange', update);
  return () => {
    end();
    document.removeEventListener('visibilitychange', update);
    release();
  };
}
