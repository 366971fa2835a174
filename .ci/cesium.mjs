// node cesium.mjs FOLDER...
// Loads towns in tiles with CesiumJS in a browser, without the network, and goes near everything in them. Exits with 1 on
// messages of the console, if a tile fails or is never asked for, or if features have no keys.
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { withPage } from './browser.mjs';

const towns = process.argv.slice(2);
if (towns.length === 0) throw new Error('no folders');

/** The files of a tile and of those below it. */
const contents = tile => [tile.content?.uri, ...(tile.children ?? []).flatMap(contents)].filter(Boolean);

let bad = 0;
for (const town of towns) {
  const { root } = JSON.parse(await readFile(join(town, 'tileset.json'), 'utf8')), wanted = contents(root);
  bad += await withPage({ script: 'cesium_page.mjs', town, width: 160, height: 120 }, async (page, problems) => {
    const asked = new Set(), foreign = [];
    page.on('request', request => {
      const url = new URL(request.url());
      if (url.origin === new URL(page.url()).origin) asked.add(decodeURIComponent(url.pathname).replace('/town/', ''));
      else if (/^http/.test(url.protocol)) foreign.push(`asks ${url.origin}`);
    });
    const { features, triangles, errors } = await page.evaluate(() => window.visit('/town/tileset.json'));
    const missed = wanted.filter(uri => !asked.has(uri));
    console.log(`${town} in CesiumJS: ${wanted.length} contents, ${wanted.length - missed.length} asked for, `
      + `${features} features named, ${triangles} triangles drawn`);
    const found = [...problems, ...errors, ...foreign, ...missed.map(uri => `${uri} is never asked for`)];
    if (features === 0) found.push('no feature has a name');
    if (triangles === 0) found.push('nothing is drawn');
    for (const line of found) console.log(`  ${line}`);
    return found.length;
  });
}
process.exit(bad > 0 ? 1 : 0);
