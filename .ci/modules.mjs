// Where npm's modules lie: outside the tree, in the folder that `.ci/run` fills.
// HSD_NODE names another folder that holds `node_modules`.
import { createRequire } from 'node:module';
import { homedir } from 'node:os';
import { join } from 'node:path';

const cache = process.env.XDG_CACHE_HOME || join(homedir(), '.cache');

/** The folder that holds `node_modules`. */
export const folder = process.env.HSD_NODE || join(cache, 'hsd-ci');

/** Loads a CommonJS module from there. */
export const load = createRequire(join(folder, 'index.js'));
