//! `hsd parts`: lists the catalogue of parts.

mod custom;
mod sheet;

use super::options::exit;
use super::{Failure, Outcome};
use crate::files::output::Committer;
use crate::files::terminal::{padded, width};
use clap::{Args, ValueEnum};
use hsd_base::diagnostic::{Language, Noun, Text, noun, visible};
use hsd_base::text;
use hsd_ir::catalog::{PartDef, Query};
use hsd_syntax::parse;
use std::io::{self, Write};
use std::path::PathBuf;

/// List the parts that walls are made of.
///
/// Part codes have five characters, including spaces. Widths are in U (0.909 m), heights in shaku (0.303 m).
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd parts lattice                list the parts with `lattice` in a name
  hsd parts --format json K        list all walls as JSON
  hsd parts --sheet parts.html     write a page with an image of each part
  hsd parts --catalog custom.hsd   list the custom parts of a file

Classes: K wall, T door, M window, G lattice, H post, A opening, N contemporary.")]
pub(super) struct Parts {
    /// List only parts whose code or name starts with this or contains it as a word; a capital letter selects a class.
    ///
    /// Long vowels match in any spelling: `koshi`, `koushi` and `kōshi` find the same parts.
    filter: Option<String>,

    /// Set the output format.
    #[arg(long, value_enum, default_value_t)]
    format: ListFormat,

    /// List the custom parts of this file instead; repeatable.
    #[arg(long = "catalog", value_name = "FILE")]
    catalogs: Vec<PathBuf>,

    /// Write an illustrated catalogue: .html with names and sizes, or .glb with the parts in rows.
    #[arg(long, value_name = "OUT", conflicts_with = "format")]
    sheet: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, Default, ValueEnum)]
enum ListFormat {
    /// A table.
    #[default]
    Table,
    /// A JSON array.
    Json,
}

/// Lists the parts of the catalogue that a word finds as a table; empty if there is none.
pub(super) fn list(filter: Option<String>, language: Language) -> String {
    let asked = Parts {
        filter,
        format: ListFormat::Table,
        catalogs: vec![],
        sheet: None,
    };
    let all = parse::builtin().parts().iter();
    let found: Vec<&PartDef> = all.filter(|p| asked.takes(p)).collect();
    match found.is_empty() {
        true => String::new(),
        false => table(&found, language),
    }
}

impl Parts {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let committer = Committer::reading(&self.catalogs).named_by("--sheet");
        committer.check(&self.sheet)?;
        let custom;
        let (all, sound): (&[PartDef], bool) = match self.catalogs.is_empty() {
            true => (parse::builtin().parts(), true),
            false => {
                custom = custom::read(&self.catalogs, &committer.inputs, language)?;
                (custom.parts(), custom.sound)
            }
        };
        let parts: Vec<&PartDef> = all.iter().filter(|p| self.takes(p)).collect();
        if let Some(output) = &self.sheet {
            sheet::write(&parts, output, &committer)?;
            return Ok(exit(!sound));
        }
        let text = match self.format {
            ListFormat::Table => table(&parts, language),
            ListFormat::Json => {
                let text = serde_json::to_string_pretty(&parts);
                text.map_err(|e| Failure::json(&e))? + "\n"
            }
        };
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes())?;
        out.flush()?;
        if parts.is_empty() {
            let none = match &self.filter {
                Some(filter) => elsewhere(filter).unwrap_or_else(|| {
                    text!([filter]
                        "no part has {filter:?} in its code or names",
                        "コードか名前に {filter:?} を含む部材はありません"
                    )
                }),
                None => text!("no parts defined", "部材は定義されていません"),
            };
            writeln!(io::stderr(), "{}", none.in_language(language))?;
        }
        Ok(exit(!sound))
    }

    fn takes(&self, part: &PartDef) -> bool {
        let Some(filter) = &self.filter else {
            return true;
        };
        let mut letters = filter.chars();
        if let (Some(class @ 'A'..='Z'), None) = (letters.next(), letters.next()) {
            return part.class() == class;
        }
        let code = filter.trim_end().to_uppercase();
        let query = Query::new(filter);
        let class = class_word(part.class());
        part.code().starts_with(&code) || query.is(class) || part.is_found_by(&query)
    }
}

