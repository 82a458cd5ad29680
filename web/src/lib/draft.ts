// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import { inSentence } from './words';

/** A text being written over one that others may change. */
export interface Draft {
  text: string;
  base: string; // what it is written over
}

/** What a new text underneath makes of a draft: it follows where nothing was typed, or where what was typed was saved. */
export function onto(draft: Draft, present: string): Draft {
  if (draft.base === present) return draft;
  const follows = draft.text === draft.base || inSentence(draft.text) === present;
  return follows ? { text: present, base: present } : draft;
}

/** What is left of a field's text when `sent` has arrived: what was typed into it since. For the setter of useState. */
export function without(sent: string): (now: string) => string {
  return (now) => (now === sent ? '' : now);
}

export interface DraftHandle {
  text: string;
  type: (text: string) => void;
  newer: boolean; // what is underneath was changed by others after the typing began
}

/** The draft of a field whose saved text is `present`. Give the component a key for whose text it is. */
export function useDraft(present: string): DraftHandle {
  const [kept, setKept] = useState<Draft>({ text: present, base: present });
  const draft = onto(kept, present);
  // Said while rendering: an effect would run after the next paint and show the old text until then.
  if (draft !== kept) setKept(draft);
  return {
    text: draft.text,
    type: (text) => setKept({ text, base: draft.base }),
    newer: draft.base !== present,
  };
}
