// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from 'preact/hooks';

interface Props {
  label: string; // what the button does
  about: string; // to what, for those who do not see what it stands beside
  question: string;
  leave?: string; // the button that changes nothing
  disabled?: boolean;
  plain?: boolean; // nothing to be feared: it only takes effect at once
  onSure: () => void;
}

/** A button for what cannot be taken back, or takes effect at once: asks once, in place. */
export function SureButton({ label, about, question, leave = 'Keep', disabled, plain, onSure }: Props) {
  const look = plain ? 'button main' : 'button danger';
  const [asking, setAsking] = useState(false);
  const keep = useRef<HTMLButtonElement>(null);
  // Once: whoever has moved on to the other button stays there.
  useEffect(() => keep.current?.focus(), [asking]);
  if (!asking)
    return (
      <button
        type="button"
        class={look}
        disabled={disabled}
        aria-label={`${label} ${about}`}
        onClick={() => setAsking(true)}
      >
        {label}
      </button>
    );
  return (
    <span class="row" role="group" aria-label={question}>
      <strong role="alert">{question}</strong>
      <button
        type="button"
        class={look}
        onClick={() => {
          setAsking(false);
          onSure();
        }}
      >
        {label}
      </button>
      <button type="button" class="button" onClick={() => setAsking(false)} ref={keep}>
        {leave}
      </button>
    </span>
  );
}
