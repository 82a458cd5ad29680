// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from 'preact';
import { Section } from '../../components/section';
import type { Editor } from './editor';
import { Outcome } from './outcome';

interface Props {
  title: string;
  part: string;
  editor: Editor;
  children: ComponentChildren;
}

/** A kind of change that opens on a press, and says below what became of the latest one. */
export function EditSection({ title, part, editor, children }: Props) {
  const outcome = editor.outcomeIn(part);
  return (
    <Section title={title}>
      {children}
      {outcome && <Outcome of={outcome} />}
    </Section>
  );
}
