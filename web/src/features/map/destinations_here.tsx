// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Destination, Place } from '../../api/types';
import { TextField } from '../../components/field';
import { Section } from '../../components/section';
import { SureButton } from '../../components/sure_button';
import { useDraft } from '../../lib/draft';
import { indexOf } from '../../lib/graph_index';
import { useWished } from '../../lib/wished';
import { inSentence, titled } from '../../lib/words';
import { EditSection } from './edit_section';
import type { Editor } from './editor';
import { PictogramPicker } from './pictogram_picker';
import { PictureChoice } from './picture_choice';

const kPart = 'destinations';
const kAddPart = 'add-destination';

interface Props {
  editor: Editor;
  place: Place;
}

/** What riders can be sent to at this place: names, signs, and the picture that the chair comes to stand as. */
export function DestinationsHere({ editor, place }: Props) {
  const here = indexOf(editor.graph).destinations_at.get(place.id) ?? [];
  return (
    <EditSection title={`Destinations here: ${here.length}`} part={kPart} editor={editor}>
      {here.length === 0 && (
        <p class="soft">None. Riders can be sent here once the place has a name or a destination.</p>
      )}
      <ul class="stack">
        {here.map((one) => (
          <li key={one.id} class="stack tight">
            <OneDestination editor={editor} place={place} destination={one} />
          </li>
        ))}
      </ul>
    </EditSection>
  );
}

function OneDestination({ editor, place, destination }: Props & { destination: Destination }) {
  const { graph, busy } = editor;
  const { id, image, label, pictogram } = destination;
  const { text, type } = useDraft(label);
  const refused = (editor.outcomeIn(kPart)?.problem ?? null) !== null;
  const [sign, wishSign] = useWished(pictogram, refused);
  const [picture, wishPicture] = useWished(image, refused);
  const title = titled(label);
  const wanted = inSentence(text);
  return (
    <>
      <p class="row">
        <img class="small-picture" src={calls.imageThumbnailUrl(graph.map, image)} alt="" loading="lazy" />
        <strong>{title}</strong>
      </p>
      <form
        class="rename"
        onSubmit={(event) => {
          event.preventDefault();
          if (wanted !== '')
            editor.edit(
              kPart,
              [{ kind: 'name_destination', destination: id, label: wanted }],
              `The destination is called ${wanted} now.`,
            );
        }}
      >
        <TextField label={`Name of the destination ${title}`} value={text} onInput={type} />
        <button type="submit" class="button" disabled={busy || wanted === '' || wanted === inSentence(label)}>
          Save
        </button>
      </form>
      <Section title="Its sign" about={`of ${title}`} heading={false}>
        <PictogramPicker
          label={label}
          value={sign}
          disabled={busy}
          onChoose={(name) => {
            wishSign(name);
            editor.edit(
              kPart,
              [{ kind: 'set_pictogram', destination: id, pictogram: name }],
              name === '' ? `${title} shows the sign of its name.` : `${title} shows another sign now.`,
            );
          }}
        />
      </Section>
      <Section title="Where the chair stands" about={`at ${title}`} heading={false}>
        <PictureChoice
          map={graph.map}
          legend="It comes to stand, and turns, as this picture was taken"
          images={place.members}
          chosen={new Set([picture])}
          several={false}
          onChoose={(chosen) => {
            const [wish] = [...chosen];
            if (wish === undefined || wish === image || busy) return;
            wishPicture(wish);
            editor.edit(
              kPart,
              [{ kind: 'set_destination_picture', destination: id, image: wish }],
              `The chair comes to stand at ${title} as in that picture now.`,
            );
          }}
        />
      </Section>
      <p>
        <SureButton
          label="Remove"
          about={`the destination ${title}`}
          question={`Remove ${title} from what riders can choose?`}
          disabled={busy}
          onSure={() =>
            editor.edit(
              kPart,
              [{ kind: 'remove_destination', destination: id }],
              `${title} is no destination any more.`,
            )
          }
        />
      </p>
    </>
  );
}

/** A further destination at this place. */
export function AddDestination({ editor, place }: Props) {
  const { graph, busy } = editor;
  const [label, setLabel] = useState('');
  const [picked, setPicked] = useState<ReadonlySet<string>>(new Set());
  const taken = new Set(graph.destinations.map((one) => one.image));
  const free = place.members.filter((one) => !taken.has(one));
  const [image] = free.filter((one) => picked.has(one));
  const wanted = inSentence(label);
  return (
    <EditSection title="Add a destination" part={kAddPart} editor={editor}>
      <p class="soft small">Riders then find a card with this name and picture under Go.</p>
      <form
        class="stack"
        onSubmit={(event) => {
          event.preventDefault();
          if (image === undefined) return;
          editor.edit(
            kAddPart,
            [{ kind: 'add_destination', image, label: wanted }],
            `Riders can be sent to ${wanted} now.`,
          );
          setLabel('');
          setPicked(new Set());
        }}
      >
        <TextField label="Name of the new destination" value={label} onInput={setLabel} />
        {free.length === 0 ? (
          <p class="soft">Each picture of this place is a destination already.</p>
        ) : (
          <PictureChoice
            map={graph.map}
            legend="The chair comes to stand, and turns, as this picture was taken"
            images={free}
            chosen={picked}
            several={false}
            onChoose={setPicked}
          />
        )}
        <p>
          <button type="submit" class="button main" disabled={busy || image === undefined || wanted === ''}>
            Add the destination
          </button>
        </p>
      </form>
    </EditSection>
  );
}
