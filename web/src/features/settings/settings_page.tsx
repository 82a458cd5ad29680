// SPDX-License-Identifier: Apache-2.0

export function SettingsPage() {
  return <h1>settings</h1>;
}
