// SPDX-License-Identifier: Apache-2.0

export function GoPage() {
  return <h1>go</h1>;
}
