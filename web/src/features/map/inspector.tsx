// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from 'preact/hooks';
import type { Draft, Place } from '../../api/types';
import { Notice } from '../../components/notice';
import { follow } from '../../lib/router';
import { placeTitle } from '../../lib/whereabouts';
import { AddWay } from './add_way';
import { AddDestination, DestinationsHere } from './destinations_here';
import { draftTitle } from './draft_words';
import { kPlacePart, type Editor } from './editor';
import { JoinPlace } from './join_place';
import { mapAddress, pathOf } from './map_address';
import { Outcome } from './outcome';
import { PlacePictures } from './place_pictures';
import { RemovePlace } from './remove_place';
import { RenamePlace } from './rename_place';
import { Shortcuts } from './shortcuts';
import { TakeOut } from './take_out';
import { Ways } from './ways';

interface Props {
  editor: Editor;
  place: Place;
  others: readonly Draft[]; // drafts of which this place is a part, without the one that is open
  onChoose: (place: string) => void;
  onGo: (() => void) | null;
}

/** One place: its name, its pictures, the ways out of it, and all that can be changed about it. */
export function Inspector({ editor, place, others, onChoose, onGo }: Props) {
  const { graph, mayEdit } = editor;
  const title = placeTitle(graph, place.id);
  const outcome = editor.outcomeIn(kPlacePart);
  const heading = useRef<HTMLHeadingElement>(null);
  // A place that was chosen further down the page comes into view, for eyes and for screen readers.
  useEffect(() => heading.current?.focus(), [place.id]);
  return (
    <section class="card stack inspector" aria-label={`Chosen place: ${title}`}>
      <div class="row apart">
        <h2 tabIndex={-1} ref={heading}>
          {title}
        </h2>
        {onGo && (
          <button type="button" class="button main" onClick={onGo}>
            Send the chair here
          </button>
        )}
      </div>
      {others.map((one) => (
        <Notice key={one.id} tone="warn" still>
          {one.by} tries changes here, in the draft “{draftTitle(one)}”.
        </Notice>
      ))}
      <PlacePictures key={`pictures ${place.id}`} graph={graph} place={place} title={title} />
      {mayEdit && <RenamePlace key={`name ${place.id}`} editor={editor} place={place} />}
      {outcome && <Outcome of={outcome} />}
      <Ways key={`ways ${place.id}`} editor={editor} place={place} onChoose={onChoose} />
      {mayEdit && (
        <div class="stack tight" key={`change ${place.id}`}>
          <h3>Change this place</h3>
          <div>
            <DestinationsHere editor={editor} place={place} />
            <AddDestination editor={editor} place={place} />
            <AddWay editor={editor} place={place} />
            <JoinPlace editor={editor} place={place} />
            <TakeOut editor={editor} place={place} />
            <RemovePlace editor={editor} place={place} />
          </div>
        </div>
      )}
      <Shortcuts editor={editor} place={place.id} />
      <p>
        <a
          href={pathOf({ ...mapAddress.value, map: graph.map, page: 'evidence', place: place.id })}
          onClick={follow}
        >
          What may be wrong at this place
        </a>
      </p>
    </section>
  );
}
