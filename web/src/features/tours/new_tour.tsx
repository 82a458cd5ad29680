// SPDX-License-Identifier: Apache-2.0
import { useId, useState } from 'preact/hooks';
import type { Tour } from '../../api/types';
import { Choice, TextField } from '../../components/field';
import { Bar, Notice } from '../../components/notice';
import { without } from '../../lib/draft';
import { count } from '../../lib/words';
import { tourFiles, type TourFiles } from './tour_folder';
import { cancelUpload, upload, uploadTour } from './upload';

/** Uploading a folder of pictures as a tour, or going on with one that was broken off. */
export function NewTour({ tours }: { tours: readonly Tour[] }) {
  const [name, setName] = useState('');
  const [goOn, setGoOn] = useState('');
  const [files, setFiles] = useState<TourFiles<File> | null>(null);
  const [camera, setCamera] = useState<File | null>(null);
  const open = tours.filter((one) => one.state === 'open');
  const continued = open.find((one) => one.id === goOn) ?? null;
  const running = upload.value.kind === 'running';
  const cameraFile = camera ?? files?.camera ?? null;
  const images = files?.images.length ?? 0;
  const ready = images >= 3 && (continued !== null || (cameraFile !== null && name.trim() !== ''));

  const submit = (event: Event) => {
    event.preventDefault();
    if (!files || !ready || running) return;
    void uploadTour(continued?.name ?? name.trim(), files, cameraFile, continued).then(() => {
      // The name is asked for again, so that a second press cannot send the same tour twice.
      if (upload.peek().kind === 'done') setName(without(name));
      setGoOn('');
    });
  };
  return (
    <section class="card stack" aria-labelledby="new-tour">
      <h2 id="new-tour">Add a tour</h2>
      <p class="soft">
        A tour is one drive through the house: pictures in the order in which they were taken, and the file{' '}
        <strong>camera.json</strong> that describes the camera.
      </p>
      <form class="stack" onSubmit={submit}>
        {open.length > 0 && (
          <Choice
            label="New, or go on with a broken-off tour"
            value={goOn}
            onChange={setGoOn}
            options={[
              { value: '', label: 'A new tour' },
              ...open.map((one) => ({
                value: one.id,
                label: `Go on with ${one.name} (${one.images} arrived)`,
              })),
            ]}
          />
        )}
        {!continued && <TextField label="Name of the tour" value={name} onInput={setName} />}
        <FileField
          label="Folder of pictures"
          folder
          hint={
            files
              ? folderWords(files)
              : 'JPEG or PNG. The folder may also hold camera.json, tour.json, times.csv, odometry.csv, scans.csv with scans.json.'
          }
          onFiles={(list) => setFiles(tourFiles(list))}
        />
        {!continued && (
          <FileField
            label="Camera file"
            accept=".json,application/json"
            hint={
              cameraFile ? `Using ${cameraFile.name}.` : 'Only needed when the folder has no camera.json.'
            }
            onFiles={(list) => setCamera(list[0] ?? null)}
          />
        )}
        <div class="row">
          <button type="submit" class="button main" disabled={!ready || running}>
            {images > 0 ? `Send ${count(images, 'picture')}` : 'Send the pictures'}
          </button>
          {running && (
            <button type="button" class="button" onClick={cancelUpload}>
              Stop sending
            </button>
          )}
        </div>
      </form>
      <Progress />
    </section>
  );
}

function folderWords(files: TourFiles<File>): string {
  if (files.images.length < 3)
    return `Only ${count(files.images.length, 'picture')} found; a tour needs at least 3.`;
  const also = [
    files.camera && 'the camera',
    files.marks && 'named places',
    files.times && 'times',
    files.odometry && 'odometry',
    files.scans && files.scansAbout && 'range sweeps',
  ];
  const known = also.filter((one) => one !== null);
  return `${count(files.images.length, 'picture')} found${known.length > 0 ? `, with ${known.join(', ')}` : ''}.`;
}

interface FileFieldProps {
  label: string;
  hint: string;
  onFiles: (files: File[]) => void;
  folder?: boolean;
  accept?: string;
}

function FileField({ label, hint, onFiles, folder, accept }: FileFieldProps) {
  const id = useId();
  return (
    <div class="field">
      <label for={id}>{label}</label>
      <input
        id={id}
        type="file"
        accept={accept}
        multiple={folder}
        aria-describedby={`${id}-hint`}
        ref={(input) => {
          if (input && folder) input.webkitdirectory = true;
        }}
        onChange={(event) => onFiles([...(event.currentTarget.files ?? [])])}
      />
      <span class="hint small" id={`${id}-hint`} role="status">
        {hint}
      </span>
    </div>
  );
}

function Progress() {
  const state = upload.value;
  switch (state.kind) {
    case 'none':
      return null;
    case 'running':
      return (
        <div class="stack tight">
          <Bar share={state.total > 0 ? state.sent / state.total : 0} label={`Sending ${state.name}`} />
          <p class="soft" role="status">
            {state.sent} of {state.total} pictures of {state.name} have arrived.
            {state.waiting && ' The house server is busy or out of reach; trying again.'}
          </p>
        </div>
      );
    case 'done':
      return (
        <Notice>
          {state.name} is complete, with {count(state.total, 'picture')}.
        </Notice>
      );
    case 'failed':
      return (
        <Notice tone="bad">
          {state.name} was not sent in full. {state.reason}
        </Notice>
      );
  }
}
