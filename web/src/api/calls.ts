// SPDX-License-Identifier: Apache-2.0
import { problemFrom, unreachable, type ProblemError } from './problem';
import type {
  Difference,
  Doubts,
  Draft,
  Edit,
  Exploration,
  Fences,
  Graph,
  Job,
  Lease,
  LoggedEdit,
  MapInfo,
  MapPlan,
  Mission,
  Pair,
  PlanInfo,
  PlanLines,
  PlanTie,
  RefineMode,
  ReplayCheck,
  Robot,
  Role,
  Similarity,
  Sweep,
  TokenInfo,
  Tour,
  User,
  WayDrives,
} from './types';

const kRoot = '/api/v1';
const kTimeoutMs = 20_000;
const kPlanTimeoutMs = 180_000; // a large plan is read before it is kept

/** Called when an answer says that nobody is signed in (any more). */
let onSignedOut: () => void = () => undefined;
export function whenSignedOut(call: () => void): void {
  onSignedOut = call;
}

interface Options {
  method?: 'GET' | 'POST' | 'PUT' | 'DELETE';
  body?: unknown;
  raw?: Blob;
  headers?: Record<string, string>;
  signal?: AbortSignal;
}

async function answerOf(path: string, options: Options): Promise<Response> {
  const method = options.method ?? 'GET';
  const headers: Record<string, string> = { Accept: 'application/json', ...options.headers };
  if (options.body !== undefined) headers['Content-Type'] = 'application/json';
  if (method === 'POST') headers['Idempotency-Key'] ??= randomId();
  const timeout = AbortSignal.timeout(kTimeoutMs);
  try {
    return await fetch(kRoot + path, {
      method,
      headers,
      credentials: 'same-origin',
      cache: 'no-store',
      signal: options.signal ?? timeout,
      ...(options.raw ? { body: options.raw } : {}),
      ...(options.body === undefined ? {} : { body: JSON.stringify(options.body) }),
    });
  } catch {
    throw unreachable();
  }
}

async function refused(answer: Response): Promise<ProblemError> {
  const body: unknown = await answer.json().catch(() => null);
  const problem = problemFrom(answer.status, body);
  if (answer.status === 401) onSignedOut();
  return problem;
}

async function call<T>(path: string, options: Options = {}): Promise<T> {
  const answer = await answerOf(path, options);
  if (!answer.ok) throw await refused(answer);
  const text = await answer.text();
  return (text === '' ? undefined : JSON.parse(text)) as T;
}

/** An identifier for one attempt; crypto.randomUUID exists only on secure origins, getRandomValues everywhere. */
export function randomId(): string {
  return [...crypto.getRandomValues(new Uint8Array(16))]
    .map((byte) => byte.toString(16).padStart(2, '0'))
    .join('');
}

const id = encodeURIComponent;

// Account
export const setupNeeded = () => call<{ needed: boolean }>('/setup');
export const setUp = (body: { token: string; name: string; password: string }) =>
  call<unknown>('/setup', { method: 'POST', body });
export const logIn = (body: { name: string; password: string }) =>
  call<{ user: User }>('/login', { method: 'POST', body });
export const logOut = () => call<unknown>('/logout', { method: 'POST' });
export const whoAmI = () => call<{ user: User }>('/me');
export const users = () => call<{ users: User[] }>('/users');
export const addUser = (body: { name: string; password: string; role: Role }) =>
  call<unknown>('/users', { method: 'POST', body });
export const tokens = () => call<{ tokens: TokenInfo[] }>('/tokens');
export const addToken = (body: { name: string; role: Role; robot?: string }) =>
  call<{ id: string; token: string }>('/tokens', { method: 'POST', body });
export const removeToken = (token: string) => call<unknown>(`/tokens/${id(token)}`, { method: 'DELETE' });

// Robots
export const addRobot = (body: { name: string }) =>
  call<{ id: string; name: string; token: string }>('/robots', { method: 'POST', body });
export const assignMap = (robot: string, map: string | null) =>
  call<unknown>(`/robots/${id(robot)}/map`, { method: 'PUT', body: { map } });
/** A person says where a robot is: at one of the places that carry this label. */
export const setPlace = (robot: string, label: string) =>
  call<Robot>(`/robots/${id(robot)}/place`, { method: 'PUT', body: { label } });
