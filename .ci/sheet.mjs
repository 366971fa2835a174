// node sheet.mjs PARTS.html OUT.jpg
// The catalogue as one picture, grammar/pictures/parts.jpg, from what `hsd parts --sheet PARTS.html` writes.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { browser } from './browser.mjs';

const [sheet, out] = process.argv.slice(2);
if (!out) throw new Error('usage: sheet.mjs PARTS.html OUT.jpg');
// Chromium begins a picture of more than some 13,000 lines anew, so everything is drawn smaller.
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
