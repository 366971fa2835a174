// Entry point: the live preview of a source file. With `?render=` it takes screenshots instead.

import { scriptInterface } from './scripting.ts';
import { page } from './page.ts';
import { fetchServerInfo } from './server/api.ts';
import { renderScreenshots } from './screenshots/screenshots.ts';
import { strings, setLanguage } from './ui/strings.ts';

const asked = new URLSearchParams(location.search);
const known = await fetchServerInfo();
const language = asked.get('lang');
setLanguage(language === 'ja' || language === 'en' ? language : known.language);

if (asked.has('render')) await renderScreenshots(asked);
else if (!document.createElement('canvas').getContext('webgl2')) document.body.append(strings.noWebgl);
else {
  const made = page(known.front);
  globalThis.hsd = scriptInterface(made);
  await made.app.start();
  const file = asked.get('file') ?? known.file ?? (known.files.length === 1 ? known.files[0]!.path : null);
  if (made.front) await made.front.start();
  else if (file) await made.app.openFile(file);
}
