// SPDX-License-Identifier: Apache-2.0
import type { Role, User } from '../../api/types';

const kRoles: Readonly<Record<Role, { word: string; may: string }>> = {
  viewer: { word: 'Viewer', may: 'may look, and may always stop the chair' },
  rider: { word: 'Rider', may: 'may also send the chair to places' },
  carer: { word: 'Carer', may: 'may do what a rider may, for others' },
  installer: { word: 'Installer', may: 'may also add tours, maps and robots' },
  admin: { word: 'Administrator', may: 'may also add people' },
  robot: { word: 'Robot', may: 'connects a robot, or sends tours' },
};

export function roleWord(role: Role): string {
  return kRoles[role].word;
}

/** Roles for people, as choices. */
export const personRoles: readonly { value: Exclude<User['role'], 'robot'>; label: string }[] = (
  ['viewer', 'rider', 'carer', 'installer', 'admin'] as const
).map((role) => ({ value: role, label: `${kRoles[role].word}: ${kRoles[role].may}` }));

/** Roles for programs. */
export const tokenRoles: readonly { value: Role; label: string }[] = (
  ['robot', 'viewer', 'rider', 'carer', 'installer'] as const
).map((role) => ({ value: role, label: `${kRoles[role].word}: ${kRoles[role].may}` }));
