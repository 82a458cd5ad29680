// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Robot } from '../../api/types';
import { Icon } from '../../components/icons';

const kPeriodMs = 700;
const kRetryMs = 3000;

/** What the robot sees, asked for again as soon as the last picture is there; rests while the page is hidden. */
export function LivePicture({ robot }: { robot: Robot }) {
  const [n, setN] = useState(0);
  const [shown, setShown] = useState(0); // the newest picture that was loaded; 0: none
  useEffect(() => {
    if (!robot.online) return;
    let timer: ReturnType<typeof setTimeout>;
    let wanted = true;
    const later = (delay_ms: number) => {
      if (wanted) timer = setTimeout(next, delay_ms);
    };
    let count = Date.now();
    const next = () => {
      if (document.hidden) {
        later(kRetryMs);
        return;
      }
      const asked = (count += 1);
      const image = new Image();
      image.onload = () => {
        if (!wanted) return;
        setN(asked);
        setShown(asked);
        later(kPeriodMs);
      };
      image.onerror = () => {
        if (!wanted) return;
        setShown(0);
        later(kRetryMs);
      };
      image.src = calls.frameUrl(robot.id, asked);
    };
    next();
    return () => {
      wanted = false;
      clearTimeout(timer);
    };
  }, [robot.id, robot.online]);

  if (!robot.online || shown === 0)
    return (
      <div class="picture live no-picture">
        <Icon name={robot.online ? 'tours' : 'warn'} size={48} />
        <span>{robot.online ? 'No picture yet' : 'No picture: not connected'}</span>
      </div>
    );
  return <img class="picture live" src={calls.frameUrl(robot.id, n)} alt={`What ${robot.name} sees now`} />;
}
