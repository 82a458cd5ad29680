// SPDX-License-Identifier: Apache-2.0
import { me } from '../../api/server';
import type { Robot } from '../../api/types';
import { Notice } from '../../components/notice';
import type { Command } from './journey';

interface Props {
  held: Extract<Command, { kind: 'held' }>;
  onTakeOver: () => void;
  onLeave: () => void;
}

/** Somebody else is driving: says who, and takes over only when asked to. */
export function LeasePrompt({ held, onTakeOver, onLeave }: Props) {
  const who = held.holder ?? 'Somebody else';
  return (
    <Notice tone="warn">
      <div class="stack">
        <p role="alert">
          <strong>{who} is driving the chair just now.</strong> Take over and go to {held.target.label}?
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
