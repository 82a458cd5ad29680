// SPDX-License-Identifier: Apache-2.0

// As the real server's table of errors; tests/browser/same_answers_test.mjs holds them together.
const kTable = {
  invalid_input: [422, 'The input breaks its format'],
  unsupported_format: [422, 'This format or version is not read here'],
  unsupported_image: [415, 'Not a JPEG or PNG picture'],
  not_found: [404, 'There is no such thing'],
  unknown_place: [404, 'There is no such place'],
  no_route: [409, 'There is no way to that place'],
  lost: [409, 'Where the robot is, is not known'],
  conflict: [409, 'The present state does not allow this'],
  stale_revision: [412, 'The map has changed in the meantime'],
  unauthenticated: [401, 'Sign in first'],
  forbidden: [403, 'Your role does not allow this'],
  lease_held: [409, 'Somebody else is driving'],
  robot_offline: [409, 'The robot is not connected'],
  internal: [500, 'A fault of this program'],
};

/** A number of a path or a query. */
export function wholeNumber(text, most, where) {
  const number = /^\d+$/.test(text) ? Number(text) : NaN;
  if (number <= most) return number;
  throw new Refusal('invalid_input', `A whole number from 0 to ${most} was expected.`, where);
}

/** A request that is answered with a problem document. */
export class Refusal extends Error {
  constructor(code, message, where = '') {
    super(message);
    const [status, title] = kTable[code];
    this.document = {
      type: `urn:homeward:problem:${code}`,
      title,
      status,
      detail: message,
      where,
      code,
    };
  }

  /** What HTTP itself forbids. */
  static ofHttp(status, title, message) {
    const refusal = new Refusal('internal', message);
    refusal.document = { type: 'about:blank', title, status, detail: message, where: '', code: 'http' };
    return refusal;
  }
}
