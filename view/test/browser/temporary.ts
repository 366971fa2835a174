// Temporary folders for a test file.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const made: string[] = [];
process.on('exit', () => { for (const folder of made) rmSync(folder, { recursive: true, force: true }); });

/** Creates an empty folder that is removed at the end of the test file. */
export function temporaryFolder(): string {
  const folder = mkdtempSync(join(tmpdir(), 'hsd-test-'));
  made.push(folder);
  return folder;
}
