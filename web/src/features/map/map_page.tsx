// SPDX-License-Identifier: Apache-2.0

export function MapPage() {
  return <h1>map</h1>;
}
