; Captures for Neovim (outer, inner) and Helix (around, inside).
(storey) @class.outer @class.around
(row) @function.outer @function.around
(code) @parameter.outer @parameter.around
(part) @parameter.inner @parameter.inside
(comment) @comment.outer @comment.around

(element (start_tag) . (_) @function.inner @function.inside) @function.outer @function.around
(attribute) @parameter.outer @parameter.around
(attribute (attribute_value) @parameter.inner @parameter.inside)
