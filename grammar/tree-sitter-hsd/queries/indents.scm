; Captures for Neovim and Helix; each ignores those of the other.
(element (start_tag)) @indent.begin @indent
(start_tag (attribute)) @indent.begin @indent
(self_closing_tag) @indent.begin @indent
(end_tag) @indent.branch @outdent
(row) @indent.zero
(roof) @indent.zero
(comment) @indent.auto
