// SPDX-License-Identifier: Apache-2.0
import { useId, useState } from 'preact/hooks';
import type { PlanUpload } from '../../api/calls';
import { TextField } from '../../components/field';
import { numberIn } from './pins';

const kMost_mib = 16;
const kFormats = ['wrl', 'vrml', 'svg', 'dxf', 'obj', 'ply', 'stl', 'glb'];
const kFlat = new Set(['svg', 'dxf']);

export interface PlanFile {
  chosen: File | null;
  unit: string;
  height: string;
  round: number; // a file field has no value to clear: a new one takes its place
  upload: PlanUpload | null; // once all of it is right
  trouble: string | null;
  choose: (file: File | null) => void;
  setUnit: (text: string) => void;
  setHeight: (text: string) => void;
  clear: () => void;
}

const endingOf = (name: string) => (/\.([A-Za-z0-9]{1,8})$/.exec(name)?.[1] ?? '').toLowerCase();

/** A file that is to become a plan, with what has to be said about it. */
export function usePlanFile(): PlanFile {
  const [chosen, choose] = useState<File | null>(null);
  const [unit, setUnit] = useState('1');
  const [height, setHeight] = useState('2.5');
  const [round, setRound] = useState(0);
  const [metres_per_unit, wall_height_m] = [numberIn(unit, 1000), numberIn(height, 100)];
  const format = endingOf(chosen?.name ?? '');
  const trouble = troubleOf(chosen, format, metres_per_unit, wall_height_m);
  const whole = chosen && trouble === null && metres_per_unit !== null && wall_height_m !== null;
  return {
    chosen,
    unit,
    height,
    round,
    upload: whole ? { file: chosen, format, metres_per_unit, wall_height_m } : null,
    trouble,
    choose,
    setUnit,
    setHeight,
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
  const flat = kFlat.has(endingOf(file.chosen?.name ?? ''));
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
          A drawing of the building from above, or its edges in space.
        </span>
      </div>
      <div class="form-columns">
        <TextField
          label="Metres in a unit of the file"
          value={file.unit}
          onInput={file.setUnit}
          maxLength={20}
        />
        {flat && (
          <TextField label="Height of walls, m" value={file.height} onInput={file.setHeight} maxLength={20} />
        )}
      </div>
      {file.trouble !== null && <p class="warn-text">{file.trouble}</p>}
    </>
  );
}
