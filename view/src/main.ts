// The page: the model of a text, kept up with what is saved. With `?render=` it draws pictures and nothing else.

import { exposed } from './expose.ts';
import { page } from './page.ts';
import { hello } from './server.ts';
import { stills } from './still.ts';
import { words, speak } from './words.ts';

const asked = new URLSearchParams(location.search);
const known = await hello();
const language = asked.get('lang');
speak(language === 'ja' || language === 'en' ? language : known.language);

if (asked.has('render')) await stills(asked);
else if (!document.createElement('canvas').getContext('webgl2')) document.body.append(words.no_webgl);
else {
  const made = page();
  globalThis.hsd = exposed(made);
  await made.app.begin();
  const file = asked.get('file') ?? known.file ?? (known.files.length === 1 ? known.files[0]!.path : null);
  if (file) await made.app.choose(file);
}
