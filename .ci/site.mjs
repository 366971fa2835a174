// node site.mjs HSD OUT_DIR [TYPE...]
// Builds the reference as a static site in English and Japanese: the pages of grammar/, all elements and attributes, all parts with their
// images, all messages, house types to turn with sliders (those named, or all, which takes some minutes; where HSD_WEB names what `.ci/web` makes, the page of types compiles texts itself). The site is self-contained: no request goes to another host. Exits with 1 on broken links.
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { dirname, join, posix, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { folder as modules } from './modules.mjs';
import { deadLinks } from './site_links.mjs';
import { reference } from './site_reference.mjs';
import { typePages } from './site_types.mjs';

const { Marked } = await import(pathToFileURL(join(modules, 'node_modules/marked/lib/marked.esm.js')));
const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, '..');
const [hsd, out, ...types] = process.argv.slice(2);
if (!out) throw new Error('usage: site.mjs HSD OUT_DIR');

/** Source files of the repository and their pages. */
const pages = new Map([
  ['grammar/README.md', 'index.html'],
  ['grammar/README.ja.md', 'ja/language.html'],
  ['README.md', 'readme.html'],
  ['README.ja.md', 'ja/readme.html'],
  ['docs/glossary.md', 'glossary.html'],
]);
for (const name of readdirSync(join(root, 'grammar')).filter(n => n.endsWith('.md') && !n.startsWith('README'))) {
  const japanese = name.endsWith('.ja.md');
  pages.set(`grammar/${name}`, japanese ? `ja/${name.replace('.ja.md', '.html')}` : name.replace('.md', '.html'));
}
for (const name of readdirSync(join(root, 'grammar/diagnostics')).filter(n => n.endsWith('.md'))) {
  pages.set(`grammar/diagnostics/${name}`, `messages/${name.replace('.md', '.html')}`);
  pages.set(`grammar/diagnostics/ja/${name}`, `ja/messages/${name.replace('.md', '.html')}`);
}
/** Folders and the pages that links to them lead to. */
const folders = new Map([['grammar/diagnostics', 'messages/index.html'], ['grammar/diagnostics/ja', 'ja/messages/index.html'], ['grammar/pictures/legacy', 'legacy.html'], ['examples', 'readme.html']]);

const menu = {
  en: [['index.html', 'The language'], ['tutorial.html', 'Tutorial'], ['reference.html', 'Reference'], ['legacy.html', 'Legacy form'], ['catalogue.html', 'Parts'], ['catalogs.html', 'Custom parts'],
    ['types.html', 'House types'], ['houses.html', 'Types to turn'], ['roofs.html', 'Roofs'], ['dressing.html', 'Roof details'], ['partitions.html', 'Partitions'], ['materials.html', 'Materials'], ['messages/index.html', 'Diagnostics'],
    ['glossary.html', 'Glossary']],
  ja: [['ja/index.html', 'はじめに'], ['ja/language.html', '言語'], ['ja/tutorial.html', 'チュートリアル'], ['ja/reference.html', 'リファレンス'], ['ja/legacy.html', '旧形式'], ['ja/catalogue.html', '部材'],
    ['ja/catalogs.html', '自作部材'], ['ja/types.html', '家のひな形'], ['ja/houses.html', 'ひな形を回す'], ['ja/roofs.html', '屋根'], ['ja/dressing.html', '屋根の納まり'],
    ['ja/partitions.html', '平面の分け方'], ['ja/materials.html', '材料'], ['ja/messages/index.html', '指摘'], ['glossary.html', '用語集']],
};

const relative = (from, to) => posix.relative(posix.dirname(from), to) || posix.basename(to);
const escape = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');
const plain = html => html.replace(/<[^>]*>/g, ' ').replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&#39;/g, "'").replace(/&amp;/g, '&').replace(/\s+/g, ' ');
const entries = { en: [], ja: [] };
const written = new Map();

/** The same page in the other language. */
const twin = page => {
  if (page === 'index.html') return 'ja/language.html';
  if (page === 'ja/language.html') return 'index.html';
  return page.startsWith('ja/') ? page.slice(3) : `ja/${page}`;
};

/** Turns the codes of messages into links to their pages. */
function withMessages(page, language, html) {
  const folder = language === 'ja' ? 'ja/messages' : 'messages';
  let inside = 0;
  return html.split(/(<[^>]*>)/).map(piece => {
    if (/^<(a|pre|h\d)[\s>]/.test(piece)) inside += 1;
    else if (/^<\/(a|pre|h\d)>/.test(piece)) inside -= 1;
    if (inside > 0 || piece.startsWith('<')) return piece;
    return piece.replace(/HSD\d{4}/g, code => pages.has(`grammar/diagnostics/${code}.md`)
      ? `<a href="${relative(page, `${folder}/${code}.html`)}">${code}</a>` : code);
  }).join('');
}

/** Search entries of a page and its anchors: title, link, text. */
function foundBy(page, title, body) {
  const starts = [...body.matchAll(/<(h2|h3|tr|li) id="([^"]+)">/g)];
  const words = (from, to) => plain(body.slice(from, to)).trim().slice(0, 400);
  const names = { tr: (id, text) => `${id.replace('-', ' ')}: ${text.split(' ').slice(1).join(' ')}`, li: (id, text) => text };
  const places = starts.map((start, i) => {
    const [, kind, id] = start;
    const text = words(start.index, starts[i + 1]?.index);
    const heading = plain(body.slice(start.index).match(/^<(h\d)[^>]*>([^]*?)<\/\1>/)?.[2] ?? '').trim();
    const name = names[kind]?.(id, text) ?? `${title}: ${heading}`;
    return [name.slice(0, 70), `${page}#${id}`, text];
  });
  return [[title, page, words(0, starts[0]?.index)], ...places];
}

