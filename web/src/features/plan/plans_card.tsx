// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { PlanInfo } from '../../api/types';
import { TextField } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { Section } from '../../components/section';
import { SureButton } from '../../components/sure_button';
import { maps } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { useDraft, without } from '../../lib/draft';
import { useLoaded } from '../../lib/loaded';
import { dateText } from '../../lib/words';
import { PlanFileFields, usePlanFile } from './plan_file_fields';
import { sizeWords } from './plan_words';

/** Plans of the building: what there is, and for who may install things a way to add more. */
export function PlansCard({ mayInstall }: { mayInstall: boolean }) {
  const plans = useLoaded(calls.plans);
  return (
    <section class="card stack" aria-labelledby="plan-list">
      <h2 id="plan-list">Floor plans</h2>
      <Loading of={plans} what="The floor plans">
        {(answer) => (
          <>
            {answer.plans.length === 0 && <p class="soft">There is no plan of the building yet.</p>}
            <ul class="list">
              {answer.plans.map((one) => (
                <PlanRow key={one.id} plan={one} mayInstall={mayInstall} onChanged={plans.again} />
              ))}
            </ul>
          </>
        )}
      </Loading>
      {mayInstall && <AddPlan onAdded={plans.again} />}
    </section>
  );
}

interface RowProps {
  plan: PlanInfo;
  mayInstall: boolean;
  onChanged: () => void;
}

function PlanRow({ plan, mayInstall, onChanged }: RowProps) {
  const { busy, problem, run } = useCommand();
  const newest = plan.versions.at(-1);
  // As the events have it, which tell of maps at once.
  const tied = maps.value.filter((one) => one.plan?.id === plan.id).map((one) => one.name);
  const remove = () =>
    run(async () => {
      await calls.removePlan(plan.id);
      onChanged();
    });
  return (
    <li>
      <div>
        <strong>{plan.name}</strong>
        {newest && (
          <p class="soft small">
            {newest.version > 1 && `Version ${newest.version}, `}
            {sizeWords(newest)}, {dateText(newest.created_us)}
          </p>
        )}
        {tied.length > 0 && <p class="soft small">Under {tied.join(', ')}</p>}
      </div>
      <div class="row">
        <a class="button" href={calls.planFileUrl(plan.id)} download>
          Save<span class="hidden-text"> {plan.name} as a file</span>
        </a>
        {mayInstall && (
          <SureButton
            label="Remove"
            about={plan.name}
            question="Remove this plan?"
            disabled={busy}
            onSure={remove}
          />
        )}
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
      {mayInstall && (
        <div class="build">
          <Section title="Change" about={plan.name} heading={false}>
            <RenamePlan plan={plan} onRenamed={onChanged} />
            <AddVersion plan={plan} onAdded={onChanged} />
          </Section>
        </div>
      )}
    </li>
  );
}

function RenamePlan({ plan, onRenamed }: { plan: PlanInfo; onRenamed: () => void }) {
  const { text, type } = useDraft(plan.name);
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    run(async () => {
      await calls.renamePlan(plan.id, text.trim());
      onRenamed();
    });
  };
  return (
    <form class="stack tight" onSubmit={submit}>
      <TextField label="Name" value={text} onInput={type} />
      <p>
        <button
          type="submit"
          class="button"
          disabled={busy || text.trim() === '' || text.trim() === plan.name}
        >
          {busy ? 'Renaming …' : 'Rename'}
        </button>
      </p>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </form>
  );
}

function AddVersion({ plan, onAdded }: { plan: PlanInfo; onAdded: () => void }) {
  const file = usePlanFile();
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    run(async () => {
      if (!file.upload) return;
      await calls.addPlanVersion(plan.id, file.upload);
      file.clear();
      onAdded();
    });
  };
  return (
    <form class="stack tight" onSubmit={submit} aria-label={`Another version of ${plan.name}`}>
      <PlanFileFields file={file} label="Another version of it" />
      <p>
        <button type="submit" class="button" disabled={busy || !file.upload}>
          {busy ? 'Uploading …' : 'Upload this version'}
        </button>
      </p>
      {problem && <Notice tone="bad">{refusal(problem)}</Notice>}
    </form>
  );
}

function AddPlan({ onAdded }: { onAdded: () => void }) {
  const [name, setName] = useState('');
  const file = usePlanFile();
  const { busy, problem, run } = useCommand();
  const submit = (event: Event) => {
    event.preventDefault();
    run(async () => {
      if (!file.upload) return;
      await calls.addPlan(name.trim(), file.upload);
      setName(without(name));
      file.clear();
      onAdded();
    });
  };
  return (
    <form class="stack divided" onSubmit={submit} aria-labelledby="add-plan">
      <h3 id="add-plan">Add a floor plan</h3>
      <TextField label="Name of the plan" value={name} onInput={setName} />
      <PlanFileFields file={file} label="File" />
      <p class="row">
        <button type="submit" class="button main" disabled={busy || name.trim() === '' || !file.upload}>
          {busy ? 'Uploading …' : 'Upload the plan'}
        </button>
        {/* There from the start, so that screen readers tell when it changes. */}
        <span class="row soft" role="status">
          {busy && (
            <>
              <span class="spinner" />
              The plan is sent and read.
            </>
          )}
        </span>
      </p>
      {problem && <Notice tone="bad">{refusal(problem)}</Notice>}
    </form>
  );
}

/** Why a file was refused, and where in it. */
function refusal({ message, where }: { message: string; where?: string }): string {
  const line = /(?:line |:)(\d+)$/.exec(where ?? '')?.[1];
  return line === undefined || message.includes(`line ${line}`)
    ? message
    : `${message} Line ${line} of the file.`;
}
