// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Robot } from '../../api/types';
import { Icon } from '../../components/icons';

const kPeriodMs = 600;
const kRetryMs = 3000;

/** What the robot sees, asked for again when the last picture is there; rests while the page is hidden. */
export function LivePicture({ robot }: { robot: Robot }) {
  const [n, setN] = useState(() => Date.now());
  const [seen, setSeen] = useState(false);
  const timer = useRef<ReturnType<typeof setTimeout>>();
  useEffect(() => () => clearTimeout(timer.current), []);

  const next = (delay_ms: number) => {
    clearTimeout(timer.current);
    timer.current = setTimeout(() => {
      if (document.hidden) next(kRetryMs);
      else setN((last) => last + 1);
    }, delay_ms);
  };
  return (
    <div>
      {robot.online && (
        <img
          class="picture live"
          hidden={!seen}
          src={calls.frameUrl(robot.id, n)}
          alt={`What ${robot.name} sees now`}
          onLoad={() => {
            setSeen(true);
            next(kPeriodMs);
          }}
          onError={() => {
            setSeen(false);
            next(kRetryMs);
          }}
        />
      )}
      {(!robot.online || !seen) && (
        <div class="picture live no-picture">
          <Icon name={robot.online ? 'tours' : 'warn'} size={48} />
          <span>{robot.online ? 'No picture yet' : 'No picture: not connected'}</span>
        </div>
      )}
    </div>
  );
}
