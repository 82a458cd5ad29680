// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Place } from '../../api/types';
import { placeTitle } from '../../lib/whereabouts';
import { EditSection } from './edit_section';
import type { Editor } from './editor';
import { PlacePicker } from './place_picker';

const kPart = 'add-way';

/** A way that no tour drove and that a person knows of. */
export function AddWay({ editor, place }: { editor: Editor; place: Place }) {
  const { graph, busy } = editor;
  const [to, setTo] = useState<string | null>(null);
  return (
    <EditSection title="Add a way" part={kPart} editor={editor}>
      <p class="soft small">
        When the chair can drive straight from here to another place, and both can be seen from each other.
      </p>
      <PlacePicker
        graph={graph}
        from={place.id}
        legend="Where the way leads to"
        chosen={to}
        onChoose={setTo}
      />
      <p>
        <button
          type="button"
          class="button main"
          disabled={busy || to === null}
          onClick={() =>
            to !== null &&
            editor.edit(
              kPart,
              [{ kind: 'add_edge', from: place.id, to }],
              `There is a way to ${placeTitle(graph, to)} now.`,
            )
          }
        >
          Add the way
        </button>
      </p>
    </EditSection>
  );
}