export const takeLease = (robot: string, take_over: boolean) =>
  call<{ lease: Lease }>(`/robots/${id(robot)}/lease`, { method: 'POST', body: { take_over } });
export const keepLease = (robot: string, lease_id: string) =>
  call<{ lease: Lease }>(`/robots/${id(robot)}/lease`, { method: 'PUT', body: { lease_id } });
export const releaseLease = (robot: string, lease_id: string) =>
  call<unknown>(`/robots/${id(robot)}/lease`, { method: 'DELETE', body: { lease_id } });
export const startMission = (
  robot: string,
  body: { lease_id: string; destination?: string; place?: string },
) => call<Mission>(`/robots/${id(robot)}/missions`, { method: 'POST', body });
export const answerQuestion = (
  robot: string,
  mission: string,
  body: { lease_id: string; question: number; here: boolean },
) => call<Mission>(`/robots/${id(robot)}/missions/${id(mission)}/answer`, { method: 'POST', body });
/** `key` stays the same over the repetitions of one press, so that they count once. */
export const stopRobot = (robot: string, key: string) =>
  call<{ stop_id: string }>(`/robots/${id(robot)}/stop`, {
    method: 'POST',
    body: {},
    headers: { 'Idempotency-Key': key },
    signal: AbortSignal.timeout(2500),
  });
export const exploration = (robot: string) => call<Exploration>(`/robots/${id(robot)}/exploration`);
/** How far and how long a robot may explore; what is not said has no end. */
export interface Limits {
  limit_m?: number;
  limit_s?: number;
  back_after_s?: number;
}
/** With `exploration` it goes on with the one that it has. */
export const explore = (robot: string, body: Limits & { lease_id: string; exploration?: string }) =>
  call<Mission>(`/robots/${id(robot)}/explorations`, { method: 'POST', body });
export const setFences = (robot: string, body: { lease_id: string; fences: Fences }) =>
  call<unknown>(`/robots/${id(robot)}/exploration/fences`, { method: 'PUT', body });
/** `robot` of the body is the other one, whose exploration is shared from now on; null: none. */
export const setCompanion = (robot: string, body: { lease_id: string; robot: string | null }) =>
  call<unknown>(`/robots/${id(robot)}/exploration/companion`, { method: 'PUT', body });
export const finishExploration = (robot: string, lease_id: string) =>
  call<unknown>(`/robots/${id(robot)}/exploration/finish`, { method: 'POST', body: { lease_id } });
export const robots = () => call<{ robots: Robot[] }>('/robots');
export const frameUrl = (robot: string, n: number) => `${kRoot}/robots/${id(robot)}/frame?n=${n}`;

// Maps
export const graph = (map: string) => call<Graph>(`/maps/${id(map)}/graph`);
export const edit = (map: string, revision: number, edits: Edit[]) =>
  call<{ revision: number }>(`/maps/${id(map)}/edits`, {
    method: 'POST',
    body: { edits },
    headers: { 'If-Match': `"r${revision}"` },
  });
export const undo = (map: string, revision: number) =>
  call<{ revision: number }>(`/maps/${id(map)}/undo`, {
    method: 'POST',
    headers: { 'If-Match': `"r${revision}"` },
  });
export const redo = (map: string, revision: number) =>
  call<{ revision: number }>(`/maps/${id(map)}/redo`, {
    method: 'POST',
    headers: { 'If-Match': `"r${revision}"` },
  });
export const placeThumbnailUrl = (map: string, place: string, revision: number) =>
  `${kRoot}/maps/${id(map)}/places/${id(place)}/thumbnail?r=${revision}`;
/** `image` is a picture's lasting id, "tour/file". */
export const imageThumbnailUrl = (map: string, image: string) =>
  `${kRoot}/maps/${id(map)}/images/${image.split('/').map(id).join('/')}/thumbnail`;
/** A page by itself, without scripts. */
export const reportUrl = (map: string) => `${kRoot}/maps/${id(map)}/report`;
/** Whether there is a report; where there is none, why. */
export async function askReport(map: string): Promise<true> {
  const answer = await answerOf(`/maps/${id(map)}/report`, { headers: { Accept: 'text/html' } });
  if (!answer.ok) throw await refused(answer);
  await answer.body?.cancel(); // the frame reads it
  return true;
}
export const exportUrl = (map: string) => `${kRoot}/maps/${id(map)}/export`;
export const buildMap = (body: { name: string; tours: string[]; path?: boolean }) =>
  call<{ map: MapInfo; job: Job }>('/maps', { method: 'POST', body });
