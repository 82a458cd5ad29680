// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { TokenInfo } from '../../api/types';
import { Choice, TextField } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { SecretOnce } from '../../components/secret_once';
import { SureButton } from '../../components/sure_button';
import { robots } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { without } from '../../lib/draft';
import { useLoaded } from '../../lib/loaded';
import { roleWord, tokenRoles } from './role_words';

export function Tokens() {
  const tokens = useLoaded(calls.tokens);
  return (
    <section class="card stack" aria-labelledby="tokens">
      <h2 id="tokens">Tokens for programs and robots</h2>
      <Loading of={tokens} what="The tokens">
        {(answer) =>
          answer.tokens.length === 0 ? (
            <p class="soft">There are none.</p>
          ) : (
            <ul class="list">
              {answer.tokens.map((one) => (
                <TokenRow key={one.id} token={one} onRemoved={tokens.again} />
              ))}
            </ul>
          )
        }
      </Loading>
      <AddToken onAdded={tokens.again} />
    </section>
  );
}

function TokenRow({ token, onRemoved }: { token: TokenInfo; onRemoved: () => void }) {
  const { busy, problem, run } = useCommand();
  const robot = robots.value.find((one) => one.id === token.robot)?.name ?? token.robot;
  const remove = () =>
    run(async () => {
      await calls.removeToken(token.id);
      onRemoved();
    });
  return (
    <li>
      <span>
        <strong>{token.name}</strong> <span class="pill">{roleWord(token.role)}</span>
        {robot !== null && <span class="soft"> for {robot}</span>}
      </span>
      <SureButton
        label="Revoke"
        about={token.name}
        question="Revoke it? What uses it is locked out at once."
        disabled={busy}
        onSure={remove}
      />
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </li>
  );
}

function AddToken({ onAdded }: { onAdded: () => void }) {
  const [name, setName] = useState('');
  const [role, setRole] = useState<string>('robot');
  const [robot, setRobot] = useState('');
  const [made, setMade] = useState<{ name: string; token: string } | null>(null);
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    const wanted = tokenRoles.find((one) => one.value === role)?.value ?? 'viewer';
    const bound = wanted === 'robot' && robot !== '' ? { robot } : {};
    run(async () => {
      const { token } = await calls.addToken({ name: name.trim(), role: wanted, ...bound });
      setMade({ name: name.trim(), token });
      setName(without(name));
      onAdded();
    });
  };
  return (
    <form class="stack divided" onSubmit={submit}>
      <h3>Add a token</h3>
      {made && (
        <SecretOnce title={`The token ${made.name}.`} token={made.token} onClose={() => setMade(null)} />
      )}
      <div class="form-columns">
        <TextField label="What it is for" value={name} onInput={setName} />
        <Choice label="Role" value={role} onChange={setRole} options={tokenRoles} />
        {role === 'robot' && (
          <Choice
            label="Robot"
            value={robot}
            onChange={setRobot}
            options={[
              { value: '', label: 'None: it only sends tours' },
              ...robots.value.map((one) => ({ value: one.id, label: one.name })),
            ]}
          />
        )}
      </div>
      <div class="row">
        <button type="submit" class="button main" disabled={busy || name.trim() === ''}>
          {busy ? 'Making …' : 'Make a token'}
        </button>
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </form>
  );
}
