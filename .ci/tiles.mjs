// node tiles.mjs FOLDER
// Loads a town in tiles with 3d-tiles-renderer in a browser and goes near everything in it. Exits with 1 on console warnings,
// if a tile is never asked for, or if the table of a tile cannot be read.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { withPage } from './browser.mjs';

const [town] = process.argv.slice(2);
if (!town) throw new Error('no folder');

/** The files of a tile and of those below it. */
const contents = tile => [tile.content?.uri, ...(tile.children ?? []).flatMap(contents)].filter(Boolean);
const tileset = JSON.parse(await readFile(join(town, 'tileset.json'), 'utf8'));
const wanted = contents(tileset.root);

const bad = await withPage({ script: 'tiles_page.mjs', town }, async (page, problems) => {
  const asked = new Set();
  page.on('request', request => asked.add(new URL(request.url()).pathname.replace('/town/', '')));
  const shown = await page.evaluate(() => window.visit('/town/tileset.json'));
  // The renderer knows few of the extensions of 1.1; a town uses none of the others.
  const real = problems.filter(line => !line.includes('tiles versions at 1.1 or higher have limited support'));
  const missed = wanted.filter(uri => !asked.has(uri));
  console.log(`${town}: ${wanted.length} contents, ${wanted.length - missed.length} asked for, `
    + `${shown.features} features named, ${shown.triangles} triangles drawn`);
  const found = [...real, ...missed.map(uri => `${uri} is never asked for`), ...shown.errors];
  if (shown.features === 0) found.push('no feature has a name');
  if (shown.triangles === 0) found.push('nothing is drawn');
  for (const line of found) console.log(`  ${line}`);
  return found.length;
});
process.exit(bad > 0 ? 1 : 0);
