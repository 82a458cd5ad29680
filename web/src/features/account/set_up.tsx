// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { findOutWho } from '../../api/server';
import { Brand } from '../../components/brand';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { navigate } from '../../lib/router';
import { tokenIn } from './setup_token';

/** The page of the link that the server prints at its first start: it makes the first account. */
export function SetUp() {
  const [token, setToken] = useState(tokenIn(location.hash, location.search));
  const [asked] = useState(token === '');
  const [name, setName] = useState('');
  const [password, setPassword] = useState('');
  const [again, setAgain] = useState('');
  const { busy, problem, run } = useCommand();
  const differs = again !== '' && again !== password;

  const submit = (event: Event) => {
    event.preventDefault();
    if (password !== again) return;
    run(async () => {
      await calls.setUp({ token: token.trim(), name: name.trim(), password });
      navigate('/robots', true);
      await findOutWho();
    });
  };
  return (
    <div class="alone">
      <main>
        <Brand />
        <form class="card stack" onSubmit={submit}>
          <h1>Welcome</h1>
          <p class="soft">
            Make the first account of this house. It may do everything, also add people later.
          </p>
          {asked && (
            <TextField
              label="Set-up code"
              value={token}
              onInput={setToken}
              hint="The part after # in the link that the server printed."
            />
          )}
          <TextField label="Your name" value={name} onInput={setName} autocomplete="username" />
          <TextField
            label="Password"
            type="password"
            value={password}
            onInput={setPassword}
            autocomplete="new-password"
            minLength={8}
            maxLength={1000}
            hint="At least 8 characters."
          />
          <TextField
            label="Password again"
            type="password"
            value={again}
            onInput={setAgain}
            autocomplete="new-password"
            maxLength={1000}
          />
          {differs && <Notice tone="warn">The two passwords differ.</Notice>}
          {problem && (
            <Notice tone="bad">
              {problem.status === 403
                ? 'This set-up link is not valid (any more). Use the newest one that the server printed.'
                : problem.message}
            </Notice>
          )}
          <button type="submit" class="button main" disabled={busy || differs}>
            {busy ? 'Making the account …' : 'Make the account'}
          </button>
        </form>
      </main>
    </div>
  );
}
