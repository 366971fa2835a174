// node load.mjs FILE.glb...
// Loads each file with three.js in a browser and draws it once. Exits with 1 on console warnings or if a file shows nothing.
import { withPage } from './browser.mjs';

const files = process.argv.slice(2);
if (files.length === 0) throw new Error('no files');

const bad = await withPage({ script: 'load_page.mjs', files, width: 320, height: 240 }, async (page, problems) => {
  let bad = 0;
  for (const [index, file] of files.entries()) {
    const { triangles, textures, error } = await page.evaluate(n => window.show(n), index);
    console.log(`${file}: ${triangles ?? 0} triangles, ${textures ?? 0} textures`);
    const found = [...problems.splice(0), ...(error ? [error] : []), ...(triangles > 0 ? [] : ['nothing is drawn'])];
    for (const line of found) console.log(`  ${line}`);
    bad += found.length;
  }
  return bad;
});
process.exit(bad > 0 ? 1 : 0);
