//! What fields mean, by their names and values: those of OpenStreetMap, PLATEAU, the registry's maps (MOJ), the Geospatial
//! Information Authority (GSI), housing maps, and plain Japanese and English words.

use super::Seen;

/// Fields that only buildings have.
pub(super) const BUILDINGS: &[&str] = &[
    "building",
    "building:levels",
    "measuredHeight",
    "measuredheight",
    "storeysAboveGround",
    "buildingRoofEdgeArea",
    "buildingID",
    "建物ID",
    "建物用途",
    "建物名",
    "家屋番号",
    "階数",
    "建物階数",
];
/// Fields that only lots have.
pub(super) const LOTS: &[&str] = &["筆ID", "地番", "chiban", "fude_id", "parcel"];
/// Fields that only streets have.
pub(super) const ROADS: &[&str] = &[
    "highway",
    "幅員",
    "rdCtg",
    "道路種別",
    "sectionType",
    "rnkWidth",
];
/// Fields that only blocks have.
pub(super) const BLOCKS: &[&str] = &["block", "街区符号", "街区", "gaiku"];

/// Names of keys, of storeys, of heights, of kinds and of widths, the likelier first.
const KEYS: &[&str] = &[
    "key",
    "id",
    "ID",
    "Id",
    "建物ID",
    "筆ID",
    "buildingID",
    "gml_id",
    "osm_way_id",
    "osm_id",
    "fid",
    "FID",
    "KEY",
    "OBJECTID",
    "idx",
    "家屋番号",
    "code",
];
const LEVELS: &[&str] = &[
    "levels",
    "building:levels",
    "storeysAboveGround",
    "storeys",
    "stories",
    "floors",
    "num_floors",
    "階数",
    "地上階数",
    "建物階数",
    "地上階",
    "kaisu",
    "KAISU",
    "kaisuu",
];
const HEIGHTS: &[&str] = &[
    "height",
    "measuredHeight",
    "measuredheight",
    "measured_height",
    "building:height",
    "高さ",
    "建物高さ",
    "計測高さ",
    "takasa",
    "HEIGHT",
    "Height",
];
const KINDS: &[&str] = &[
    "use",
    "usage",
    "building",
    "用途",
    "建物用途",
    "種別",
    "建物種類",
    "kind",
    "ftype",
    "type",
    "class",
    "構造",
    "youto",
];
const WIDTHS: &[&str] = &["width", "幅員", "道路幅員", "fukuin", "WIDTH", "road_width"];

/// In a map of so few features, values that all differ may be kinds as well as names.
const ENOUGH: usize = 20;

/// A column with what was seen in it.
type Column = (String, Seen);

/// The fields of a layer and what they mean.
#[derive(Debug)]
pub(in crate::survey) struct Fields {
    columns: Vec<Column>,
    features: usize,
}

/// The types that a building's kind asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Use {
    Shed,
    Temple,
    Store,
    Hospital,
    School,
    Detached,
    Shops,
    Large,
}

/// Words in the values of kinds, parts of them.
const USES: &[(Use, &[&str])] = &[
    (
        Use::Shed,
        &[
            "shed",
            "garage",
            "carport",
            "roof",
            "hut",
            "無壁舎",
            "物置",
            "車庫",
            "小屋",
            "construction",
        ],
    ),
    (
        Use::Temple,
        &[
            "temple", "shrine", "pagoda", "寺", "神社", "本堂", "仏堂", "社寺",
        ],
    ),
    (
        Use::Store,
        &["storehouse", "kura", "土蔵", "蔵", "倉庫", "warehouse"],
    ),
    (
        Use::Hospital,
        &["hospital", "clinic", "病院", "医院", "診療所"],
    ),
    (
        Use::School,
        &[
            "school",
            "university",
            "college",
            "kindergarten",
            "学校",
            "大学",
            "校舎",
            "幼稚園",
        ],
    ),
    (
        Use::Detached,
        &["detached", "bungalow", "villa", "戸建", "専用住宅"],
    ),
    (
        Use::Shops,
        &["retail", "supermarket", "shops", "商店", "店舗"],
    ),
    (
        Use::Large,
        &[
            "apartments",
            "office",
            "commercial",
            "hotel",
            "dormitory",
            "government",
            "public",
            "industrial",
            "堅ろう",
            "ビル",
            "共同住宅",
            "業務",
            "商業施設",
            "官公庁",
            "宿泊",
            "マンション",
        ],
    ),
];

