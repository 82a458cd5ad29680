// SPDX-License-Identifier: Apache-2.0
import type { Place } from '../../api/types';
import { TextField } from '../../components/field';
import { useDraft } from '../../lib/draft';
import { nameOf } from '../../lib/whereabouts';
import { inSentence } from '../../lib/words';
import { kPlacePart, type Editor } from './editor';

export function RenamePlace({ editor, place }: { editor: Editor; place: Place }) {
  const present = nameOf(editor.graph, place.id) ?? '';
  const { text, type, newer } = useDraft(present);
  const wanted = inSentence(text);
  return (
    <form
      class="rename"
      onSubmit={(event) => {
        event.preventDefault();
        if (wanted !== present)
          editor.edit(
            kPlacePart,
            [{ kind: 'rename', place: place.id, label: wanted }],
            wanted ? `Named ${wanted}.` : 'Name removed.',
          );
      }}
    >
      <TextField label="Name" value={text} onInput={type} required={false} />
      <button type="submit" class="button" disabled={editor.busy || wanted === present}>
        {editor.busy ? 'Saving …' : 'Save'}
      </button>
      <p class="rename-news soft small" role="status">
        {newer &&
          (present === ''
            ? 'Somebody has taken the name away meanwhile.'
            : `Somebody has named this place “${present}” meanwhile.`)}
      </p>
    </form>
  );
}
