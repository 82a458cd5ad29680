// SPDX-License-Identifier: Apache-2.0
import { me } from '../api/server';
import type { Robot } from '../api/types';
import { Notice } from './notice';

interface Props {
  holder: string | null | undefined; // who drives, as far as that is known
  chair: string; // what they drive, as it is called here
  question: string;
  onTakeOver: () => void;
  onLeave: () => void;
}

/** Somebody else is driving: says who, and takes over only when asked to. */
export function LeasePrompt({ holder, chair, question, onTakeOver, onLeave }: Props) {
  const who = !holder || holder === me.value?.name ? 'Somebody else' : holder;
  return (
    <Notice tone="warn">
      <div class="stack">
        <p role="alert">
          <strong>
            {who} is driving {chair} just now.
          </strong>{' '}
          {question}
        </p>
        <div class="row">
          <button type="button" class="button main" onClick={onTakeOver}>
            Take over
          </button>
          <button type="button" class="button" onClick={onLeave}>
            Leave it to {who}
          </button>
        </div>
      </div>
    </Notice>
  );
}

/** Who drives, when it is somebody else. */
export function WhoDrives({ robot }: { robot: Robot }) {
  const holder = robot.lease?.holder;
  if (!holder || holder === me.value?.name) return null;
  return (
    <p class="soft small">
      {holder} is driving {robot.name}.
    </p>
  );
}
