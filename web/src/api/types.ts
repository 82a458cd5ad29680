// SPDX-License-Identifier: Apache-2.0
// Short names for the contract's types; they are generated from proto/openapi.yaml.
import type * as own from './own_types';
import type { components } from './generated/openapi';

type Schemas = components['schemas'];

export type Role = Schemas['Role'];
export type User = Schemas['User'];
export type TokenInfo = Schemas['TokenInfo'];
export type Belief = Schemas['Belief'];
export type Mission = Schemas['Mission'];
export type MissionState = Schemas['MissionState'];
export type LeaseView = Schemas['LeaseView'];
export type Lease = Schemas['Lease'];
export type DriveState = Schemas['DriveState'];
export type Robot = Schemas['Robot'];
export type MapInfo = Schemas['MapInfo'];
export type Reason = Schemas['Reason'];
export type Problem = Schemas['Problem'];
export type Job = Schemas['Job'];
export type RefineMode = Schemas['RefineMode'];
export type Graph = own.Graph;
export type Place = own.Place;
export type Edge = Schemas['Edge'];
export type Destination = Schemas['Destination'];
export type Hypothesis = Schemas['Hypothesis'];
export type Masses = Schemas['Masses'];
export type Shortcut = Schemas['Shortcut'];
export type Tour = Schemas['Tour'];
export type Sweep = Schemas['Sweep'];
export type Edit = Schemas['Edit'];
export type LoggedEdit = Schemas['LoggedEdit'];
export type Draft = Schemas['Draft'];
export type Difference = Schemas['Difference'];
export type ReplayCheck = Schemas['ReplayCheck'];
export type WorseSpot = ReplayCheck['worse'][number];
export type Doubt = Doubts['doubts'][number];
export type Doubts = Schemas['Doubts'];
export type WayDrives = Schemas['WayDrives'];
export type Similarity = Schemas['Similarity'];
export type Pair = Schemas['Pair'];
export type Exploration = Schemas['Exploration'];
export type Floor = NonNullable<Exploration['floor']>;
export type Fences = Schemas['Fences'];
export type ServerEvent = Schemas['ServerEvent'] | own.DraftEvent;