/// Returns a message for search terms that are roof terms, or that have no model.
fn elsewhere(word: &str) -> Option<Text> {
    const ROOFS: &str = "屋根, 唐破風, 軒唐破風, 千鳥破風, 越屋根, 煙出し, 本卯建, 破風, 破風板, 懸魚, 鬼瓦, 棟瓦, 熨斗瓦, 軒瓦, 一文字瓦, 桟瓦, 本瓦, 瓦, 棟, 降棟, 隅棟, 稚児棟, 狐格子, 鳥衾, 鴟尾, 千木, 鰹木, \
        反り, 起り, 垂木, 庇, 裳階, 組物, 斗栱, 蟇股, 鼻隠, 入母屋, 寄棟, 切妻, 宝形, 相輪, yane, koshi-yane, kemuri-dashi, chidori-hafu, chigo-mune, hon-udatsu, roof monitor, dormer gable, karahafu, hafu, gegyo, onigawara, kawara, \
        mune, kudarimune, kitsune-gōshi, shibi, chigi, katsuogi, sori, mukuri, taruki, hisashi, mokoshi, kumimono, tokyō, kaerumata, irimoya, yosemune, kirizuma, hōgyō, \
        sōrin, roof, tile, tiles, ridge, eaves, rafter, rafters, gable, bargeboard, bracket, brackets, pent roof";
    const NONE: &str = "多宝塔, 亀腹, tahōtō, kamebara";
    let query = Query::new(word);
    let is_in = |list: &str| list.split(',').any(|name| query.is(name.trim()));
    if is_in(NONE) {
        return Some(text!([word]
            "{word:?} has no model yet",
            "{word:?} の形はまだありません"
        ));
    }
    is_in(ROOFS).then(|| {
        text!([word]
            "{word:?} belongs to roofs, not to parts: see grammar/roofs.md for roof forms and grammar/dressing.md for tiles, ridges and bargeboards",
            "{word:?} は部材ではなく屋根の用語です。屋根の形は grammar/roofs.ja.md、瓦・棟・破風は grammar/dressing.ja.md にあります"
        )
    })
}

/// Formats a number with at most three decimals.
fn rounded(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Returns a printable form of a code: the void's, five spaces, becomes dots.
fn with_blanks(code: &str) -> String {
    match code.trim().is_empty() {
        true => ".".repeat(code.len()),
        false => code.to_owned(),
    }
}

fn class_word(class: char) -> &'static str {
    match class {
        'K' => "wall",
        'T' => "door",
        'M' => "window",
        'G' => "lattice",
        'H' => "post",
        'A' => "opening",
        'N' => "modern",
        'O' => "outdoors",
        _ => "void",
    }
}

/// The legend below the table.
const LEGEND: Noun = noun(
    "
Width in U (0.909 m), from and to in shaku (0.303 m) above the storey's floor.
Era: E Edo, M Meiji to early Shōwa, N contemporary, all: any. `.....` stands for a code of five spaces.
",
    "
幅は U (0.909 m)、下端と上端は階の床から尺 (0.303 m) で表します。
時代: E 江戸、M 明治から昭和初期、N 現代、all すべて。`.....` は空白五つのコードを表します。
",
);

/// The headings of the first columns.
const HEADS: [Noun; 6] = [
    noun("code", "コード"),
    noun("width U", "幅 U"),
    noun("from shaku", "下端 尺"),
    noun("to shaku", "上端 尺"),
    noun("era", "時代"),
    noun("name", "名称"),
];

fn table(parts: &[&PartDef], language: Language) -> String {
    if parts.is_empty() {
        return String::new();
    }
    let words = HEADS.map(|head| language.choose(head.en, head.ja).to_owned());
    let [code, width_u, from, to, era, name] = words;
    let head = [
        code,
        width_u,
        from,
        to,
        era,
        name,
        String::new(),
        String::new(),
    ];
    let height = |h: Option<f64>| h.map_or(String::new(), rounded);
    let row = |p: &&PartDef| {
        [
            visible::line(&with_blanks(p.code())),
            rounded(p.width()),
            height(p.from),
            height(p.to),
            p.era.word().to_owned(),
            visible::line(&p.ja),
            visible::line(&p.romaji),
            visible::line(&p.en),
        ]
    };
    let rows: Vec<[String; 8]> = std::iter::once(head).chain(parts.iter().map(row)).collect();
    let column = |k: usize| rows.iter().map(|r| width(&r[k])).max().unwrap_or(0);
    let widths: [usize; 8] = std::array::from_fn(column);
    let mut out = String::new();
    for row in &rows {
        let cells = row
            .iter()
            .zip(widths)
            .map(|(cell, width)| padded(cell, width));
        out.push_str(cells.collect::<Vec<_>>().join("  ").trim_end());
        out.push('\n');
    }
    out + language.choose(LEGEND.en, LEGEND.ja)
}
