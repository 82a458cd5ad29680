// SPDX-License-Identifier: Apache-2.0
export type Role = 'viewer' | 'rider' | 'carer' | 'installer' | 'admin' | 'robot';
export interface User { id: string; name: string; role: Role }
export interface TokenInfo { id: string; name: string; role: Role; robot?: string | null; created_us?: number }
export interface Belief { updates: number; place: string; probability: number; top: { place: string; probability: number }[]; lost: boolean; ms?: number; t_us?: number }
export type MissionState = 'accepted' | 'driving' | 'arrived' | 'refused' | 'stopped' | 'failed';
export interface Mission {
  id: string; robot: string; map: string; revision: number; destination: string | null; place: string; state: MissionState;
  reason: string | null; epoch: number; seq: number; path: string[]; path_index: number; created_us: number; by: string;
}
export interface LeaseView { holder: string; epoch: number; expires_in_ms: number }
export interface Lease extends LeaseView { id: string }
export type DriveState = 'idle' | 'driving' | 'arrived' | 'stopped' | 'failed';
export interface Robot {
  id: string; name: string; online: boolean; map: string | null; state: DriveState | null; belief: Belief | null; mission: Mission | null;
  lease: LeaseView | null; status_age_ms: number | null;
}
export interface MapInfo { id: string; name: string; state: 'building' | 'ready' | 'failed'; revision: number; places: number; images: number; tours: string[]; feature_config_id: string }
export interface Problem { type: string; title: string; status: number; detail?: string; where?: string; code?: string }
export interface Job { id: string; kind: string; map: string; state: 'queued' | 'running' | 'done' | 'failed' | 'cancelled'; progress: { stage: string; share: number } | null; error: Problem | null; created_us: number }
export interface Place { id: string; label: string | null; prototype: string; members: string[]; features: number; x: number; y: number }
export interface Edge { from: string; to: string; bearing_rad: number | null; turn_rad: number | null; length_m: number | null; weak: boolean; blocked: boolean }
export interface Destination { id: string; place: string; image: string; label: string }
export interface Masses { true: number; false: number; unknown: number }
export interface Hypothesis { prototype_a: string; prototype_b: string; masses_before: Masses; masses_after: Masses; support: number; plausibility: number; decision: 'accepted' | 'rejected' | 'undecided'; by: string }
export interface Graph { format: 'homeward-graph'; version: 1; map: string; revision: number; places: Place[]; edges: Edge[]; destinations: Destination[]; hypotheses: Hypothesis[] }
export interface Tour { id: string; name: string; state: 'open' | 'complete'; images: number; created_us: number; missing?: number[] }
export type Edit = { kind: 'rename'; place: string; label: string } | { kind: 'block_edge'; from: string; to: string; blocked: boolean };
export type HouseEvent =
  | { type: 'snapshot'; v: 1; seq: number; build: string; robots: Robot[]; jobs: Job[]; maps: MapInfo[] }
  | { type: 'robot'; v: 1; seq: number; robot: Robot }
  | { type: 'job'; v: 1; seq: number; job: Job }
  | { type: 'map'; v: 1; seq: number; map: MapInfo }
  | { type: 'mission'; v: 1; seq: number; mission: Mission };
