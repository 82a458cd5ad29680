// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import { now_ms } from '../../api/server';
import { chosen, robots } from '../../lib/chosen';
import { followStops, stop, stopState } from './stop';
import { stopWords } from './stop_words';

function stopChosen(): void {
  const robot = chosen.peek();
  if (robot) void stop(robot.id);
}

/** STOP: on every page, by press or by Escape from anywhere, also out of a field. */
export function StopButton() {
  useEffect(followStops, []);
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== 'Escape' || event.repeat) return;
      event.preventDefault();
      stopChosen();
    };
    addEventListener('keydown', onKey, { capture: true });
    return () => removeEventListener('keydown', onKey, { capture: true });
  }, []);

  const robot = chosen.value;
  if (!robot) return null;
  const state = stopState.value;
  const stopped =
    state.kind === 'ready' ? null : (robots.value.find((one) => one.id === state.robot) ?? null);
  const words = stopWords(state, stopped, now_ms.value);
  return (
    <section class="stop-dock" aria-label="Stop">
      <p class={words?.bad ? 'stop-word bad' : 'stop-word'} role="alert" data-testid="stop-word">
        {words?.text}
      </p>
      <button type="button" class="stop" onClick={stopChosen} aria-keyshortcuts="Escape">
        STOP
        {robots.value.length > 1 ? (
          <small>{robot.name}</small>
        ) : (
          <small>
            <span class="for-keys">or press Esc</span>
            <span class="for-touch">{robot.name}</span>
          </small>
        )}
      </button>
    </section>
  );
}
