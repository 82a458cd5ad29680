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

/** A press on a link changes the view without loading the page again, unless the reader asks for another window. */
export function follow(event: MouseEvent): void {
  if (event.ctrlKey || event.metaKey || event.shiftKey || !(event.currentTarget instanceof HTMLAnchorElement))
    return;
  event.preventDefault();
  navigate(event.currentTarget.pathname);
  scrollTo(0, 0);
  // The new page begins here for keyboards and screen readers.
  requestAnimationFrame(() => document.getElementById('content')?.focus({ preventScroll: true }));
}

addEventListener('popstate', () => (path.value = location.pathname));
