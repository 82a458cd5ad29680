// SPDX-License-Identifier: Apache-2.0
import {
  defaultRangeExtractor,
  elementScroll,
  observeElementOffset,
  observeElementRect,
  Virtualizer,
  type Range,
} from '@tanstack/virtual-core';
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';

const kOverscan = 6; // rows beyond either edge, for the tab key and quick scrolling

interface Props<T> {
  items: readonly T[];
  keyOf: (item: T) => string;
  row: (item: T) => ComponentChildren;
  row_px: number; // a row's height until it was measured
}

/** A list that scrolls by itself, of which only the rows in view are made, and the one that has the focus. */
export function LongList<T>({ items, keyOf, row, row_px }: Props<T>) {
  const scroller = useRef<HTMLDivElement>(null);
  const focused = useRef<string | null>(null);
  const [, setDrawn] = useState(0);
  const keyAt = (index: number) => {
    const item = items[index];
    return item === undefined ? '' : keyOf(item);
  };
  const options = {
    count: items.length,
    getScrollElement: () => scroller.current,
    estimateSize: () => row_px,
    getItemKey: keyAt,
    gap: 4,
    overscan: kOverscan,
    rangeExtractor: (range: Range) => {
      const shown = defaultRangeExtractor(range);
      const kept = focused.current === null ? -1 : items.findIndex((one) => keyOf(one) === focused.current);
      return kept < 0 || shown.includes(kept) ? shown : [...shown, kept].sort((a, b) => a - b);
    },
    scrollToFn: elementScroll,
    observeElementRect,
    observeElementOffset,
    onChange: () => setDrawn((n) => n + 1),
  };
  const [virtualizer] = useState(() => new Virtualizer<HTMLDivElement, HTMLLIElement>(options));
  virtualizer.setOptions(options);
  useLayoutEffect(() => virtualizer._didMount(), [virtualizer]);
  useLayoutEffect(() => virtualizer._willUpdate());
  return (
    <div class="long-list" ref={scroller} tabIndex={-1}>
      <ul style={{ height: `${virtualizer.getTotalSize()}px` }}>
        {virtualizer.getVirtualItems().map(({ index, start }) => {
          const item = items[index];
          if (item === undefined) return null;
          const key = keyOf(item);
          return (
            <li
              key={key}
              ref={virtualizer.measureElement}
              data-index={index}
              aria-setsize={items.length}
              aria-posinset={index + 1}
              style={{ top: `${start}px` }}
              onFocusIn={() => (focused.current = key)}
              onFocusOut={() => (focused.current = null)}
            >
              {row(item)}
            </li>
          );
        })}
      </ul>
    </div>
  );
}
