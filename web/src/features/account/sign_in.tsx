// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { me, wasSignedOut } from '../../api/server';
import { Brand } from '../../components/brand';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';

export function SignIn() {
  const [name, setName] = useState('');
  const [password, setPassword] = useState('');
  const [fresh, setFresh] = useState(false);
  const { busy, problem, run } = useCommand();
  useEffect(() => {
    calls.setupNeeded().then(
      ({ needed }) => setFresh(needed),
      () => undefined, // signing in will tell what is wrong
    );
  }, []);

  const submit = (event: Event) => {
    event.preventDefault();
    run(async () => {
      me.value = (await calls.logIn({ name: name.trim(), password })).user;
      wasSignedOut.value = false;
    });
  };
  return (
    <div class="alone">
      <main>
        <Brand />
        <form class="card stack" onSubmit={submit}>
          <h1>Sign in</h1>
          {fresh && (
            <Notice tone="warn" still>
              This house has no account yet. Open the link that the server printed when it was first started.
            </Notice>
          )}
          {wasSignedOut.value && (
            <Notice tone="warn">
              You were signed out. To stop the chair meanwhile, use the stop button on the chair itself.
            </Notice>
          )}
          <TextField label="Your name" value={name} onInput={setName} autocomplete="username" />
          <TextField
            label="Password"
            type="password"
            value={password}
            onInput={setPassword}
            autocomplete="current-password"
            maxLength={1000}
          />
          {problem && (
            <Notice tone="bad">
              {problem.status === 401 ? 'The name or the password is not right.' : problem.message}
            </Notice>
          )}
          <button type="submit" class="button main" disabled={busy}>
            {busy ? 'Signing in …' : 'Sign in'}
          </button>
        </form>
      </main>
    </div>
  );
}
