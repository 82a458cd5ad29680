// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { Place } from '../../api/types';
import { Choice } from '../../components/field';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';
import { EditSection } from './edit_section';
import type { Editor } from './editor';
import { PictureChoice } from './picture_choice';
import { PlacePicker } from './place_picker';

const kPart = 'take-out';

/** Pictures that do not show this place: they become a place of their own, or go to another. */
export function TakeOut({ editor, place }: { editor: Editor; place: Place }) {
  const { graph, busy } = editor;
  const [ticked, setTicked] = useState<ReadonlySet<string>>(new Set());
  const [where, setWhere] = useState('new');
  const [into, setInto] = useState<string | null>(null);
  const images = place.members.filter((one) => ticked.has(one));
  const all = images.length === place.members.length;
  const pictures = count(images.length, 'picture');
  const ready = images.length > 0 && !all && (where === 'new' || into !== null);
  const act = () => {
    if (where === 'new')
      editor.edit(
        kPart,
        [{ kind: 'split', place: place.id, images }],
        images.length === 1
          ? '1 picture is a place of its own now.'
          : `${pictures} are a place of their own now.`,
      );
    else if (into !== null)
      editor.edit(kPart, [{ kind: 'move', images, into }], `${pictures} went to ${placeTitle(graph, into)}.`);
    setTicked(new Set());
  };
  return (
    <EditSection title="Take pictures out" part={kPart} editor={editor}>
      <p class="soft small">When some of the pictures were taken somewhere else in the house.</p>
      <PictureChoice
        map={graph.map}
        legend="Pictures that leave"
        images={place.members}
        chosen={ticked}
        several
        onChoose={setTicked}
      />
      <Choice
        label="Where they belong"
        value={where}
        onChange={setWhere}
        options={[
          { value: 'new', label: 'To a place of their own' },
          { value: 'other', label: 'To another place' },
        ]}
      />
      {where === 'other' && (
        <PlacePicker
          graph={graph}
          from={place.id}
          legend="Place to move them to"
          chosen={into}
          onChoose={setInto}
        />
      )}
      {all && (
        <p class="soft" role="status">
          At least one picture has to stay. To give all away, join the place with the other one.
        </p>
      )}
      <p>
        <button type="button" class="button main" disabled={busy || !ready} onClick={act}>
          {where === 'new' ? 'Make a place of them' : 'Move them'}
        </button>
      </p>
    </EditSection>
  );
}
