// node sheet.mjs PARTS.html OUT.jpg
// Renders the catalogue as one image, grammar/pictures/parts.jpg, from the output of `hsd parts --sheet PARTS.html`.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { browser } from './browser.mjs';

const [sheet, out] = process.argv.slice(2);
if (!out) throw new Error('usage: sheet.mjs PARTS.html OUT.jpg');
// Chromium cannot capture images higher than about 13,000 pixels, so everything is drawn smaller.
const style = 'html { font-size: 11px } body { max-width: none } li img { zoom: .6 }';
const running = await browser();
try {
  const page = await running.newPage({ viewport: { width: 1300, height: 800 } });
  await page.goto(pathToFileURL(resolve(sheet)).href);
  await page.addStyleTag({ content: style });
  await page.screenshot({ path: out, fullPage: true, type: 'jpeg', quality: 75 });
} finally {
  await running.close();
}
