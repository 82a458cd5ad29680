// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';

interface Props {
  label: string; // what the button does
  about: string; // to what, for those who do not see what it stands beside
  question: string;
  disabled?: boolean;
  onSure: () => void;
}

/** A button for what cannot be taken back: asks once, in place. */
export function SureButton({ label, about, question, disabled, onSure }: Props) {
  const [asking, setAsking] = useState(false);
  if (!asking)
    return (
      <button
        type="button"
        class="button danger"
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
        class="button danger"
        onClick={() => {
          setAsking(false);
          onSure();
        }}
      >
        {label}
      </button>
      <button type="button" class="button" onClick={() => setAsking(false)} ref={(button) => button?.focus()}>
        Keep
      </button>
    </span>
  );
}