impl Fields {
    pub(super) fn new(names: &[String], seen: Vec<Seen>, features: usize) -> Fields {
        Fields {
            columns: names.iter().cloned().zip(seen).collect(),
            features,
        }
    }

    /// Adds the columns of another file of the layer.
    pub(super) fn append(&mut self, other: Fields) {
        self.features += other.features;
        for (name, seen) in other.columns {
            match self.columns.iter_mut().find(|(own, _)| *own == name) {
                Some((_, own)) => own.append(seen),
                None => self.columns.push((name, seen)),
            }
        }
    }

    fn get(&self, name: &str) -> Option<&Seen> {
        let found = self.columns.iter().find(|(own, _)| own == name);
        found.map(|(_, seen)| seen).filter(|seen| seen.filled > 0)
    }

    /// Returns true if a feature has one of these fields.
    pub(super) fn has(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.get(name).is_some())
    }

    /// Returns true if a field has this value at some feature.
    pub(super) fn says(&self, name: &str, value: &str) -> bool {
        self.get(name).is_some_and(|s| s.values.contains_key(value))
    }

    fn first(
        &self,
        names: &[&'static str],
        fits: impl Fn(&Seen) -> bool,
    ) -> Option<(&'static str, &Seen)> {
        let found = names
            .iter()
            .filter_map(|name| Some((*name, self.get(name)?)));
        found.into_iter().find(|(_, seen)| fits(seen))
    }

    /// Returns the field that tells features apart.
    pub(super) fn key(&self) -> Option<&'static str> {
        let fits = |s: &Seen| s.is_unique && s.filled == self.features;
        self.first(KEYS, fits).map(|(name, _)| name)
    }

    /// Returns the field of storeys.
    pub(super) fn levels(&self) -> Option<&'static str> {
        self.first(LEVELS, mostly_measures).map(|(name, _)| name)
    }

    /// Returns the field of heights in metres.
    pub(super) fn height(&self) -> Option<&'static str> {
        self.first(HEIGHTS, mostly_measures).map(|(name, _)| name)
    }

    /// Returns the field of widths of streets.
    pub(super) fn width(&self) -> Option<&'static str> {
        self.first(WIDTHS, mostly_measures).map(|(name, _)| name)
    }

    /// Returns the field of kinds, with its values.
    pub(super) fn kind(&self) -> Option<(&'static str, &Seen)> {
        let repeats = |s: &Seen| !s.is_unique || s.filled < ENOUGH;
        self.first(KINDS, |s| repeats(s) && s.numbers < s.filled)
    }

    /// Returns the values of the field of kinds that ask for a type, most frequent first.
    pub(super) fn uses(&self, wanted: Use) -> Vec<&str> {
        let Some((_, seen)) = self.kind() else {
            return vec![];
        };
        let of = |value: &str| {
            let value = value.to_lowercase();
            let found = USES
                .iter()
                .find(|(_, words)| words.iter().any(|w| value.contains(w)));
            found.map(|(of, _)| *of)
        };
        let mut found: Vec<(&String, usize)> = seen
            .values
            .iter()
            .map(|(value, count)| (value, *count))
            .filter(|(value, _)| of(value) == Some(wanted))
            .collect();
        found.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        found.into_iter().map(|(value, _)| &**value).collect()
    }

    /// Returns the names of fields that have values, with their share of features in percent.
    pub(super) fn shares(&self) -> impl Iterator<Item = (&str, usize)> {
        let filled = self.columns.iter().filter(|(_, seen)| seen.filled > 0);
        let all = self.features.max(1);
        filled.map(move |(name, seen)| (&**name, (100 * seen.filled).div_ceil(all)))
    }
}

fn mostly_measures(seen: &Seen) -> bool {
    seen.measures * 2 > seen.filled
}
