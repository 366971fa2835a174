//! The reference in prose, `grammar/reference.md` and `grammar/reference.ja.md`: the table of the parser with the
//! explanations of `grammar/reference.toml` beside it. Nothing may lack an explanation, a unit or a default.

mod heads;

use self::heads::{HEAD, HEAD_JA};
use crate::schema::model::{self, Place};
use crate::schema::table::held;
use hsd::parse::legacy;
use hsd::parse::schema::{AttributeSchema, Kind, Schema};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// The settings of the legacy header, and the attributes of the XML form with the same meaning.
const SETTINGS: [(&str, &str, &str); 8] = [
    ("unit", "House", "unit"),
    ("seed", "House", "seed"),
    ("roofs", "Roofs", "mode"),
    ("method", "Roofs", "method"),
    ("street", "House", "street"),
    ("name", "House", "name"),
    ("age", "House", "age"),
    ("era", "House", "era"),
];

/// The places of a roof line before its options, and the attributes of the XML form with the same meaning.
const FIELDS: [&str; 8] = ["kind", "ridge", "height", "shape", "a0", "b0", "a1", "b1"];

/// The options of a roof line, and the attributes of the XML form with the same meaning.
const OPTIONS: [(char, &str); 9] = [
    ('P', "pitch"),
    ('E', "eaves"),
    ('G', "verge"),
    ('T', "thickness"),
    ('M', "noshi"),
    ('S', "sori"),
    ('C', "gable"),
    ('R', "ratio"),
    ('O', "plain_ridge"),
];

/// The language of a page.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Language {
    English,
    Japanese,
}

impl Language {
    fn pick<'t>(self, en: &'t str, ja: &'t str) -> &'t str {
        if self == Language::English { en } else { ja }
    }

    /// One side of `English | 日本語`; both languages share a text without a bar.
    fn side(self, both: &str) -> String {
        match both.split_once(" | ") {
            Some((en, ja)) => self.pick(en, ja).to_owned(),
            None => both.to_owned(),
        }
    }
}

/// The explanations: sections of keys, a part of TOML.
struct Explanations {
    sections: BTreeMap<String, BTreeMap<String, String>>,
    used: RefCell<BTreeSet<String>>,
    lacking: RefCell<BTreeSet<String>>,
}

impl Explanations {
    fn read(text: &str) -> Explanations {
        let mut sections: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
        let mut section = String::new();
        for line in text
            .lines()
            .filter(|l| !l.is_empty() && !l.starts_with('#'))
        {
            if let Some(name) = line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) {
                section = name.to_owned();
                let fresh = sections.insert(section.clone(), BTreeMap::new());
                assert!(fresh.is_none(), "[{section}] twice");
                continue;
            }
            let pair = line.split_once(" = \"");
            let pair = pair.and_then(|(key, rest)| Some((key, rest.strip_suffix('"')?)));
            let (key, value) = pair.unwrap_or_else(|| panic!("not a key with its text: {line}"));
            let entries = sections.get_mut(&section).expect("a section comes first");
            entries.insert(key.to_owned(), value.to_owned());
        }
        Explanations {
            sections,
            used: RefCell::default(),
            lacking: RefCell::default(),
        }
    }

    fn entry(&self, section: &str, key: &str) -> Option<&str> {
        let found = self.sections.get(section)?.get(key)?;
        self.used.borrow_mut().insert(format!("{section}/{key}"));
        Some(found)
    }

    /// An entry of an attribute, or of the same attribute of the element that its element is like.
    fn of(&self, element: &str, attribute: &str, key: &str) -> Option<&str> {
        let own = self.entry(&format!("{element}-{attribute}"), key);
        own.or_else(|| self.of(self.entry(element, "like")?, attribute, key))
    }

    fn needed(&self, found: Option<&str>, what: String) -> String {
        if found.is_none() {
            self.lacking.borrow_mut().insert(what);
        }
        found.unwrap_or_default().to_owned()
    }

    /// The section with the meanings of an attribute's words.
    fn words(&self, element: &str, attribute: &str) -> String {
        let own = format!("words-{element}-{attribute}");
        match self.sections.contains_key(&own) {
            true => own,
            false => format!("words-{attribute}"),
        }
    }

    fn word(&self, section: &str, word: &str) -> String {
        let key = if word == "*" { "star" } else { word };
        self.needed(self.entry(section, key), format!("[{section}] {word}"))
    }

    /// Entries without an explanation, and explanations without an entry.
    fn findings(&self) -> Vec<String> {
        let used = self.used.borrow();
        let all = self.sections.iter();
        let all = all.flat_map(|(s, keys)| keys.keys().map(move |k| format!("{s}/{k}")));
        let stale = all.filter(|name| !used.contains(name));
        let lacking = self.lacking.borrow();
        let lacking = lacking.iter().map(|name| format!("missing: {name}"));
        lacking
            .chain(stale.map(|name| format!("explains nothing: {name}")))
            .collect()
    }
}

