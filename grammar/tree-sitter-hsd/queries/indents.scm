; Captures of Neovim and of Helix side by side; each passes over those of the other.
(element (start_tag)) @indent.begin @indent
(start_tag (attribute)) @indent.begin @indent
(self_closing_tag) @indent.begin @indent
(end_tag) @indent.branch @outdent
(row) @indent.zero
(roof) @indent.zero
(comment) @indent.auto
