// SPDX-License-Identifier: Apache-2.0
//
// validate_pack.mjs PACK: prints the errors that gltf-validator finds in a pack, and fails when there are any.
import { readFileSync } from 'node:fs';
import { validateBytes } from './e2e/dependencies.mjs';

const { issues } = await validateBytes(new Uint8Array(readFileSync(process.argv[2])));
for (const { severity, code, message, pointer } of issues.messages) if (severity === 0) console.log(code, message, pointer);
process.exitCode = issues.numErrors > 0 ? 1 : 0;
