// SPDX-License-Identifier: Apache-2.0

/** Where a robot maps a building by itself: /robots/r1/explore. */
export function explorePath(robot: string): string {
  return `/robots/${encodeURIComponent(robot)}/explore`;
}

/** The robot that such an address names; null for every other address. */
export function exploringRobot(pathname: string): string | null {
  const [first, robot, page, ...rest] = pathname.split('/').filter(Boolean);
  if (first !== 'robots' || robot === undefined || page !== 'explore' || rest.length > 0) return null;
  try {
    return decodeURIComponent(robot);
  } catch {
    return robot;
  }
}
