// SPDX-License-Identifier: Apache-2.0
import { after } from 'node:test';

/** Waits for what is starting, a browser, page or server, and closes it when a test is done. */
export async function forTest(t, starting) {
  const started = await starting;
  t.after(() => started.close());
  return started;
}

/** The same when all tests of a file are done. */
export const forAllTests = (starting) => forTest({ after }, starting);
