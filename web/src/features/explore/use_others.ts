// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { connection } from '../../api/server';
import type { Exploration } from '../../api/types';
import { robots } from '../../lib/chosen';
import type { Party } from './together_words';

/** The other robots of the house with their explorations: as the events tell, and as the server answers before they do. */
export function useOthers(own: string): Party[] {
  const { server } = connection.value;
  const others = robots.value.filter((one) => one.id !== own);
  const online = JSON.stringify(others.flatMap((one) => (one.online ? [one.id] : [])));
  const since = server?.since;
  const [asked, setAsked] = useState<Readonly<Record<string, Exploration | null>>>({});
  useEffect(() => {
    let wanted = true;
    const answer = (id: string, value: Exploration | null) => {
      if (wanted) setAsked((before) => ({ ...before, [id]: value }));
    };
    // One that told of none answers 404; of one that cannot be asked nothing is known either.
    for (const id of JSON.parse(online) as string[])
      calls.exploration(id).then(
        (value) => answer(id, value),
        () => answer(id, null),
      );
    return () => {
      wanted = false;
    };
  }, [online, since]);
  return others.map((robot) => ({
    robot,
    exploration: server?.explorations[robot.id] ?? asked[robot.id] ?? null,
  }));
}
