// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import { Notice } from './notice';

/** A token that is shown this once, to be copied. */
export function SecretOnce({ title, token, onClose }: { title: string; token: string; onClose: () => void }) {
  const [copied, setCopied] = useState<boolean | null>(null);
  const copy = () => {
    // The clipboard exists on secure origins only; elsewhere the text is selected by a press on it.
    const clipboard = navigator.clipboard as Clipboard | undefined;
    if (!clipboard) {
      setCopied(false);
      return;
    }
    clipboard.writeText(token).then(
      () => setCopied(true),
      () => setCopied(false),
    );
  };
  return (
    <Notice tone="warn">
      <div class="stack">
        <p>
          <strong>{title}</strong> Keep it now: it is not shown again.
        </p>
        <code class="secret" tabIndex={0} aria-label="Token" data-testid="secret">
          {token}
        </code>
        <div class="row">
          <button type="button" class="button main" onClick={copy}>
            Copy
          </button>
          <button type="button" class="button" onClick={onClose}>
            I have kept it
          </button>
          <span role="status">
            {copied === true && 'Copied.'}
            {copied === false && 'Please select the text and copy it.'}
          </span>
        </div>
      </div>
    </Notice>
  );
}