/// An attribute of the table.
fn find(element: &str, attribute: &str) -> &'static AttributeSchema {
    let found = model::elements().find(|e| e.name == element);
    let found = found.and_then(|e| e.attribute(attribute));
    found.expect("it is in the table")
}

/// The words of an attribute that need a meaning.
fn words(kind: Kind) -> &'static [&'static str] {
    match kind {
        Kind::Choice(words) if words.contains(&"yes") => &[],
        Kind::Choice(words) | Kind::Choices(words) | Kind::Either(words, ..) => words,
        _ => &[],
    }
}

/// Whether a value is one or more numbers, which need a unit.
fn counts(kind: Kind) -> bool {
    use Kind::{Choice, Choices, Positions, Text, YesNo};
    !matches!(kind, Text | YesNo | Positions | Choice(_) | Choices(_))
}

/// A page under way.
struct Page<'e> {
    language: Language,
    explanations: &'e Explanations,
    /// Sections of words that several attributes have in common, with the words.
    shared: BTreeMap<String, &'static [&'static str]>,
    out: String,
}

impl Page<'_> {
    fn pick<'t>(&self, en: &'t str, ja: &'t str) -> &'t str {
        self.language.pick(en, ja)
    }

    /// Bounds of a number; those that only exclude nonsense are left out.
    fn bounds(&self, least: f64, most: f64) -> String {
        let known = |n: f64| n.abs() < 1e5 && n.abs() != 1e-6;
        match (known(least), known(most)) {
            (true, true) if least < 0.0 => {
                format!(" {least} {} {most}", self.pick("to", "から"))
            }
            (true, true) => format!(" {least}–{most}"),
            (true, false) if least == 0.0 || least > 1e-3 => format!(" ≥ {least}"),
            _ if least > 0.0 => " > 0".to_owned(),
            _ => String::new(),
        }
    }

    fn number(&self, en: &str, ja: &str, least: f64, most: f64) -> String {
        format!("{}{}", self.pick(en, ja), self.bounds(least, most))
    }

    /// The accepted values.
    fn values(&self, kind: Kind) -> String {
        let list = |words: &[&str]| {
            let words: Vec<String> = words.iter().map(|w| format!("`{w}`")).collect();
            words.join(" ")
        };
        match kind {
            Kind::Text => self.pick("text", "文字列").to_owned(),
            Kind::Number(least, most) => self.number("number", "数", least, most),
            Kind::Whole(least, most) => {
                self.number("whole number", "整数", least as f64, most as f64)
            }
            Kind::Numbers(..) => self.pick("numbers", "数の列").to_owned(),
            Kind::Pair(least, most) => {
                self.number("one or two numbers", "数一つか二つ", least, most)
            }
            Kind::WholePair(least, most) => {
                self.number("one or two whole numbers", "整数一つか二つ", least, most)
            }
            Kind::Point(..) => self.pick("two numbers", "数二つ").to_owned(),
            Kind::Spot(..) => self.pick("three numbers", "数三つ").to_owned(),
            Kind::Points(..) => self
                .pick("corners, two numbers each", "隅の列。数二つずつ")
                .to_owned(),
            Kind::YesNo => list(&["yes", "no"]),
            Kind::Choice(words) => list(words),
            Kind::Choices(words) => {
                format!("{} {}", self.pick("any of", "いくつでも"), list(words))
            }
            Kind::Either(words, ..) => {
                format!("{} {}", list(words), self.pick("or a number", "または数"))
            }
            Kind::Positions => self
                .pick("positions, such as `2,5-7`", "`2,5-7` のような位置")
                .to_owned(),
        }
    }

    fn default(&self, element: &str, schema: &AttributeSchema) -> String {
        if schema.required {
            return self.pick("required", "必須").to_owned();
        }
        if !schema.default.is_empty() {
            return format!("`{}`", schema.default);
        }
        let absent = self.explanations.of(element, schema.name, "absent");
        let what = format!("[{element}-{}] absent", schema.name);
        self.language.side(&self.explanations.needed(absent, what))
    }

    fn unit(&self, element: &str, schema: &AttributeSchema) -> String {
        let unit = self.explanations.of(element, schema.name, "unit");
        model::assert_measure(element, schema, unit.unwrap_or_default());
        match counts(schema.kind) {
            false => self.language.side(unit.unwrap_or_default()),
            true => {
                let what = format!("[{element}-{}] unit", schema.name);
                self.language.side(&self.explanations.needed(unit, what))
            }
        }
    }

    /// What an attribute means, with the meanings of its words or the place where they stand.
    fn meaning(&self, element: &str, schema: &AttributeSchema) -> String {
        let key = self.pick("en", "ja");
        let text = self.explanations.of(element, schema.name, key);
        let what = format!("[{element}-{}] {key}", schema.name);
        let mut text = self.explanations.needed(text, what);
        let words = words(schema.kind);
        if words.is_empty() {
            return text;
        }
        let section = self.explanations.words(element, schema.name);
        if self.shared.contains_key(&section) {
            let _ = match self.language {
                Language::English => write!(text, " Values: [`{0}`](#{0}).", schema.name),
                Language::Japanese => write!(text, "値は [`{0}`](#{0})。", schema.name),
            };
            return text;
        }
        let one = |word: &&str| {
            let meaning = self.language.side(&self.explanations.word(&section, word));
            format!("`{word}`: {meaning}")
        };
        let all: Vec<String> = words.iter().map(one).collect();
        let _ = match self.language {
            Language::English => write!(text, " {}.", all.join("; ")),
            Language::Japanese => write!(text, "{}。", all.join("、")),
        };
        text
    }

    /// Links to all elements.
    fn contents(&mut self) {
        let link = |e: &Schema| format!("[`{}`](#{})", e.name, e.name.to_lowercase());
        let all: Vec<String> = model::elements().map(link).collect();
        let _ = writeln!(self.out, "\n{}", all.join(" "));
    }

    fn head(&mut self) {
        let row = self.language.pick(
            "\n| name | values | default | unit | meaning |\n|---|---|---|---|---|\n",
            "\n| 名前 | 値 | 既定値 | 単位 | 意味 |\n|---|---|---|---|---|\n",
        );
        self.out.push_str(row);
    }

    /// A row of a table: an attribute under some name, with some values.
    fn row(
        &mut self,
        name: &str,
        [values, default]: [&str; 2],
        element: &str,
        schema: &AttributeSchema,
    ) {
        let row = [
            format!("`{name}`"),
            values.to_owned(),
            default.to_owned(),
            self.unit(element, schema),
            self.meaning(element, schema),
        ];
        assert!(row.iter().all(|cell| !cell.contains('|')), "{row:?}");
        let _ = writeln!(self.out, "| {} |", row.join(" | "));
    }

    /// The row of an attribute under the name that it has in the legacy form.
    fn attribute(&mut self, name: &str, element: &str, attribute: &str) {
        let schema = find(element, attribute);
        let (values, default) = (self.values(schema.kind), self.default(element, schema));
        self.row(name, [&values, &default], element, schema);
    }

    fn element(&mut self, element: &Schema, places: &[Place]) {
        let key = self.pick("en", "ja");
        let about = self.explanations.entry(element.name, key);
        let about = self
            .explanations
            .needed(about, format!("[{}] {key}", element.name));
        let _ = writeln!(self.out, "\n### `{}`\n\n{about}", element.name);
        self.out.push_str(&self.content(element, places));
        if element.attributes.is_empty() {
            return;
        }
        self.head();
        for schema in element.attributes {
            self.attribute(schema.name, element.name, schema.name);
        }
    }

    /// What an element contains.
    fn content(&self, element: &Schema, places: &[Place]) -> String {
        let list = |names: Vec<&str>| {
            let names: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
            names.join(" ")
        };
        let held = held(element, places);
        let text = match held {
            _ if element.name == "PartDef" => self.pick("elements of shape", "形の要素").to_owned(),
            _ if element.name == "random" => list(vec!["choice"]),
            None => self
                .pick("what the element around it contains", "外側の要素と同じ")
                .to_owned(),
            Some(names) if names.is_empty() => match element.is_leaf() {
                true => return String::new(),
                false => self.pick("any content", "何でも").to_owned(),
            },
            Some(names) => list(names),
        };
        match self.language {
            Language::English => format!("\nContains: {text}.\n"),
            Language::Japanese => format!("\n中身: {text}。\n"),
        }
    }

    fn legacy(&mut self) {
        let heading = self.language.pick(
            "\n## Legacy form: header\n\nThe first line has `x`, `y` and `azimuth`, the second the height of each storey. Each further line is a setting: its name, then its value.\n",
            "\n## 旧形式のヘッダー\n\n一行目に `x`、`y`、`azimuth`、二行目に各階の高さを書く。その後は一行に一つの設定で、名前、値の順に書く。\n",
        );
        self.out.push_str(heading);
        self.head();
        for name in ["x", "y", "azimuth"] {
            self.attribute(name, "House", name);
        }
        self.attribute("height", "Storey", "height");
        for (setting, element, attribute) in SETTINGS {
            self.attribute(setting, element, attribute);
        }
        let heading = self.language.pick(
            "\n## Legacy form: roof line\n\nThe fields of a roof line, in this order and separated by blanks:\n",
            "\n## 旧形式の屋根の行\n\n項目は次の順に、空白で区切って書く。\n",
        );
        self.out.push_str(heading);
        self.head();
        for name in FIELDS {
            let schema = find("Roof", name);
            let values = self.values(schema.kind);
            let required = self.pick("required", "必須");
            self.row(name, [&values, required], "Roof", schema);
        }
        let heading = self.language.pick(
            "\nOptions follow in any order, each a letter with its number attached, such as `P4.0`:\n",
            "\n続いてオプションを書く。順序は自由で、`P4.0` のように文字に数を付ける。\n",
        );
        self.out.push_str(heading);
        self.head();
        let ranges: BTreeMap<char, _> = legacy::options().collect();
        for (letter, attribute) in OPTIONS {
            let schema = find("Roof", attribute);
            let values = ranges.get(&letter).map_or_else(
                || self.pick("no number", "数なし").to_owned(),
                |r| self.number("number", "数", *r.start(), *r.end()),
            );
            let default = self.default("Roof", schema);
            self.row(&letter.to_string(), [&values, &default], "Roof", schema);
        }
    }

    /// The words that several attributes have in common.
    fn vocabulary(&mut self) {
        self.out
            .push_str(self.language.pick("\n## Values\n", "\n## 値\n"));
        for (section, words) in self.shared.clone() {
            let name = section.rsplit('-').next().unwrap_or_default();
            let _ = writeln!(self.out, "\n### `{name}`\n");
            let head = self.pick("| value | meaning |", "| 値 | 意味 |").to_owned();
            let _ = writeln!(self.out, "{head}\n|---|---|");
            for word in words {
                let meaning = self.language.side(&self.explanations.word(&section, word));
                let _ = writeln!(self.out, "| `{word}` | {meaning} |");
            }
        }
    }
}

