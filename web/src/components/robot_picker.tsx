// SPDX-License-Identifier: Apache-2.0
import { choose, chosen, robots } from '../lib/chosen';

/** Which robot the page is about; nothing while there is only one. */
export function RobotPicker() {
  if (robots.value.length < 2) return null;
  return (
    <div class="segments" role="group" aria-label="Robot">
      {robots.value.map((one) => (
        <button
          key={one.id}
          type="button"
          aria-pressed={one.id === chosen.value?.id}
          onClick={() => choose(one.id)}
        >
          {one.name}
        </button>
      ))}
    </div>
  );
}