export const rebuildMap = (map: string) =>
  call<{ job: Job }>(`/maps/${id(map)}/builds`, { method: 'POST', body: { kind: 'build' } });
export const addToMap = (map: string, tours: string[]) =>
  call<{ job: Job }>(`/maps/${id(map)}/builds`, { method: 'POST', body: { kind: 'add', tours } });
export const setRefine = (map: string, refine: RefineMode) =>
  call<MapInfo>(`/maps/${id(map)}/refine`, { method: 'PUT', body: { refine } });
export const maps = () => call<{ maps: MapInfo[] }>('/maps');
export const history = (map: string) => call<{ edits: LoggedEdit[] }>(`/maps/${id(map)}/history`);
/** How missions fared on the ways of a map; ways that none came to are not told. */
export const wayDrives = (map: string) => call<{ ways: WayDrives[] }>(`/maps/${id(map)}/ways`);
/** The map as it was after a change; 0: before all of them. */
export const formerGraph = (map: string, change: number) =>
  call<Graph>(`/maps/${id(map)}/history/${change}/graph`);
/** `to`: a later change; null: the map as it is. */
export const formerDifference = (map: string, change: number, to: number | null) =>
  call<Difference>(`/maps/${id(map)}/history/${change}/difference${to === null ? '' : `?to=${to}`}`);
export const removeMap = (map: string) => call<unknown>(`/maps/${id(map)}`, { method: 'DELETE' });
export const takeJob = (job: string) => call<unknown>(`/jobs/${id(job)}/take`, { method: 'POST' });
export const cancelJob = (job: string) => call<unknown>(`/jobs/${id(job)}/cancel`, { method: 'POST' });

// Drafts: edits of a map that are tried before they count
const draftPath = ({ map, id: draft_id }: Pick<Draft, 'map' | 'id'>) =>
  `/maps/${id(map)}/drafts/${id(draft_id)}`;
const ofVersion = ({ version }: Draft) => ({ 'If-Match': `"d${version}"` });
export const drafts = (map: string) => call<{ drafts: Draft[] }>(`/maps/${id(map)}/drafts`);
export const beginDraft = (map: string, name: string) =>
  call<Draft>(`/maps/${id(map)}/drafts`, { method: 'POST', body: name === '' ? {} : { name } });
export const draft = (one: Draft) => call<Draft>(draftPath(one));
export const discardDraft = (one: Draft) => call<unknown>(draftPath(one), { method: 'DELETE' });
export const editDraft = (one: Draft, edits: Edit[]) =>
  call<Draft>(`${draftPath(one)}/edits`, { method: 'POST', body: { edits }, headers: ofVersion(one) });
export const undoInDraft = (one: Draft) =>
  call<Draft>(`${draftPath(one)}/undo`, { method: 'POST', headers: ofVersion(one) });
export const redoInDraft = (one: Draft) =>
  call<Draft>(`${draftPath(one)}/redo`, { method: 'POST', headers: ofVersion(one) });
export const draftGraph = (one: Draft) => call<Graph>(`${draftPath(one)}/graph`);
export const draftDifference = (one: Draft) => call<Difference>(`${draftPath(one)}/difference`);
export const checkDraft = (one: Draft) => call<{ job: Job }>(`${draftPath(one)}/check`, { method: 'POST' });
export const draftCheck = (one: Draft) => call<ReplayCheck>(`${draftPath(one)}/check`);
/** `leave_out_lost`: without the edits that the map as it is does not take; else these are a reason to refuse. */
export const publishDraft = (one: Draft, leave_out_lost: boolean) =>
  call<{ revision: number }>(`${draftPath(one)}/publish`, {
    method: 'POST',
    body: { leave_out_lost },
    headers: ofVersion(one),
  });

