// SPDX-License-Identifier: Apache-2.0
// Writes src/api/generated/openapi.d.ts from proto/openapi.yaml; left alone when it is up to date, so that watchers rest.
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';
import openapiTS, { astToString } from 'openapi-typescript';

const contract = new URL('../../proto/openapi.yaml', import.meta.url);
const target = new URL('../src/api/generated/openapi.d.ts', import.meta.url);

const types = `// Generated from proto/openapi.yaml by dev/generate-types.mjs.\n${astToString(await openapiTS(contract))}`;
const before = await readFile(target, 'utf8').catch(() => null);
if (before !== types) {
  await mkdir(dirname(fileURLToPath(target)), { recursive: true });
  await writeFile(target, types);
}
