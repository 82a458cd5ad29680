// SPDX-License-Identifier: Apache-2.0

export function Brand() {
  return (
    <p class="brand">
      <img src="/favicon.svg" alt="" width={40} height={40} />
      Homeward
    </p>
  );
}
