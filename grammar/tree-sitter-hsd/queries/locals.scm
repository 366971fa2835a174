(document) @local.scope
(element (start_tag)) @local.scope

; Param and let define values; define names a definition, and its attributes are its parameters.
((self_closing_tag
  (tag_name) @_tag
  (attribute
    (attribute_name) @_name
    (attribute_value) @local.definition.parameter))
  (#match? @_tag "^(Param|let)$")
  (#match? @_name "^name$"))

((start_tag
  (tag_name) @_tag
  (attribute
    (attribute_name) @_name
    (attribute_value) @local.definition.function))
  (#match? @_tag "^define$")
  (#match? @_name "^name$"))

((start_tag
  (tag_name) @_tag
  (attribute
    (attribute_name) @local.definition.parameter))
  (#match? @_tag "^define$")
  (#not-match? @local.definition.parameter "^name$"))

((self_closing_tag
  (tag_name) @_tag
  (attribute
    (attribute_name) @_name
    (attribute_value) @local.reference))
  (#match? @_tag "^use$")
  (#match? @_name "^name$"))

(expression (identifier) @local.reference)
(parentheses (identifier) @local.reference)
(binary left: (identifier) @local.reference)
(binary right: (identifier) @local.reference)
(not (identifier) @local.reference)
(sign (identifier) @local.reference)
(call "(" (identifier) @local.reference)
