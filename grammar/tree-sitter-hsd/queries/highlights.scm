; No two patterns match the same node, since editors differ in which one wins. Patterns with #match? and #not-match? are mutually
; exclusive.

(comment) @comment

; ---- The legacy form.

(key) @keyword
(setting value: (word) @constant.builtin)
(setting value: (text) @string)
(number) @number
(separator) @keyword

; Codes, in both forms.
(part) @constant
(width) @number
(void) @punctuation.special
(turn) @keyword
(next_storey) @keyword

(covering) @type
(direction) @constant.builtin
(any) @operator
(shape) @type
(option name: (letter) @property)

; ---- The XML form.

(start_tag (tag_name) @tag)
(self_closing_tag (tag_name) @tag)
(end_tag (tag_name) @tag)
(erroneous_tag_name) @error
[ "<" ">" "</" "/>" ] @punctuation.bracket

(attribute_name) @attribute
(attribute "=" @operator)
(attribute [ "\"" "'" ] @punctuation.delimiter)

((attribute
  (attribute_name) @attribute
  (attribute_value) @constant)
  (#match? @attribute "^(code|texturecode|with|base)$"))

((self_closing_tag
  (tag_name) @tag
  (attribute
    (attribute_name) @attribute
    (attribute_value) @variable.parameter))
  (#match? @tag "^(Param|let)$")
  (#match? @attribute "^name$"))

((start_tag
  (tag_name) @tag
  (attribute
    (attribute_name) @attribute
    (attribute_value) @function))
  (#match? @tag "^define$")
  (#match? @attribute "^name$"))

((self_closing_tag
  (tag_name) @tag
  (attribute
    (attribute_name) @attribute
    (attribute_value) @function))
  (#match? @tag "^(use|define)$")
  (#match? @attribute "^name$"))

; All other values.
((attribute
  (attribute_name) @attribute
  (attribute_value) @string)
  (#not-match? @attribute "^(code|texturecode|with|base|name)$"))

((self_closing_tag
  (tag_name) @tag
  (attribute
    (attribute_name) @attribute
    (attribute_value) @string))
  (#not-match? @tag "^(Param|let|use|define)$")
  (#match? @attribute "^name$"))

((start_tag
  (tag_name) @tag
  (attribute
    (attribute_name) @attribute
    (attribute_value) @string))
  (#not-match? @tag "^define$")
  (#match? @attribute "^name$"))

(reference) @string.escape
(cdata) @string
(processing_instruction) @keyword

; ---- Expressions.

(expression [ "{" "}" ] @punctuation.special)
(parentheses [ "(" ")" ] @punctuation.bracket)
(call function: (identifier) @function.builtin)
(call [ "(" ")" ] @punctuation.bracket)
(call "," @punctuation.delimiter)
(binary operator: _ @operator)
(not "not" @operator)
(sign [ "-" "−" "+" ] @operator)
(boolean) @constant.builtin
(string) @string

; All operands except function names.
(expression (identifier) @variable)
(parentheses (identifier) @variable)
(binary left: (identifier) @variable)
(binary right: (identifier) @variable)
(not (identifier) @variable)
(sign (identifier) @variable)
(call "(" (identifier) @variable)
