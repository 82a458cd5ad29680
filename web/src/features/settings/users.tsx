// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { Choice, TextField } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { without } from '../../lib/draft';
import { useLoaded } from '../../lib/loaded';
import { personRoles, roleWord } from './role_words';

export function Users() {
  const users = useLoaded(calls.users);
  return (
    <section class="card stack" aria-labelledby="users">
      <h2 id="users">People</h2>
      <Loading of={users} what="The people">
        {(answer) => (
          <ul class="list">
            {answer.users.map((one) => (
              <li key={one.id}>
                <strong>{one.name}</strong>
                <span class="pill">{roleWord(one.role)}</span>
              </li>
            ))}
          </ul>
        )}
      </Loading>
      <AddUser onAdded={users.again} />
    </section>
  );
}

function AddUser({ onAdded }: { onAdded: () => void }) {
  const [name, setName] = useState('');
  const [password, setPassword] = useState('');
  const [role, setRole] = useState<string>('rider');
  const [added, setAdded] = useState<string | null>(null);
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    const wanted = personRoles.find((one) => one.value === role)?.value ?? 'viewer';
    setAdded(null);
    run(async () => {
      await calls.addUser({ name: name.trim(), password, role: wanted });
      setAdded(name.trim());
      setName(without(name));
      setPassword(without(password));
      onAdded();
    });
  };
  return (
    <form class="stack divided" onSubmit={submit}>
      <h3>Add a person</h3>
      <div class="form-columns">
        <TextField label="Name" value={name} onInput={setName} />
        <TextField
          label="First password"
          type="password"
          value={password}
          onInput={setPassword}
          autocomplete="new-password"
          minLength={8}
          maxLength={1000}
          hint="At least 8 characters."
        />
        <Choice label="Role" value={role} onChange={setRole} options={personRoles} />
      </div>
      <div class="row">
        <button
          type="submit"
          class="button main"
          disabled={busy || name.trim() === '' || password.length < 8}
        >
          {busy ? 'Adding …' : 'Add'}
        </button>
      </div>
      {added !== null && <Notice>{added} can sign in now.</Notice>}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </form>
  );
}
