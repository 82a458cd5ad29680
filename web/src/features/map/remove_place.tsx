// SPDX-License-Identifier: Apache-2.0
import type { Place } from '../../api/types';
import { SureButton } from '../../components/sure_button';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { EditSection } from './edit_section';
import { kHistoryPart, type Editor } from './editor';

const kPart = 'remove-place';

export function RemovePlace({ editor, place }: { editor: Editor; place: Place }) {
  const { graph, busy } = editor;
  const title = placeTitle(graph, place.id);
  const ways = new Set(indexOf(graph).neighbours.get(place.id) ?? []).size;
  const goals = indexOf(graph).destinations_at.get(place.id)?.length ?? 0;
  const also = [count(ways, 'way'), ...(goals > 0 ? [count(goals, 'destination')] : [])].join(' and ');
  return (
    <EditSection title="Remove this place" part={kPart} editor={editor}>
      <p class="soft small">
        The chair does not drive here any more. {also} here {ways + goals === 1 ? 'goes' : 'go'} with it. It
        can be taken back below, under Changes by people.
      </p>
      <p>
        <SureButton
          label="Remove"
          about={`the place ${title}`}
          question={`Remove ${title} from the map?`}
          disabled={busy}
          onSure={() =>
            editor.edit(kPart, [{ kind: 'delete', place: place.id }], `${title} was removed.`, {
              choose: null,
              told_in: kHistoryPart,
            })
          }
        />
      </p>
    </EditSection>
  );
}
