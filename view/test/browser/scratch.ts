// Folders for the length of a test file.

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const made: string[] = [];
process.on('exit', () => { for (const folder of made) rmSync(folder, { recursive: true, force: true }); });

/** An empty folder, gone when the tests of this file have ended. */
export function scratch(): string {
  const folder = mkdtempSync(join(tmpdir(), 'hsd-test-'));
  made.push(folder);
  return folder;
}