/// The sections of words that attributes of more than one element have in common.
fn shared(explanations: &Explanations) -> BTreeMap<String, &'static [&'static str]> {
    let mut users: BTreeMap<String, (usize, &'static [&'static str])> = BTreeMap::new();
    for element in model::elements() {
        for schema in element.attributes {
            let words = words(schema.kind);
            let section = explanations.words(element.name, schema.name);
            if !words.is_empty() && section.matches('-').count() == 1 {
                users.entry(section).or_insert((0, words)).0 += 1;
            }
        }
    }
    let several = users.into_iter().filter(|(_, (count, _))| *count > 1);
    several
        .map(|(section, (_, words))| (section, words))
        .collect()
}

/// Both pages, and what is missing or too much in the explanations.
pub fn make(text: &str) -> ([String; 2], Vec<String>) {
    let settings: BTreeSet<&str> = SETTINGS.iter().map(|s| s.0).collect();
    assert_eq!(settings, legacy::settings().iter().copied().collect());
    let ranged: BTreeSet<char> = legacy::options().map(|o| o.0).collect();
    assert!(
        OPTIONS
            .iter()
            .all(|(letter, _)| *letter == 'O' || ranged.contains(letter))
    );
    assert_eq!(OPTIONS.len(), ranged.len() + 1, "`O` has no number");
    let explanations = Explanations::read(text);
    let pages = [Language::English, Language::Japanese].map(|language| {
        let mut page = Page {
            language,
            explanations: &explanations,
            shared: shared(&explanations),
            out: language.pick(HEAD, HEAD_JA).to_owned(),
        };
        page.contents();
        let places = model::places();
        for element in model::elements() {
            page.element(element, &places);
        }
        page.legacy();
        page.vocabulary();
        page.out
    });
    (pages, explanations.findings())
}
