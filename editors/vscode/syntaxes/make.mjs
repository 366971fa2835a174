// node syntaxes/make.mjs [--check]
// Writes hsd.tmLanguage.json. The expressions for columns are too long to be written by hand, so they are assembled here from
// named pieces. With --check it only compares the file with its output.
//
// The legacy form is matched line by line: the kind of a line follows from that line alone, so that an error affects no other line.
// A line that begins with a tag starts the XML form, which continues to the end of the file, as in the compiler.
import { readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

const NUMBER = '[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][-+]?\\d+)?';
const WORD_END = '(?=\\s|$)';

/** The patterns of codes: `column` matches one column, `stop` what may follow a shortened code. */
function codes(column, stop) {
  // A full-width space fills two columns, a full-width letter one, and so does a space typed among full-width letters.
  const wide = '[\\uFF01-\\uFF5E]', blank = '\\x{3000}';
  const shapes = ['ooooo', 'ooob', 'oobo', 'oboo', 'booo', 'obb', 'bob', 'bbo']
    .map(shape => shape.replace(/o+/g, run => `${column}{${run.length}}`).replace(/b/g, blank));
  const code = `(?:${wide}(?:${wide}|(?<=[\\uFF01-\\uFF5E\\x{3000}])${blank}){4}|${shapes.join('|')})`;
  const empty = '(?:\\.{5}| {5})';
  // A code that begins with a blank reveals shifted columns.
  const shifted = `(?= )${code}`;
  const cell = `(?:(${empty})|(${shifted})|(${code}))`;
  const scopes = kind => [
    { name: 'constant.language.void.hsd' },
    { name: 'invalid.illegal.shifted.hsd' },
    { name: kind, patterns: [{ include: '#wide' }, { include: '#width' }] },
  ];
  const captures = kinds => Object.fromEntries(kinds.flatMap(scopes).map((scope, i) => [i + 1, scope]));
  const odd = 'entity.name.function.code.odd.hsd', even = 'entity.name.type.code.even.hsd';
  // The last code of a line may lack its padding.
  const short = `(?=\\S)(?![LRlr]\\s*(?:$|\\^|<))((?:${column}|\\x{3000}){1,4})(?=${stop})`;
  const last = (kind, group) => ({ [group]: { name: kind, patterns: [{ include: '#wide' }] } });
  return [
    { match: `${cell}${cell}`, captures: captures([odd, even]) },
    { match: `${cell}${short}`, captures: { ...captures([odd]), ...last(even, 4) } },
    { match: cell, captures: captures([odd]) },
    { match: short, captures: last(odd, 1) },
  ];
}

// A `#` after a blank begins a comment even among codes; the compiler warns about it.
const LEGACY_COLUMN = '(?:(?!(?<= )#)[^\\^\\t\\x{3000}])';
const XML_COLUMN = '(?:&(?:#\\d+|#x[0-9A-Fa-f]+|\\w+);|[^<{}&\\t\\x{3000}])';
// The Japanese name of a part may replace its code, padded to whole codes.
const FOREIGN = '[^\\x00-\\x7F\\x{3000}\\uFF01-\\uFF5E]';
const PART_NAME = `(?:${FOREIGN}{5})*(?:${FOREIGN} {0,4}|${FOREIGN}{2} {0,3}|${FOREIGN}{3} {0,2}|${FOREIGN}{4} ?|(?<=${FOREIGN}))`;

const numeric = { match: `(?<=^|\\s)${NUMBER}${WORD_END}`, name: 'constant.numeric.hsd' };
const lineComment = {
  begin: '(?<=^|\\s)#', end: '$', name: 'comment.line.number-sign.hsd',
  beginCaptures: { 0: { name: 'punctuation.definition.comment.hsd' } },
};
const key = (words, patterns) => ({
  begin: `^(\\s*)(${words})${WORD_END}`, end: '$', name: 'meta.header.hsd',
  beginCaptures: { 2: { name: 'keyword.other.setting.hsd' } },
  patterns: [...patterns, lineComment, { match: '\\S+', name: 'string.unquoted.hsd' }],
});
const words = list => ({ match: `(?<=\\s)(?:${list})${WORD_END}`, name: 'constant.language.hsd' });

const legacy = {
  comment: {
    begin: '^\\s*(#|//|/\\*|;)', end: '$', name: 'comment.line.number-sign.hsd',
    beginCaptures: { 1: { name: 'punctuation.definition.comment.hsd' } },
  },
  separator: {
    match: '^\\s*(%)(.*)$', name: 'meta.separator.hsd',
    captures: { 1: { name: 'keyword.control.separator.hsd' }, 2: { name: 'comment.line.hsd' } },
  },
  numbers: {
    begin: `^(?=\\s*${NUMBER}${WORD_END})`, end: '$', name: 'meta.header.hsd',
    patterns: [numeric, lineComment, { match: '\\S+', name: 'invalid.illegal.number.hsd' }],
  },
  settings: {
    patterns: [
      {
        match: '^(\\s*)(name)(?:\\s+(.*?))?\\s*$', name: 'meta.header.hsd',
        captures: { 2: { name: 'keyword.other.setting.hsd' }, 3: { name: 'string.unquoted.name.hsd' } },
      },
      key('unit|seed|age', [numeric]),
      key('roofs', [words('auto|explicit')]),
      key('method', [words('least-cut|kd|branch-cut|skeleton')]),
      key('street', [words('yes|no')]),
      key('era', [words('E|M|N|all')]),
      // A misspelled key: all lower case, unlike any code.
      { ...key('[a-z][a-z-]+:?', [numeric]), beginCaptures: { 2: { name: 'variable.other.setting.hsd' } } },
    ],
  },
  roof: {
    begin: '^\\s*([A-Za-z])\\s+([A-Za-z])(?=\\s|$)', end: '$', name: 'meta.roof.hsd',
    beginCaptures: {
      1: { name: 'keyword.other.covering.hsd' },
      2: { name: 'constant.language.direction.hsd' },
    },
    patterns: [
      { match: '(?<=\\s)(?:KIR|YOS|YOK|IRI|HAK|HOG|KAT|HIS|TER|KAR|RIK|KOS|MAN|CHI|NOK|KOY|UDA)(?=\\s|$)', name: 'entity.name.type.shape.hsd' },
      numeric,
      { match: '(?<=\\s)\\*(?=\\s|$)', name: 'constant.language.height.hsd' },
      {
        match: `(?<=\\s)([PEGTSCRM])(${NUMBER})${WORD_END}`,
        captures: { 1: { name: 'variable.parameter.option.hsd' }, 2: { name: 'constant.numeric.hsd' } },
      },
      { match: `(?<=\\s)O${WORD_END}`, name: 'variable.parameter.option.hsd' },
      lineComment,
      { match: '\\S+', name: 'string.unquoted.hsd' },
    ],
  },
  wall: {
    begin: '^(?=.*\\S)', end: '$', name: 'meta.codes.hsd',
    patterns: [
      { match: '([LR])(?=\\s*(?:\\^|$))', captures: { 1: { name: 'keyword.control.turn.hsd' } } },
      { match: '[lr](?=\\s*$)', name: 'keyword.control.turn.hsd' },
      { match: '([LR]) +(?=\\S)', captures: { 1: { name: 'keyword.control.turn.hsd' } } },
      { match: '\\^\\s*', name: 'keyword.control.storey.hsd' },
      { match: '\\s*(#.*)$', captures: { 1: { name: 'comment.line.number-sign.hsd' } } },
      { match: '\\s+$' },
      { match: `(?=${FOREIGN})${PART_NAME}`, name: 'string.unquoted.part-name.hsd' },
      ...codes(LEGACY_COLUMN, '\\s*$|\\^|\\t|(?<= )#'),
      { match: '\\t+', name: 'invalid.deprecated.tab.hsd' },
      { match: '\\S', name: 'invalid.illegal.column.hsd' },
    ],
  },
};

const NAME = '[\\p{L}_][\\p{L}\\p{N}_]*';
const CONTROL = 'if|else|repeat|random|choice|define|use|include|let|Param|replace|split|upper|lower|change|remove';
const CODED = 'code|texturecode|with|base|texture';

/** An expression in braces; `stop` ends one without a closing brace, `quotes` are the quotes of its strings. */
const expression = (stop, quotes) => ({
  begin: '\\{', end: `(\\})|(?=${stop})|$`, name: 'meta.expression.hsd',
  beginCaptures: { 0: { name: 'punctuation.section.embedded.begin.hsd' } },
  endCaptures: { 1: { name: 'punctuation.section.embedded.end.hsd' } },
  patterns: [
    ...quotes.map(quote => ({ match: `${quote}[^${quote}]*${quote}`, name: 'string.quoted.other.hsd' })),
    { include: '#terms' },
  ],
});

const entity = {
  match: '(&)(#\\d+|#x[0-9A-Fa-f]+|amp|lt|gt|quot|apos)(;)', name: 'constant.character.entity.hsd',
};

/** A quoted value; `inside` are additional patterns for its contents. */
const value = (quote, kind, inside) => ({
  begin: quote, end: `${quote}|(?=<)`, name: `string.quoted.${kind}.hsd`,
  beginCaptures: { 0: { name: 'punctuation.definition.string.begin.hsd' } },
  endCaptures: { 0: { name: 'punctuation.definition.string.end.hsd' } },
  patterns: [expression(`[${quote}<]`, quote === '"' ? ["'"] : ['"']), entity, ...inside],
});
const values = inside => [value('"', 'double', inside), value("'", 'single', inside)];

const numberInValue = { match: `(?<=["'\\s,])${NUMBER}(?=["'\\s,])`, name: 'constant.numeric.hsd' };
// Names of images and custom parts may be long; codes are separated by commas.
const codeInValue = { match: `[^,"'{}&<\\s](?:[^,"'{}&<]*[^,"'{}&<\\s])?`, name: 'entity.name.type.code.hsd' };

const attribute = (name, scope, inside) => ({
  begin: `(?<=\\s|["'])(${name})\\s*(=)\\s*(?=["'])`, end: '(?<=["\'])|(?=[<>])',
  beginCaptures: { 1: { name: scope }, 2: { name: 'punctuation.separator.key-value.hsd' } },
  patterns: values(inside),
});

const tag = (names, scope, attributes) => ({
  begin: `(</?)(${names})(?=[\\s/>]|$)`, end: '(/?>)|(?=<)', name: 'meta.tag.hsd',
  beginCaptures: { 1: { name: 'punctuation.definition.tag.begin.hsd' }, 2: { name: scope } },
  endCaptures: { 1: { name: 'punctuation.definition.tag.end.hsd' } },
  patterns: [...attributes, { include: '#attribute' }],
});

const xml = {
  xml: {
    begin: '^\\s*(?=<[A-Za-z?!])', end: '(?!)', name: 'meta.xml.hsd',
    patterns: [
      { include: '#markup' },
      { match: '^[ \\t]+' },
      { match: '(?<=>)[ \\t]+(?=<|$)' },
      { include: '#text' },
    ],
  },
  markup: {
    patterns: [
      {
        begin: '<!--', end: '-->', name: 'comment.block.hsd',
        captures: { 0: { name: 'punctuation.definition.comment.hsd' } },
      },
      { begin: '<!\\[CDATA\\[', end: '\\]\\]>', name: 'string.unquoted.cdata.hsd' },
      {
        begin: '(<\\?)([\\w:.-]+)', end: '\\?>', name: 'meta.preprocessor.hsd',
        captures: { 1: { name: 'punctuation.definition.tag.hsd' }, 2: { name: 'keyword.other.instruction.hsd' } },
        endCaptures: { 0: { name: 'punctuation.definition.tag.hsd' } },
        patterns: [{ include: '#attribute' }],
      },
      { begin: '<!', end: '>', name: 'invalid.illegal.doctype.hsd' },
      tag('define|use', 'keyword.control.hsd', [
        attribute('name', 'entity.other.attribute-name.hsd', [{ match: `[^{}"'&<]+`, name: 'entity.name.function.piece.hsd' }]),
        attribute(NAME, 'variable.parameter.hsd', [numberInValue]),
      ]),
      tag('Param|let', 'keyword.control.hsd', [
        attribute('name', 'entity.other.attribute-name.hsd', [{ match: `[^{}"'&<]+`, name: 'variable.other.hsd' }]),
      ]),
      tag(CONTROL, 'keyword.control.hsd', []),
      tag('[\\p{L}_:][\\p{L}\\p{N}_:.-]*', 'entity.name.tag.hsd', []),
      { match: '(</?)(?=[\\s>])|<', name: 'invalid.illegal.tag.hsd' },
    ],
  },
  attribute: {
    patterns: [
      attribute(CODED, 'entity.other.attribute-name.hsd', [codeInValue, { match: ',', name: 'punctuation.separator.hsd' }]),
      attribute('[\\p{L}_:][\\p{L}\\p{N}_:.-]*', 'entity.other.attribute-name.hsd', [numberInValue]),
      { match: '[^\\s=<>/"\']+', name: 'entity.other.attribute-name.hsd' },
      { match: '=', name: 'punctuation.separator.key-value.hsd' },
      ...values([]),
    ],
  },
  text: {
    patterns: [
      expression('<', ["'", '"']),
      { match: '[LR^](?=\\s*(?:<|$))', name: 'keyword.control.turn.hsd' },
      { match: '[ \\t]+(?=$)|[ \\t]{1,4}(?=[<{])' },
      ...codes(XML_COLUMN, '[<{}&]|\\t|$').map(rule => ({ ...rule, name: 'meta.codes.hsd' })),
      { match: '\\t+', name: 'invalid.deprecated.tab.hsd' },
      { match: '[&}]', name: 'invalid.illegal.character.hsd' },
    ],
  },
  terms: {
    patterns: [
      { match: '(?:\\d+\\.?\\d*|\\.\\d+)', name: 'constant.numeric.hsd' },
      { match: '\\b(?:and|or|not)\\b', name: 'keyword.operator.word.hsd' },
      { match: '\\b(?:true|false|yes|no)\\b', name: 'constant.language.hsd' },
      { match: '\\bk\\b', name: 'variable.language.storey.hsd' },
      { match: '\\b(?:min|max|floor|ceil|round|abs|clamp)(?=\\s*\\()', name: 'support.function.hsd' },
      { match: NAME, name: 'variable.other.hsd' },
      { match: '&(?:lt|gt|amp|quot|apos);=?|[!<>]=|[-+*/%=<>]', name: 'keyword.operator.hsd' },
      { match: '[(),]', name: 'punctuation.section.parens.hsd' },
    ],
  },
};

const grammar = {
  $schema: 'https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json',
  comment: 'Generated by syntaxes/make.mjs: do not edit.',
  name: 'HSD house',
  scopeName: 'source.hsd',
  fileTypes: ['hsd'],
  patterns: [
    { include: '#xml' },
    { include: '#comment' },
    { include: '#separator' },
    { include: '#numbers' },
    { include: '#settings' },
    { include: '#roof' },
    { include: '#wall' },
  ],
  repository: {
    ...legacy,
    ...xml,
    // Inside a code: full-width characters, and the fifth column where it gives the part's width in units.
    wide: { match: '[\\x{3000}\\uFF01-\\uFF5E]', name: 'invalid.deprecated.full-width.hsd' },
    width: { match: '(?<=[A-Z0-9 ]{4})[0-9h]$', name: 'constant.numeric.width.hsd' },
  },
};

const path = fileURLToPath(new URL('hsd.tmLanguage.json', import.meta.url));
const text = `${JSON.stringify(grammar, null, 2)}\n`;
if (process.argv[2] === '--check') {
  if (readFileSync(path, 'utf8') !== text) throw new Error('syntaxes/hsd.tmLanguage.json: run node syntaxes/make.mjs');
} else {
  writeFileSync(path, text);
}
