// The npm modules of the checks: outside the tree, in the folder that `.ci/nightly` fills.
// HSD_NODE sets a different folder that contains `node_modules`.
import { createRequire } from 'node:module';
import { homedir } from 'node:os';
import { join } from 'node:path';

const cache = process.env.XDG_CACHE_HOME || join(homedir(), '.cache');

/** The folder that contains `node_modules`. */
export const folder = process.env.HSD_NODE || join(cache, 'hsd-ci');

/** Loads a CommonJS module from that folder. */
export const load = createRequire(join(folder, 'index.js'));
