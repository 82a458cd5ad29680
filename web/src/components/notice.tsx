// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from 'preact';
import { Icon } from './icons';

export type Tone = 'plain' | 'warn' | 'bad';

/** A message in the page. Bad news is announced at once, the rest politely; `still` is for what was there from the start. */
export function Notice(props: { tone?: Tone; still?: boolean; children: ComponentChildren }) {
  const tone = props.tone ?? 'plain';
  return (
    <div class={`notice ${tone}`} role={props.still ? undefined : tone === 'bad' ? 'alert' : 'status'}>
      <Icon name={tone === 'plain' ? 'info' : 'warn'} />
      <div>{props.children}</div>
    </div>
  );
}

/** What is shown while something is on its way. */
export function Waiting({ what }: { what: string }) {
  return (
    <p class="row soft" role="status">
      <span class="spinner" />
      {what}
    </p>
  );
}

/** A bar with its share in words beside it. */
export function Bar({ share, label }: { share: number; label: string }) {
  const now = Math.round(100 * Math.min(1, Math.max(0, share)));
  return (
    <div
      class="bar"
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={now}
    >
      <span style={{ width: `${now}%` }} />
    </div>
  );
}
