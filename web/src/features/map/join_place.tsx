// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Place } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { nameOf, placeTitle, titlesApart } from '../../lib/whereabouts';
import { EditSection } from './edit_section';
import type { Editor } from './editor';
import { PlacePicker } from './place_picker';

const kPart = 'join';

/** Two places that are one: the name of either stays. */
export function JoinPlace({ editor, place }: { editor: Editor; place: Place }) {
  const { graph, busy } = editor;
  const [picked, setPicked] = useState<string | null>(null);
  const other = picked !== null && indexOf(graph).places.has(picked) ? picked : null;
  // The one with a name keeps it; of two, this one.
  const into =
    other !== null && nameOf(graph, other) !== null && nameOf(graph, place.id) === null ? other : place.id;
  const gone = into === place.id ? other : place.id;
  const [own, theirs] = titlesApart(graph, place.id, other ?? place.id);
  return (
    <EditSection title="Join with another place" part={kPart} editor={editor}>
      <p class="soft small">When two places of the map are one and the same spot in the house.</p>
      <PlacePicker
        graph={graph}
        from={place.id}
        legend="It is the same place as"
        chosen={other}
        onChoose={setPicked}
      />
      {other !== null && gone !== null && (
        <>
          <p>
            {own} and {theirs} become one place, called <strong>{placeTitle(graph, into)}</strong>, with the
            pictures and ways of both.
          </p>
          <p>
            <button
              type="button"
              class="button main"
              disabled={busy}
              onClick={() =>
                editor.edit(
                  kPart,
                  [{ kind: 'merge', place: gone, into }],
                  `${own} and ${theirs} are one place now.`,
                  {
                    choose: into,
                  },
                )
              }
            >
              Join the two
            </button>
          </p>
        </>
      )}
    </EditSection>
  );
}
