// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';

export const kViews = ['go', 'map', 'tours', 'robots', 'settings'] as const;
export type View = (typeof kViews)[number];

export const path = signal(location.pathname);

/** The view that an address names; unknown addresses lead to Go. */
export function viewOf(pathname: string): View {
  const first = pathname.split('/')[1] ?? '';
  return kViews.find((view) => view === first) ?? 'go';
}

export function navigate(to: string, replace = false): void {
  if (to === location.pathname && !location.search) return;
  history[replace ? 'replaceState' : 'pushState'](null, '', to);
  path.value = location.pathname;
}

addEventListener('popstate', () => (path.value = location.pathname));
