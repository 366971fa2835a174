// Pages generated from tables: elements and attributes, parts with their images, messages, the legacy grammar.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const say = {
  en: { parts: 'Parts', units: 'U wide', made: 'of', messages: 'Diagnostics' },
  ja: { parts: '部材', units: 'U 幅', made: '材料:', messages: '指摘' },
};

/** Writes the pages in both languages. */
export function reference(site) {
  const parts = JSON.parse(execFileSync(site.hsd, ['parts', '--format', 'json'], { encoding: 'utf8', maxBuffer: 1 << 26 }));
  const pictures = picturesOfParts(site);
  for (const language of ['en', 'ja']) {
    const folder = language === 'ja' ? 'ja/' : '';
    catalogue(site, parts, pictures, language, `${folder}catalogue.html`);
    messages(site, language, `${folder}messages/index.html`);
  }
  legacy(site, 'legacy.html', 'Grammar of the legacy form');
  legacy(site, 'ja/legacy.html', '旧形式の文法');
  japaneseStart(site);
}

/** The images of all parts by code, extracted from the parts sheet. */
function picturesOfParts({ hsd, out }) {
  const folder = mkdtempSync(join(tmpdir(), 'hsd-site-'));
  const sheet = join(folder, 'parts.html');
  execFileSync(hsd, ['parts', '--sheet', sheet], { stdio: 'ignore' });
  const text = readFileSync(sheet, 'utf8');
  rmSync(folder, { recursive: true });
  mkdirSync(join(out, 'parts'), { recursive: true });
  const found = new Map();
  for (const [, kind, data, code] of text.matchAll(/<img src="data:image\/(\w+);base64,([^"]*)"[^]*?<code>([^<]{5})<\/code>/g)) {
    const name = `parts/${code.trim().replaceAll(' ', '_')}.${kind === 'jpeg' ? 'jpg' : kind}`;
    writeFileSync(join(out, name), Buffer.from(data, 'base64'));
    found.set(code, name);
  }
  return found;
}

function catalogue({ write, escape, relative }, parts, pictures, language, page) {
  const words = say[language];
  let body = `<h1>${words.parts}</h1>\n<ul class="parts">\n`;
  for (const part of parts.filter(p => p.code.trim())) {
    const picture = pictures.get(part.code);
    if (!picture) throw new Error(`no image of ${part.code}`);
    const [first, second] = language === 'ja' ? [part.ja, part.en] : [part.en, part.ja];
    body += `<li id="${part.code.trim().replaceAll(' ', '_')}"><img src="${relative(page, picture)}" alt="${escape(first)}" loading="lazy"><code>${escape(part.code)}</code> ${escape(first)}<br>`;
    body += `<small>${escape(second)}, <i>${escape(part.romaji)}</i>; ${part.width} ${words.units}; ${words.made} ${escape(part.made)}</small></li>\n`;
  }
  write(page, words.parts, `${body}</ul>\n`);
}

function messages({ root, write, escape, messages }, language, page) {
  const own = messages.filter(([source]) => source.includes('/ja/') === (language === 'ja'));
  let body = `<h1>${say[language].messages}</h1>\n<ul>\n`;
  for (const [source, to] of own) {
    const title = readFileSync(join(root, source), 'utf8').split('\n')[0].replace(/^# /, '');
    const words = escape(title).replace(/`([^`]*)`/g, '<code>$1</code>');
    body += `<li><a href="${to.split('/').pop()}">${words}</a></li>\n`;
  }
  write(page, say[language].messages, `${body}</ul>\n`);
}

/** The grammar of the legacy form, with the diagrams of its rules if they exist. */
function legacy({ root, out, write, escape, relative }, page, title) {
  const text = readFileSync(join(root, 'grammar/legacy.ebnf'), 'utf8');
  let pictures = [];
  try {
    pictures = readdirSync(join(root, 'grammar/pictures/legacy')).filter(n => n.endsWith('.svg'));
  } catch { /* no diagrams */ }
  const order = name => text.search(new RegExp(`^${name.replace('.svg', '')} `, 'm'));
  let body = `<h1>${title}</h1>\n`;
  for (const name of pictures.sort((a, b) => order(a) - order(b))) {
    mkdirSync(join(out, 'legacy'), { recursive: true });
    const svg = readFileSync(join(root, 'grammar/pictures/legacy', name), 'utf8');
    writeFileSync(join(out, 'legacy', name), svg);
    const [, width] = svg.match(/viewBox="0 0 (\d+)/);
    const rule = name.replace('.svg', '');
    body += `<h2 id="${rule}">${rule}</h2>\n<p><img src="${relative(page, `legacy/${name}`)}" alt="${rule}" width="${width}"></p>\n`;
  }
  write(page, title, `${body}<h2>EBNF</h2>\n<pre><code>${escape(text)}</code></pre>\n`);
}

function japaneseStart({ write }) {
  write('ja/index.html', 'hsd リファレンス', `<h1>hsd リファレンス</h1>
<p>家の壁をテキストで書くと、屋根の架かった 3D モデルになります。</p>
<ul>
<li><a href="tutorial.html">チュートリアル</a>: 何もないところから町並みまで</li>
<li><a href="readme.html">hsd とは、使い方、作例</a></li>
<li><a href="reference.html">リファレンス</a>: すべての要素、属性、設定、オプション</li>
<li><a href="legacy.html">旧形式の文法</a></li>
<li><a href="catalogue.html">部材</a>: 画像とコード</li>
<li><a href="messages/index.html">指摘</a>: 原因、例、直し方</li>
<li><a href="language.html">言語</a>: 壁のたどり方、旧形式、XML 形式</li>
<li><a href="types.html">家のひな形</a>、<a href="roofs.html">屋根</a>、<a href="dressing.html">屋根の納まり</a>、<a href="partitions.html">平面の分け方</a></li>
<li><a href="parts.html">部材の形</a>、<a href="xml.html">XML の範囲</a></li>
<li><a href="catalogs.html">自作部材とテクスチャー</a>、<a href="materials.html">材料と経年変化</a></li>
<li><a href="../index.html">細かな取り決め(英語)</a></li>
<li><a href="../glossary.html">用語集</a></li>
</ul>
`);
}
