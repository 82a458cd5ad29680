// SPDX-License-Identifier: Apache-2.0

export function ToursPage() {
  return <h1>tours</h1>;
}
