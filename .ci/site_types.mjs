// The page of house types to turn: each with sliders, whose models are built beforehand, one parameter at a time. Where HSD_WEB names
// hsd as a module of WebAssembly (`.ci/web`), sliders go together and texts can be changed: the page compiles them.
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';

const say = {
  en: { title: 'House types to turn', type: 'Type', text: 'Its text', as: 'as the text says', yes: 'yes', no: 'no',
    live: 'Drag to turn, roll to zoom. Sliders go together, and the text can be changed: <code>hsd</code> runs in this page. Nothing is sent anywhere.',
    how: 'Drag to turn, roll to zoom. A slider changes one parameter and leaves the others to the text; in <code>hsd view</code> and Blender all of them go together.' },
  ja: { title: '回して見る家のひな形', type: 'ひな形', text: 'テキスト', as: 'テキストのまま', yes: 'あり', no: 'なし',
    live: 'ドラッグで回し、ホイールで拡大します。スライダーは組み合わせて動かせ、テキストも変えられます。<code>hsd</code> はこのページの中で動き、何も送りません。',
    how: 'ドラッグで回し、ホイールで拡大します。スライダーはひとつのパラメーターを変え、ほかはテキストのままです。<code>hsd view</code> と Blender では組み合わせて変えられます。' },
};

/** So many parameters have a slider, with so many values; more of these where the page builds. */
const PARAMETERS = 5, VALUES = 5, LIVE = 33;
/** What one does not see from outside. */
const UNSEEN = new Set(['rooms', 'mirrored']);

/** Values of a parameter with that of the text among them, in order; few enough to build each. */
function values({ value, min, max, step, choices }, most) {
  if (choices.length > 0) return choices.length <= most ? choices : [...new Set([value, ...choices])].slice(0, most);
  if (typeof value === 'boolean') return [false, true];
  if (typeof value !== 'number' || min === null || max === null) return [];
  // A range for plots of any size has few houses at its end.
  const end = Math.min(max, Math.max(value * 2, min)), by = step || (end - min) / (most - 1);
  const steps = Array.from({ length: most }, (_, k) => min + Math.round((end - min) * k / (most - 1) / by) * by);
  return [...new Set([...steps, value].map(v => Number(v.toFixed(3))))].filter(v => v <= max).sort((a, b) => a - b);
}

/** hsd as a module of WebAssembly. */
const live = process.env.HSD_WEB;

const spelled = value => value === true ? 'yes' : value === false ? 'no' : String(value);

/** Changes the JSON of a .glb. */
function edited(glb, change) {
  const length = glb.readUInt32LE(12), json = JSON.parse(glb.subarray(20, 20 + length));
  change(json);
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const rest = glb.subarray(20 + length), head = Buffer.alloc(20);
  glb.copy(head, 0, 0, 20);
  head.writeUInt32LE(20 + text.length + rest.length, 8);
  head.writeUInt32LE(text.length, 12);
  return Buffer.concat([head, text, rest]);
}

/** Builds one model into the site; its images are shared by all, under names of their content. */
function built({ hsd, out }, work, source, name, options) {
  const file = join(work, 'm.glb'), models = join(out, 'models');
  execFileSync(hsd, ['build', '--quiet', '--detail', '1', '--textures-beside', source, ...options, '-o', file], { stdio: ['ignore', 'ignore', 'pipe'] });
  mkdirSync(join(models, 'images'), { recursive: true });
  writeFileSync(join(models, name), edited(readFileSync(file), json => {
    for (const image of json.images ?? []) {
      const bytes = readFileSync(join(work, decodeURIComponent(image.uri)));
      image.uri = `images/${createHash('sha256').update(bytes).digest('hex').slice(0, 16)}${extname(image.uri)}`;
      const target = join(models, image.uri);
      if (!existsSync(target)) writeFileSync(target, bytes);
    }
  }));
  rmSync(join(work, 'm_textures'), { recursive: true, force: true });
  return `models/${name}`;
}

/** The text of a type with what it includes. */
function whole(site, work, type) {
  const file = join(work, `${type}.hsd`);
  execFileSync(site.hsd, ['new', type, '-o', file], { stdio: ['ignore', 'ignore', 'pipe'] });
  const text = readFileSync(file, 'utf8');
  rmSync(file);
  return text;
}

/** The models of a type: that of its text, and one for each other value of each parameter. */
function variants(site, work, type) {
  const source = join(site.root, 'library', `${type}.hsd`);
  const all = JSON.parse(execFileSync(site.hsd, ['params', '--format', 'json', source], { encoding: 'utf8' }));
  const file = built(site, work, source, `${type}.glb`, []);
  const sliders = all.filter(p => !UNSEEN.has(p.name)).map(p => ({ ...p, values: values(p, VALUES), live: values(p, LIVE) })).filter(p => p.values.length > 1).slice(0, PARAMETERS);
  return { type, file, text: live ? whole(site, work, type) : '', sliders: sliders.map(({ name, value, unit, doc, doc_ja: ja, values, live: all }) => ({
    name, unit, doc: { en: doc ?? '', ja: ja ?? doc ?? '' }, values: (live ? all : values).map(spelled), at: (live ? all : values).indexOf(value),
    files: live ? [] : values.map((v, k) => v === value ? file : built(site, work, source, `${type}-${name}-${k}.glb`, ['--param', `${name}=${spelled(v)}`])),
  })) };
}

/** Bundles a script of the page. */
async function bundled(site, from, to) {
  const { build } = createRequire(join(site.root, 'view/node_modules/'))('esbuild');
  await build({
    entryPoints: [join(site.root, '.ci', from)], outfile: join(site.out, to), bundle: true, minify: true,
    format: 'iife', target: 'es2022', legalComments: 'inline', nodePaths: [join(site.root, 'view/node_modules')],
  });
}

/** Writes the pages and the models of the types named, or of all that have parameters. */
export async function typePages(site, named) {
  const work = mkdtempSync(join(tmpdir(), 'hsd-site-'));
  try {
    const texts = readdirSync(join(site.root, 'library')).map(name => name.replace(/\.hsd$/, ''));
    const has = type => /<Param\b/.test(readFileSync(join(site.root, 'library', `${type}.hsd`), 'utf8'));
    const types = (named.length > 0 ? named : texts.filter(has)).map(type => variants(site, work, type));
    await bundled(site, 'site_types_page.mjs', 'types-page.js');
    if (live) {
      copyFileSync(live, join(site.out, 'hsd.wasm'));
      await bundled(site, 'site_types_worker.mjs', 'types-worker.js');
    }
    for (const language of ['en', 'ja']) {
      const page = language === 'ja' ? 'ja/houses.html' : 'houses.html', words = say[language];
      const data = { root: site.relative(page, 'site.css').replace('site.css', ''), language, words, types, live: Boolean(live) };
      const json = JSON.stringify(data).replaceAll('<', '\\u003c');
      site.write(page, words.title, `<h1>${words.title}</h1>\n<p>${live ? words.live : words.how}</p>\n<div id="houses"></div>\n`
        + `<script type="application/json" id="types">${json}</script>\n<script defer src="${data.root}types-page.js"></script>\n`);
    }
  } finally {
    rmSync(work, { recursive: true });
  }
}
