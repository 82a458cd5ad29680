// SPDX-License-Identifier: Apache-2.0

/** The set-up token in an address: "/setup#token", "/setup?token=token" or "/setup#token=token"; empty when there is none. */
export function tokenIn(hash: string, search: string): string {
  const fromQuery = new URLSearchParams(search).get('token');
  if (fromQuery) return fromQuery;
  const bare = hash.replace(/^#/, '');
  return decodeURIComponent(bare.startsWith('token=') ? bare.slice('token='.length) : bare);
}