// Doubts: what a person should look at
export const doubts = (
  map: string,
  asked: { about: string; kind: string; place: string; offset: number; limit: number },
) => {
  const { about, kind, place, offset, limit } = asked;
  const query = new URLSearchParams({ about, offset: String(offset), limit: String(limit) });
  if (kind !== '') query.set('kind', kind);
  if (place !== '') query.set('place', place);
  return call<Doubts>(`/maps/${id(map)}/doubts?${query.toString()}`);
};
/** How alike all pictures of a map are; drawn as tiles. */
export const similarity = (map: string) => call<Similarity>(`/maps/${id(map)}/similarity`);
/** `revision`: of the map, whose places and decisions are drawn too. */
export const similarityTileUrl = (
  map: string,
  level: number,
  column: number,
  row: number,
  revision: number,
) => `${kRoot}/maps/${id(map)}/similarity/${level}/${column}/${row}?r=${revision}`;
export const pair = (map: string, image_a: string, image_b: string) =>
  call<Pair>(`/maps/${id(map)}/pair?${new URLSearchParams({ image_a, image_b }).toString()}`);

// Drawn plans
export const plans = () => call<{ plans: PlanInfo[] }>('/plans');
export const plan = (of: string) => call<PlanInfo>(`/plans/${id(of)}`);
/** What a person says of a file that is a plan. */
export interface PlanUpload {
  file: File;
  format: string; // how its name ends
  metres_per_unit: number | null; // null: as the file itself says, else 1
  up: 'y' | 'z' | null; // which axis of the file points up; null: as is usual in its format
  wall_height_m: number;
}
const sendPlan = (path: string, upload: PlanUpload, name?: string) => {
  const { file, format, metres_per_unit, up, wall_height_m } = upload;
  const query = new URLSearchParams({
    ...(name === undefined ? {} : { name }),
    format,
    ...(metres_per_unit === null ? {} : { metres_per_unit: String(metres_per_unit) }),
    ...(up === null ? {} : { up }),
    wall_height_m: String(wall_height_m),
  });
  return call<PlanInfo>(`${path}?${query.toString()}`, {
    method: 'POST',
    raw: file,
    headers: { 'Content-Type': 'application/octet-stream' },
    signal: AbortSignal.timeout(kPlanTimeoutMs),
  });
};
export const addPlan = (name: string, upload: PlanUpload) => sendPlan('/plans', upload, name);
export const addPlanVersion = (of: string, upload: PlanUpload) =>
  sendPlan(`/plans/${id(of)}/versions`, upload);
export const renamePlan = (of: string, name: string) =>
  call<PlanInfo>(`/plans/${id(of)}/name`, { method: 'PUT', body: { name } });
export const removePlan = (of: string) => call<unknown>(`/plans/${id(of)}`, { method: 'DELETE' });
export const planFileUrl = (of: string) => `${kRoot}/plans/${id(of)}/file`;
export const planLines = (of: string, version: number) =>
  call<PlanLines>(`/plans/${id(of)}/lines?version=${version}`);
/** Where the places of a map lie on the plan that it is tied to. */
export const mapPlan = (map: string) => call<MapPlan>(`/maps/${id(map)}/plan`);
export const tieMap = (map: string, body: PlanTie) =>
  call<MapPlan>(`/maps/${id(map)}/plan`, { method: 'PUT', body });
export const untieMap = (map: string) => call<unknown>(`/maps/${id(map)}/plan`, { method: 'DELETE' });

// Tours
export const tours = () => call<{ tours: Tour[] }>('/tours');
export const tour = (tourId: string) => call<Tour>(`/tours/${id(tourId)}`);
export const addTour = (body: { name: string; camera: unknown }) =>
  call<Tour>('/tours', { method: 'POST', body });
export const putImage = (
  tourId: string,
  n: number,
  raw: Blob,
  headers: Record<string, string>,
  signal: AbortSignal,
) =>
  call<unknown>(`/tours/${id(tourId)}/images/${n}`, {
    method: 'PUT',
    raw,
    headers: { 'Content-Type': raw.type === 'image/png' ? 'image/png' : 'image/jpeg', ...headers },
    signal,
  });
/** `name`: of the picture that was taken with it; another one under this number is refused. */
export const putSweep = (tourId: string, n: number, name: string, sweep: Sweep, signal: AbortSignal) =>
  call<unknown>(`/tours/${id(tourId)}/images/${n}/sweep`, {
    method: 'PUT',
    body: sweep,
    headers: { 'X-Homeward-Filename': name },
    signal,
  });
export const putMarks = (tourId: string, marks: { image: string; label: string }[]) =>
  call<unknown>(`/tours/${id(tourId)}/marks`, { method: 'PUT', body: { marks } });
export const completeTour = (tourId: string) =>
  call<unknown>(`/tours/${id(tourId)}/complete`, { method: 'POST' });
