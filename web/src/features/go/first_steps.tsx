// SPDX-License-Identifier: Apache-2.0
import { me } from '../../api/server';
import { Icon } from '../../components/icons';
import { Notice } from '../../components/notice';
import { maps, robots } from '../../lib/chosen';
import { atLeast } from '../../lib/roles';
import { follow } from '../../lib/router';

/** What a new house still needs before a chair can be sent, with where to do it. */
export function FirstSteps() {
  if (!atLeast(me.value?.role, 'installer'))
    return <Notice still>The chair is not set up yet. Somebody who may install things does that.</Notice>;
  const steps = [
    {
      done: maps.value.length > 0,
      to: '/tours',
      what: 'Add a tour: pictures of one drive through the house',
    },
    { done: maps.value.some((one) => one.state === 'ready'), to: '/tours', what: 'Build a map from it' },
    { done: robots.value.length > 0, to: '/robots', what: 'Add the robot, and give its program the token' },
    { done: robots.value.some((one) => one.map !== null), to: '/robots', what: 'Choose its map' },
  ];
  return (
    <section class="card stack" aria-labelledby="first-steps">
      <h2 id="first-steps">First steps</h2>
      <ol class="list">
        {steps.map((one) => (
          <li key={one.what}>
            <span class="row">
              {one.done ? <Icon name="done" /> : <Icon name="info" />}
              {one.what}
              {one.done && <span class="hidden-text"> (done)</span>}
            </span>
            {!one.done && (
              <a class="button" href={one.to} onClick={follow}>
                {one.to === '/tours' ? 'To Tours' : 'To Robots'}
                <span class="hidden-text">: {one.what}</span>
              </a>
            )}
          </li>
        ))}
      </ol>
    </section>
  );
}
