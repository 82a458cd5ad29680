// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import { connection, me } from '../../api/server';
import { useCommand } from '../../lib/command';
import { Notice } from '../../components/notice';
import { atLeast } from '../../lib/roles';
import { releaseAll } from '../go/driving';
import { roleWord } from './role_words';
import { Tokens } from './tokens';
import { Users } from './users';

export function SettingsPage() {
  const user = me.value;
  if (!user) return null;
  return (
    <>
      <h1>Settings</h1>
      <Account />
      {atLeast(user.role, 'admin') && <Users />}
      {atLeast(user.role, 'installer') && <Tokens />}
      <p class="soft small">House server build: {connection.value.server?.build ?? 'unknown'}</p>
    </>
  );
}

function Account() {
  const { busy, problem, run } = useCommand();
  const user = me.value;
  const signOut = () =>
    run(async () => {
      await releaseAll();
      await calls.logOut();
      me.value = null;
    });
  return (
    <section class="card stack" aria-labelledby="account">
      <h2 id="account">Your account</h2>
      <div class="row apart">
        <p>
          Signed in as <strong>{user?.name}</strong>{' '}
          <span class="pill">{user ? roleWord(user.role) : ''}</span>
        </p>
        <button type="button" class="button" disabled={busy} onClick={signOut}>
          Sign out
        </button>
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </section>
  );
}
