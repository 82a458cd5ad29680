// SPDX-License-Identifier: Apache-2.0
import { useId, useState } from 'preact/hooks';
import type { PlanUpload } from '../../api/calls';
import { Choice, TextField } from '../../components/field';
import { numberIn } from './pins';

const kMost_mib = 16;
const kFormats = ['wrl', 'svg'];
const kUps = [
  { value: '', label: 'As usual in such files' },
  { value: 'z', label: 'z' },
  { value: 'y', label: 'y' },
];

export interface PlanFile {
  chosen: File | null;
  unit: string;
  height: string;
  up: string;
  round: number; // a file field has no value to clear: a new one takes its place
  upload: PlanUpload | null; // once all of it is right
  trouble: string | null;
  choose: (file: File | null) => void;
  setUnit: (text: string) => void;
  setHeight: (text: string) => void;
  setUp: (axis: string) => void;
  clear: () => void;
}

const endingOf = (name: string) => (/\.([A-Za-z0-9]{1,8})$/.exec(name)?.[1] ?? '').toLowerCase();

/** A file that is to become a plan, with what has to be said about it. */
export function usePlanFile(): PlanFile {
  const [chosen, choose] = useState<File | null>(null);
  const [unit, setUnit] = useState('');
  const [height, setHeight] = useState('2.5');
  const [up, setUp] = useState('');
  const [round, setRound] = useState(0);
  const format = endingOf(chosen?.name ?? '');
  const unsaid = unit.trim() === '';
  const metres_per_unit = unsaid ? null : numberIn(unit, 1000);
  const wall_height_m = numberIn(height, 100);
  const trouble = troubleOf(chosen, format, unsaid ? 1 : metres_per_unit, wall_height_m);
  const axis = format !== 'svg' && (up === 'y' || up === 'z') ? up : null;
  return {
    chosen,
    unit,
    height,
    round,
    up,
    upload:
      chosen && trouble === null && wall_height_m !== null
        ? { file: chosen, format, metres_per_unit, up: axis, wall_height_m }
        : null,
    trouble,
    choose,
    setUnit,
    setHeight,
    setUp,
    clear: () => {
      choose(null);
      setRound(round + 1);
    },
  };
}

function troubleOf(chosen: File | null, format: string, unit: number | null, height: number | null) {
  if (!chosen) return null;
  if (format === '') return 'The name of the file does not say what kind of plan it is.';
  if (chosen.size === 0) return 'The file is empty.';
  if (chosen.size > kMost_mib * 1024 * 1024) return `The file is larger than ${kMost_mib} MiB.`;
  if (unit === null || unit <= 0) return 'Say how many metres a unit of the file is, such as 0.01.';
  if (height === null || height <= 0) return 'Say how high walls are, in metres, such as 2.5.';
  return null;
}

export function PlanFileFields({ file, label }: { file: PlanFile; label: string }) {
  const id = useId();
  const format = endingOf(file.chosen?.name ?? '');
  return (
    <>
      <div class="field">
        <label for={id}>{label}</label>
        <input
          key={file.round}
          id={id}
          type="file"
          accept={kFormats.map((one) => `.${one}`).join(',')}
          aria-describedby={`${id}-hint`}
          onChange={(event) => file.choose(event.currentTarget.files?.[0] ?? null)}
        />
        <span class="hint small" id={`${id}-hint`}>
          A drawing of the building from above (SVG), or its edges or walls in space (VRML97, glTF, OBJ, PLY,
          STL).
        </span>
      </div>
      <div class="form-columns">
        <TextField
          label="Metres in a unit of the file"
          value={file.unit}
          onInput={file.setUnit}
          required={false}
          hint="Empty: as the file says, else 1."
          maxLength={20}
        />
        {format === 'svg' && (
          <TextField label="Height of walls, m" value={file.height} onInput={file.setHeight} maxLength={20} />
        )}
        {format !== '' && format !== 'svg' && (
          <Choice label="Which axis points up" value={file.up} onChange={file.setUp} options={kUps} />
        )}
      </div>
      {file.trouble !== null && <p class="warn-text">{file.trouble}</p>}
    </>
  );
}
