// SPDX-License-Identifier: Apache-2.0

export function RobotsPage() {
  return <h1>robots</h1>;
}
