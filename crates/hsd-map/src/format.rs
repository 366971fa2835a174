//! Tells the format of a map by its first bytes.

/// A format that is read from one stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    GeoJson,
    FlatGeobuf,
    GeoPackage,
    GeoParquet,
    OsmXml,
    OsmPbf,
    Moj,
    CityGml,
    Csv,
    Unknown,
}

/// The first bytes of a database of SQLite.
const SQLITE: &[u8] = b"SQLite format 3\0";

/// The first bytes of a Parquet table.
const PARQUET: &[u8] = b"PAR1";

/// Returns the format of a file that begins with these bytes.
pub(super) fn of(head: &[u8], path: &str) -> Format {
    if head.starts_with(super::flatgeobuf::MAGIC) {
        return Format::FlatGeobuf;
    }
    if head.starts_with(SQLITE) {
        return Format::GeoPackage;
    }
    if head.starts_with(PARQUET) {
        return Format::GeoParquet;
    }
    let text = decoded(head);
    let text = text.trim_start_matches(['\u{feff}', '\u{1e}']).trim_start();
    if text.starts_with('{') {
        return Format::GeoJson;
    }
    if text.starts_with('<') {
        return of_xml(text);
    }
    if head
        .get(4..)
        .is_some_and(|rest| rest.windows(9).take(8).any(|w| w == b"OSMHeader"))
    {
        return Format::OsmPbf;
    }
    let name = path.strip_suffix(".gz").unwrap_or(path);
    let is_table = ["csv", "tsv", "txt"]
        .iter()
        .any(|e| super::has_extension(name, e));
    match is_table && !head.contains(&0) {
        true => Format::Csv,
        false => Format::Unknown,
    }
}

/// Returns the head as text, as far as its structure matters: UTF-16 is decoded, all else is close to ASCII.
fn decoded(head: &[u8]) -> String {
    match encoding_rs::Encoding::for_bom(head) {
        Some((encoding, bom)) => encoding.decode_without_bom_handling(&head[bom..]).0.into(),
        None => String::from_utf8_lossy(head).into_owned(),
    }
}

/// Returns the format of XML by its root.
fn of_xml(text: &str) -> Format {
    let mut rest = text;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        if rest.starts_with(['?', '!']) {
            continue;
        }
        let end = rest.find(|c: char| c.is_whitespace() || matches!(c, '>' | '/'));
        let name = &rest[..end.unwrap_or(rest.len())];
        return match name.rsplit(':').next() {
            Some("osm") => Format::OsmXml,
            Some("地図") => Format::Moj,
            Some("CityModel") => Format::CityGml,
            _ => Format::Unknown,
        };
    }
    Format::Unknown
}