/** Writes a page. */
function write(page, title, body) {
  const language = page.startsWith('ja/') ? 'ja' : 'en';
  written.set(page, { language, title, body: withMessages(page, language, body) });
  entries[language].push(...foundBy(page, title.replace(/`/g, ''), body));
}

/** Copies a file of the repository into the site and returns its path. */
function copied(path) {
  const to = posix.join('files', path);
  mkdirSync(dirname(join(out, to)), { recursive: true });
  copyFileSync(join(root, path), join(out, to));
  return to;
}

/** The target of a link in the site; undefined if it has none. */
function target(source, page, href) {
  if (/^[a-z]+:/.test(href) || href.startsWith('#')) return href;
  const [file, hash] = href.split('#');
  const path = posix.join(posix.dirname(source), file).replace(/\/$/, '');
  const known = pages.get(path) ?? folders.get(path);
  if (known) return relative(page, known) + (hash ? `#${hash}` : '');
  const there = existsSync(join(root, path)) ? statSync(join(root, path)) : undefined;
  if (!there) return href;
  return there.isDirectory() ? undefined : relative(page, copied(path));
}

/** Joins lines where a line break must not become a space: between Japanese characters and after Japanese punctuation. */
function joined(text) {
  const sign = '[\\p{Script=Han}\\p{Script=Hiragana}\\p{Script=Katakana}ー。、「」]';
  const breaks = new RegExp(`(?<=${sign})\\n *(?=${sign})|(?<=[。、])\\n *(?=[\`A-Za-z]|\\*\\*|\\d(?!\\d*\\. ))`, 'gu');
  return text.split(/(^```[^]*?^```)/m).map((piece, i) => i % 2 ? piece : piece.replace(breaks, '')).join('');
}

/** Adds an id to each row of the reference (`House-azimuth`), so that the search finds attributes. */
function withRows(source, html) {
  if (!/reference(\.ja)?\.md$/.test(source)) return html;
  return html.split(/(?=<h[23] )/).map(section => {
    const [, id, name] = section.match(/^<h[23] id="([^"]*)">(?:<code>([^<]*))?/) ?? [];
    return section.replace(/<tr>(\s*<td><code>([\w-]+)<\/code>)/g, `<tr id="${name ?? id}-$2">$1`);
  }).join('');
}

/** Renders a Markdown file as a page. */
function markdown(source, page) {
  const text = joined(readFileSync(join(root, source), 'utf8'));
  const used = new Map();
  const slug = words => {
    const base = words.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, '').trim().replace(/\s/g, '-');
    const count = used.get(base) ?? 0;
    used.set(base, count + 1);
    return count ? `${base}-${count}` : base;
  };
  const renderer = {
    heading({ tokens, depth, text }) {
      return `<h${depth} id="${escape(slug(text.replace(/`/g, '')))}">${this.parser.parseInline(tokens)}</h${depth}>\n`;
    },
    link({ href, tokens }) {
      const to = target(source, page, href);
      const words = this.parser.parseInline(tokens);
      return to === undefined ? words : `<a href="${escape(to)}">${words}</a>`;
    },
    image({ href, text }) {
      return `<img src="${escape(target(source, page, href))}" alt="${escape(text)}" loading="lazy">`;
    },
  };
  const title = text.match(/^# (.*)$/m)?.[1] ?? page;
  write(page, title, withRows(source, new Marked({ renderer }).parse(text)));
}

for (const [source, page] of pages) markdown(source, page);
reference({ hsd, root, out, write, escape, relative, messages: [...pages].filter(([s]) => /HSD\d/.test(s)) });
await typePages({ hsd, root, out, write, relative }, types);

const search = readFileSync(join(here, 'site_search.js'), 'utf8');
mkdirSync(out, { recursive: true });
copyFileSync(join(here, 'site.css'), join(out, 'site.css'));
writeFileSync(join(out, 'search.js'), search);
for (const language of ['en', 'ja']) {
  writeFileSync(join(out, `search-${language}.js`), `window.pages = ${JSON.stringify(entries[language])};\n`);
}
for (const [page, { language, title, body }] of written) {
  const link = to => escape(relative(page, to));
  const links = menu[language].map(([to, words]) => `<a href="${link(to)}"${to === page ? ' aria-current="page"' : ''}>${words}</a>`);
  const other = written.has(twin(page)) ? twin(page) : language === 'en' ? 'ja/index.html' : 'index.html';
  links.push(`<a href="${link(other)}" lang="${language === 'en' ? 'ja' : 'en'}">${language === 'en' ? '日本語' : 'English'}</a>`);
  const words = language === 'en' ? 'Search' : '検索';
  const html = `<!DOCTYPE html>
<html lang="${language}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>${escape(title.replace(/`/g, ''))} · hsd</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${link('site.css')}">
<script defer src="${link(`search-${language}.js`)}"></script>
<script defer src="${link('search.js')}" data-root="${escape(relative(page, 'site.css').replace('site.css', ''))}"></script>
</head>
<body>
<nav>${links.join('\n')}
<input type="search" placeholder="${words}" aria-label="${words}"><ul id="found"></ul></nav>
<main>
${body}</main>
</body>
</html>
`;
  mkdirSync(dirname(join(out, page)), { recursive: true });
  writeFileSync(join(out, page), html);
}

const dead = deadLinks(out);
for (const line of dead) console.error(line);
console.log(`${written.size} pages in ${out}, ${dead.length} dead links`);
if (dead.length > 0) process.exit(1);
