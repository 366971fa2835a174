/**
 * Tree-sitter grammar of HSD in both forms: lines of five-column codes, and XML.
 *
 * The kind of a line of codes depends on the lines before it, and codes are split by columns, including blanks: src/scanner.c does
 * both. Everything else is here. The grammar accepts slightly more than the compiler, so that an error does not affect the
 * highlighting around it.
 *
 * @file Tree-sitter grammar of HSD
 * @license MIT OR Apache-2.0
 */

/// <reference types="tree-sitter-cli/dsl" />
// @ts-check

const RANK = { or: 1, and: 2, not: 3, compare: 4, add: 5, multiply: 6, sign: 7 };

/** A word in upper or lower case: the compiler accepts both in roof lines, with a warning. */
const anyCase = (/** @type {string[]} */ ...words) =>
  token(new RegExp(words.map((w) => [...w].map((c) => `[${c}${c.toLowerCase()}]`).join('')).join('|')));

/** A line of the legacy form. */
const line = (/** @type {any} */ $, /** @type {any} */ rule) => seq(rule, $._eol);

/** Any prefix of a sequence of rules. */
const upTo = (/** @type {any[]} */ ...rules) =>
  rules.reduceRight((rest, rule) => optional(rest === null ? rule : seq(rule, rest)), null);

/** A left-associative binary expression. */
const chain = (/** @type {number} */ rank, /** @type {any} */ $, /** @type {any} */ ...signs) =>
  prec.left(rank, seq(field('left', $._operand), field('operator', signs.length > 1 ? choice(...signs) : signs[0]), field('right', $._operand)));

