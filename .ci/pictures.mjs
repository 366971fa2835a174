// node pictures.mjs OUT_DIR FILE.glb...
// Pictures of each model: NAME-front.jpg from the front left at eye height, NAME-above.jpg from the front right above,
// NAME-back.jpg from the rear above; HSD_VIEWS=eaves,above chooses others (eaves: from the front left at their height), HSD_SIZE=480x320
// their size. HSD_SAMPLES (default 32) = places of the light that are averaged; more is smoother.
import { mkdir, writeFile } from 'node:fs/promises';
import { basename, extname, join } from 'node:path';
import { with_page } from './browser.mjs';

const [folder, ...files] = process.argv.slice(2);
if (files.length === 0) throw new Error('usage: pictures.mjs OUT_DIR FILE.glb...');
const views = (process.env.HSD_VIEWS ?? 'front,above,back').split(',');
const size = (process.env.HSD_SIZE ?? '960x640').split('x').map(Number);
const samples = Number(process.env.HSD_SAMPLES ?? 32);

await mkdir(folder, { recursive: true });
await with_page({ script: 'pictures_page.mjs', files, width: size[0], height: size[1] }, async (page, complaints) => {
  for (const [index, file] of files.entries()) {
    const begun = Date.now();
    const pictures = await page.evaluate(given => window.take(...given), [index, samples, views, size]);
    for (const [view, data] of Object.entries(pictures)) {
      const name = `${basename(file, extname(file))}-${view}.jpg`;
      await writeFile(join(folder, name), Buffer.from(data.split(',')[1], 'base64'));
    }
    console.log(`${file}: ${Object.keys(pictures).join(', ')} in ${((Date.now() - begun) / 1000).toFixed(1)} s`);
    for (const line of complaints.splice(0)) console.log(`  ${line}`);
  }
});
