// SPDX-License-Identifier: Apache-2.0
import type { Role } from '../api/types';

const kLadder: readonly Role[] = ['viewer', 'rider', 'carer', 'installer', 'admin'];

/** Whether `role` is at least `needed`; a robot's role is on no rung. */
export function atLeast(role: Role | undefined, needed: Role): boolean {
  if (role === undefined || role === 'robot') return false;
  return kLadder.indexOf(role) >= kLadder.indexOf(needed);
}
