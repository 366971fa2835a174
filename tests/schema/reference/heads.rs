//! What stands above the elements on the pages of the reference.

/// In English.
pub(super) const HEAD: &str = "# Reference

[日本語](reference.ja.md)

<!-- Written by tests/schema from the table of the parser and from reference.toml: edit that, not this page. -->

Every element and attribute of the XML form, and every setting and option of the legacy form. Any value of the XML form may contain an
expression `{...}`. Places are in U, to the left of and back from the origin as seen from the street; heights are in shaku. The options of
commands are listed by `hsd help`.

## Elements
";

/// In Japanese.
pub(super) const HEAD_JA: &str = "# リファレンス

[English](reference.md)

<!-- tests/schema がパーサーの表と reference.toml から書くページ。直すときは reference.toml を直す。 -->

XML 形式のすべての要素と属性、旧形式のすべての設定とオプションです。XML 形式の値には、どこでも式 `{...}` を書けます。位置は U で、通りから見て原点から左へ、
奥へ測り、高さは尺で測ります。コマンドのオプションは `hsd help` で一覧できます。

## 要素
";
