// SPDX-License-Identifier: Apache-2.0

/** A request that is answered with a problem document. */
export class Refusal extends Error {
  constructor(status, code, message) {
    super(message);
    Object.assign(this, { status, code });
  }
}
