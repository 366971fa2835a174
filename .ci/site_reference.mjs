// Pages generated from tables: elements and attributes, parts with their images, messages, the legacy grammar.
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const say = {
  en: {
    elements: 'Elements and attributes', attribute: 'attribute', values: 'values', default: 'default', meaning: 'meaning', needed: 'required', holds: 'Contains',
    about: 'Elements of the XML form, generated from the parser\'s table. Every value may contain an expression <code>{...}</code>.',
    around: 'the contents of the enclosing element', language: 'and control elements', nothing: 'nothing',
    parameters: 'All other attributes are parameters.', parts: 'Parts', units: 'U wide', made: 'of', messages: 'Messages',
    code: '`texturecode` is an alias of `code`.',
    kinds: { text: 'text', number: 'number', whole: 'whole number', numbers: 'numbers', pair: 'one or two numbers', place: 'two numbers', 'pair of whole numbers': 'one or two whole numbers', choice: '', choices: 'some of', 'choice or number': 'or a number', positions: 'positions, for example 2,5-7' },
    classes: { K: 'Walls', D: 'Doors', M: 'Windows' },
  },
  ja: {
    elements: '要素と属性', attribute: '属性', values: '値', default: '既定値', meaning: '意味', needed: '必須', holds: '中身',
    about: 'XML 形式の要素です。読み取りに使う表から生成しています。どの値にも式 <code>{...}</code> を書けます。',
    around: '外側の要素に書けるもの', language: 'と、制御の要素', nothing: 'なし',
    parameters: 'ほかの属性はすべて引数です。', parts: '部材', units: 'U 幅', made: '材料:', messages: '指摘',
    code: '`code` は `texturecode` とも書けます。',
    kinds: { text: '文字', number: '数', whole: '整数', numbers: '数の列', pair: '数 1 つまたは 2 つ', place: '数 2 つ', 'pair of whole numbers': '整数 1 つまたは 2 つ', choice: '', choices: 'いくつか', 'choice or number': 'または数', positions: '2,5-7 のような位置' },
    classes: {},
  },
};

/** Writes the pages in both languages. */
export function reference(site) {
  const table = JSON.parse(readFileSync(join(site.root, 'grammar/schema/elements.json'), 'utf8'));
  const parts = JSON.parse(execFileSync(site.hsd, ['parts', '--format', 'json'], { encoding: 'utf8', maxBuffer: 1 << 26 }));
  const pictures = picturesOfParts(site);
  for (const language of ['en', 'ja']) {
    const folder = language === 'ja' ? 'ja/' : '';
    elements(site, table.elements, language, `${folder}elements.html`);
    catalogue(site, parts, pictures, language, `${folder}catalogue.html`);
    messages(site, language, `${folder}messages/index.html`);
  }
  legacy(site, 'legacy.html', 'Grammar of the legacy form');
  legacy(site, 'ja/legacy.html', '旧形式の文法');
  japaneseStart(site);
}

function values(attribute, words, escape) {
  const list = attribute.words.map(w => `<code>${escape(w)}</code>`).join(' ');
  // Technical limits are not shown.
  const [least, most] = (attribute.range ?? [null, null]).map(n => n === null || Math.abs(n) >= 1e5 ? '' : n);
  const range = least !== '' || most !== ''
    ? ` ${least} … ${most}`
    : '';
  return [list, words.kinds[attribute.kind] + range].filter(Boolean).join(' ');
}

function elements({ write, escape }, all, language, page) {
  const words = say[language];
  const code = text => escape(text).replace(/`([^`]*)`/g, '<code>$1</code>');
  let body = `<h1>${words.elements}</h1>\n<p>${words.about} ${code(words.code)}</p>\n<p>`;
  body += all.map(e => `<a href="#${e.name}"><code>${e.name}</code></a>`).join(' ') + '</p>\n';
  for (const element of all) {
    const about = element[language][0].toUpperCase() + element[language].slice(1);
    body += `<h2 id="${element.name}"><code>&lt;${element.name}&gt;</code></h2>\n<p>${code(about)}${language === 'en' ? '.' : '。'}</p>\n`;
    if (element.attributes.length > 0) {
      body += `<table><tr><th>${words.attribute}</th><th>${words.values}</th><th>${words.default}</th><th>${words.meaning}</th></tr>\n`;
      for (const a of element.attributes) {
        const usual = a.required ? words.needed : a.default && `<code>${escape(a.default)}</code>`;
        body += `<tr id="${element.name}-${a.name}"><td><code>${a.name}</code></td><td>${values(a, words, escape)}</td><td>${usual}</td><td>${code(a[language])}</td></tr>\n`;
      }
      body += '</table>\n';
    }
    if (element.anyAttributes) body += `<p>${words.parameters}</p>\n`;
    const held = element.holds?.map(name => `<a href="#${name}"><code>${name}</code></a>`).join(' ');
    const inside = held === undefined ? words.around : held === '' ? words.nothing : `${held} ${words.language}`;
    body += `<p>${words.holds}: ${inside}</p>\n`;
  }
  write(page, words.elements, body);
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
<p>家の壁をテキストで書くと、屋根の架かった立体モデルになります。</p>
<ul>
<li><a href="tutorial.html">チュートリアル</a>: 何もないところから町並みまで</li>
<li><a href="readme.html">hsd とは、使い方、作例</a></li>
<li><a href="elements.html">XML 形式の要素と属性</a></li>
<li><a href="legacy.html">旧形式の文法</a></li>
<li><a href="catalogue.html">部材</a>: 画像とコード</li>
<li><a href="messages/index.html">指摘</a>: 原因、例、対処</li>
<li><a href="language.html">言語</a>: 壁の歩き方、旧形式、XML 形式</li>
<li><a href="types.html">家の類型</a>、<a href="roofs.html">屋根</a>、<a href="dressing.html">屋根に載るもの</a>、<a href="partitions.html">平面の分け方</a></li>
<li><a href="parts.html">部材の形</a>、<a href="xml.html">XML の範囲</a></li>
<li><a href="catalogs.html">自作の部材とテクスチャー</a>、<a href="materials.html">材料</a></li>
<li><a href="../index.html">細かな取り決め (英語)</a></li>
</ul>
`);
}
