// SPDX-License-Identifier: Apache-2.0
import type { Graph, Job, Reason } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { reasonText } from '../../words/reasons';

type Parameter = Reason['parameters'][string];

function isReason(value: unknown): value is Reason {
  return typeof value === 'object' && value !== null && 'code' in value && 'parameters' in value;
}

/** The reasons that a parameter holds. */
function reasonsIn(value: Parameter): Reason[] {
  return (Array.isArray(value) ? value : [value]).filter(isReason);
}

/** Every reason in a reason, itself first. */
function all(reason: Reason): Reason[] {
  return [reason, ...Object.values(reason.parameters).flatMap((one) => reasonsIn(one).flatMap(all))];
}

/** The place that a reason names by its number; null: it names none. */
function numberedPlace({ code, parameters }: Reason): string | null {
  return code === 'place_numbered' && typeof parameters.place === 'string' ? parameters.place : null;
}

/** The warning of a tour that says itself which pictures it is about; null: there is none, or it does not. */
function ownPictures(reason: Reason): Reason | null {
  const [warning] = reason.code === 'warning_at' ? reasonsIn(reason.parameters.warning ?? '') : [];
  return warning && all(warning).some((one) => one.code === 'jump') ? warning : null;
}

/** The same for people, who know neither numbers of places nor ids of tours. */
function forPeople(whole: Reason, graph: Graph | null): Reason {
  const reason = ownPictures(whole) ?? whole;
  const place = numberedPlace(reason);
  if (place !== null) {
    const title = graph ? placeTitle(graph, place) : place;
    return { code: 'place_named', parameters: { label: title === place ? 'A place' : title } };
  }
  const told = Object.entries(reason.parameters).map(([name, value]): [string, Parameter] => {
    if (reason.code === 'warning_at' && name === 'image' && typeof value === 'string')
      return [name, value.slice(value.lastIndexOf('/') + 1)];
    if (Array.isArray(value)) return [name, value.filter(isReason).map((one) => forPeople(one, graph))];
    return [name, isReason(value) ? forPeople(value, graph) : value];
  });
  return { code: reason.code, parameters: Object.fromEntries(told) };
}

/** What a person should know of a job. `graph`: of its map, for the names of places. */
export function noteWords(job: Job, graph: Graph | null): string {
  return job.notes.map((one) => reasonText(forPeople(one, graph))).join(' ');
}

/** The places without a name that the notes tell of, to be shown by their pictures. */
export function unnamedPlaces(job: Job, graph: Graph | null): string[] {
  const places = job.notes.flatMap(all).map(numberedPlace);
  return places.filter(
    (one): one is string => one !== null && graph !== null && indexOf(graph).places.has(one),
  );
}

/** Two pictures that follow each other in a tour and do not resemble each other, by their lasting ids. */
export interface Jump {
  from: string;
  to: string;
}

/** The jumps that the notes warn of, of pictures that the map knows or may know. */
export function jumpsOf(job: Job): Jump[] {
  return job.notes.flatMap((note) => {
    const { image } = note.parameters;
    if (note.code !== 'warning_at' || typeof image !== 'string') return [];
    const tour = image.slice(0, image.lastIndexOf('/') + 1);
    return all(note).flatMap(({ code, parameters: { from, to } }) =>
      code === 'jump' && typeof from === 'string' && typeof to === 'string'
        ? [{ from: tour + from, to: tour + to }]
        : [],
    );
  });
}