export default grammar({
  name: 'hsd',

  // In the order of `enum Token` in src/scanner.c.
  externals: ($) => [
    $._xml,
    $._number_line,
    $._setting_line,
    $._wall_line,
    $._roof_line,
    $.separator,
    $._eol,
    $._space,
    $.comment,
    $._whole,
    $._name,
    $.width,
    $.void,
    $.turn,
    $.next_storey,
    $._free_text,
    $._start_tag_name,
    $._end_tag_name,
    $._other_end_tag_name,
    '/>',
    $._implicit_end_tag,
    $._cut,
    $._recovering,
  ],

  extras: ($) => [/[ \t\f\u00a0\u3000]/, $._space, $.comment],

  supertypes: ($) => [$._operand],

  rules: {
    document: ($) => choice(seq($._xml, repeat($._node)), repeat(choice($.house, $._between))),

    // ---- The legacy form.

    _between: ($) => seq($.separator, $._eol),

    house: ($) =>
      prec.right(
        choice(
          seq($.header, repeat(choice($.storey, $._setting_line_)), optional($.roofs)),
          seq(repeat1($.storey), optional($.roofs)),
          $.roofs,
        ),
      ),

    header: ($) =>
      prec.right(
        choice(
          repeat1($._setting_line_),
          seq(
            repeat($._setting_line_),
            line($, $.place),
            repeat($._setting_line_),
            optional(seq(line($, $.heights), repeat($._setting_line_))),
          ),
        ),
      ),
    place: ($) =>
      seq(
        $._number_line,
        field('x', $.number),
        optional(seq(field('y', $.number), optional(field('azimuth', $.number)))),
      ),
    heights: ($) => seq($._number_line, repeat1($.number)),

    setting: ($) => seq($._setting_line, choice($._number_setting, $._word_setting, $._name_setting, $._other_setting)),
    _setting_line_: ($) => line($, $.setting),
    _number_setting: ($) =>
      seq(field('key', alias(choice('unit', 'seed', 'age'), $.key)), field('value', $.number)),
    _word_setting: ($) =>
      seq(
        field('key', alias(choice('roofs', 'method', 'street', 'era'), $.key)),
        field('value', alias(/[A-Za-z][A-Za-z-]*/, $.word)),
      ),
    _name_setting: ($) => seq(field('key', alias('name', $.key)), field('value', alias($._free_text, $.text))),

    // A misspelled or unfinished key.
    _other_setting: ($) =>
      seq(field('key', alias(/[\p{L}_][^ \t\f\r\n]*/, $.unknown)), optional(field('value', alias($._free_text, $.text)))),

    storey: ($) => prec.right(choice(seq(repeat1($._row_line), optional($._last_row_line)), $._last_row_line)),
    _row_line: ($) => seq($._wall_line, $.row, $._eol),
    _last_row_line: ($) => seq($._wall_line, optional($.row), $.next_storey, $._eol),
    row: ($) => choice(seq(repeat1($._piece), optional($.turn)), $.turn),
    _piece: ($) => choice($.code, $.void),

    code: ($) => choice(alias($._whole, $.part), seq(alias($._name, $.part), $.width)),

    roofs: ($) => prec.right(seq(line($, $.roof), repeat(choice(line($, $.roof), $._setting_line_)))),
    // Everything from the height on is optional while the line is being typed.
    roof: ($) =>
      seq(
        $._roof_line,
        field('covering', $.covering),
        field('direction', $.direction),
        upTo(
          field('height', choice($.number, $.any)),
          field('shape', $.shape),
          field('a0', $.number),
          field('b0', $.number),
          field('a1', $.number),
          field('b1', $.number),
          repeat1($.option),
        ),
      ),
    covering: ($) => choice(anyCase('K', 'G', 'I', 'S', 'H', 'Y', 'T'), '*'),
    direction: ($) => choice(anyCase('X', 'Y', 'F', 'B', 'L', 'R'), '*'),
    any: ($) => '*',
    shape: ($) =>
      choice(anyCase('KIR', 'YOS', 'YOK', 'IRI', 'HAK', 'HOG', 'KAT', 'HIS', 'TER', 'KAR', 'RIK', 'KOS', 'MAN', 'CHI', 'NOK', 'KOY', 'UDA'), '*', alias(/[\p{L}\-]+/, $.unknown)),
    option: ($) =>
      choice(
        field('name', alias(anyCase('O'), $.letter)),
        seq(
          field('name', alias(anyCase('P', 'E', 'G', 'T', 'M', 'S', 'C', 'R'), $.letter)),
          field('value', $.number),
        ),
      ),
    number: ($) => /[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]+)?/,

    // ---- The XML form.

    _node: ($) => choice($.element, $.processing_instruction, $.cdata, $._piece, $.expression),

    element: ($) =>
      choice($.self_closing_tag, seq($.start_tag, repeat($._node), choice($.end_tag, alias($._implicit_end_tag, $.unclosed)))),
    start_tag: ($) =>
      seq('<', alias($._start_tag_name, $.tag_name), repeat($.attribute), choice('>', alias($._cut, $.unclosed))),
    self_closing_tag: ($) => seq('<', alias($._start_tag_name, $.tag_name), repeat($.attribute), '/>'),
    end_tag: ($) =>
      seq('</', choice(alias($._end_tag_name, $.tag_name), alias($._other_end_tag_name, $.erroneous_tag_name)), '>'),

    attribute: ($) => seq($.attribute_name, '=', $._quoted),
    attribute_name: ($) => /[\p{L}_:][\p{L}\p{N}_:.\-]*/,
    _quoted: ($) =>
      choice(
        seq('"', optional(alias($._double_value, $.attribute_value)), choice(token.immediate('"'), alias($._cut, $.unclosed))),
        seq("'", optional(alias($._single_value, $.attribute_value)), choice(token.immediate("'"), alias($._cut, $.unclosed))),
      ),
    _double_value: ($) =>
      repeat1(choice(token.immediate(/[^"{&<]+/), token.immediate('&'), $.reference, $.expression)),
    _single_value: ($) =>
      repeat1(choice(token.immediate(/[^'{&<]+/), token.immediate('&'), $.reference, $.expression)),
    reference: ($) => token.immediate(/&[#A-Za-z][A-Za-z0-9]*;/),

    processing_instruction: ($) => token(seq('<?', /([^?]|\?+[^?>])*/, /\?+>/)),
    cdata: ($) => token(seq('<![CDATA[', /([^\]]|\][^\]]|\]\]+[^\]>])*/, /\]\]+>/)),

    // ---- Expressions.

    expression: ($) => seq(choice('{', token.immediate('{')), $._operand, '}'),
    _operand: ($) =>
      choice($.binary, $.not, $.sign, $.parentheses, $.call, $.identifier, alias($._plain_number, $.number), $.boolean,
        $.string),
    binary: ($) =>
      choice(
        chain(RANK.or, $, 'or'),
        chain(RANK.and, $, 'and'),
        chain(RANK.compare, $, '=', '==', '!=', '&lt;', '&lt;=', '>', '>=', '&gt;', '&gt;='),
        chain(RANK.add, $, '+', '-', '−'),
        chain(RANK.multiply, $, '*', '×', '/', '÷', '%'),
      ),
    not: ($) => prec(RANK.not, seq('not', $._operand)),
    sign: ($) => prec(RANK.sign, seq(choice('-', '−', '+'), $._operand)),
    parentheses: ($) => seq('(', $._operand, ')'),
    call: ($) =>
      seq(field('function', $.identifier), '(', optional(seq($._operand, repeat(seq(',', $._operand)))), ')'),
    identifier: ($) => /[\p{L}_][\p{L}\p{N}_]*/,
    _plain_number: ($) => /([0-9]+(\.[0-9]+)?|\.[0-9]+)([eE][+-]?[0-9]+)?/,
    boolean: ($) => choice('true', 'false', 'yes', 'no'),
    string: ($) =>
      token(choice(/'[^'"<]*'/, /"[^'"<]*"/, /&apos;[^'"<&]*&apos;/, /&quot;[^'"<&]*&quot;/)),
  },
});
