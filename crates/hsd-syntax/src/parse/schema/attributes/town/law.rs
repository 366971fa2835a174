//! The attributes of building law (docs/contract.md 10.5).

use super::super::{LENGTH, TRUTH};
use super::EVIDENCE;
use crate::parse::schema::kinds::Kind::{Choice, Number, Text};
use crate::parse::schema::kinds::{AttributeSchema, may, words};
use hsd_ir::ast::law::DistrictPlan;

const PLAN: &[&str] = &words(&DistrictPlan::WORDS);

/// Makes a list of the terms of a zone and more attributes.
macro_rules! with_terms {
    ($($more:expr),* $(,)?) => {
        &[
            may("gradient", Number(0.1, 10.0), "", "rise of the road slant line per metre (Building Standards Act art. 56 (1) 1: 1.25 in residential zones, else 1.5)", "道路斜線の勾配(建築基準法56条1項1号: 住居系 1.25、ほかは 1.5)"),
            may("distance", Number(1.0, 100.0), "", "how far from the far side of a road that counts, metres (appended table 3: 20 to 50)", "道路斜線の適用距離(m)。道路の反対側の境界線から(別表第三: 20〜50)").metres(),
            may("ratio", Number(0.1, 20.0), "", "designated floor-area ratio: 4 is 400 % (art. 52 (1))", "指定容積率。4 は 400 %(52条1項)"),
            may("factor", Number(0.1, 2.0), "", "floor-area ratio for each metre of a road of less than 12 m (art. 52 (2): 0.4 in residential zones, else 0.6)", "幅員 12 m 未満の前面道路 1 m あたりの容積率(52条2項: 住居系 0.4、ほかは 0.6)"),
            may("limit", Number(1.0, 300.0), "", "greatest height, metres", "高さの限度(m)").metres(),
            may("setback", Number(0.0, 20.0), "", "how far houses stand back from roads, metres; the far side counts as much farther away (art. 56 (2))", "道路からの後退距離(m)。反対側の境界線もそれだけ遠くにあるとみなす(56条2項)").metres(),
            may("plan", Choice(PLAN), "", "which rules count: those for all, or a district plan that guides the street scene", "適用する規制。一般の規制か、街並み誘導型地区計画か"),
            may("side_height", Number(1.0, 100.0), "", "height over the border of a neighbour from which the adjacent-land slant line rises, metres (art. 56 (1) 2: 20 in residential zones, else 31)", "隣地斜線の立ち上がりの高さ(m)(56条1項2号: 住居系 20、ほかは 31)").metres(),
            may("side_gradient", Number(0.1, 10.0), "", "rise of that per metre (art. 56 (1) 2: 1.25 in residential zones, else 2.5)", "隣地斜線の勾配(56条1項2号: 住居系 1.25、ほかは 2.5)"),
            may("storey", Number(1.8, 10.0), "", "height of a storey, metres", "階高(m)").metres(),
            may("coverage", Number(0.05, 1.0), "", "greatest ratio of ground area to the lot (art. 53)", "建蔽率の限度(53条)"),
            may("by_ratio", TRUTH, "", "cuts the solid at the height at which a house of that ground area has used up its floor area, so that narrow roads show", "建蔽率いっぱいの建物が容積率を使い切る高さで立体を切る。狭い道の差が見える"),
            $($more),*
        ]
    };
}

pub(in crate::parse::schema) const ZONE: &[AttributeSchema] = with_terms!(EVIDENCE);
pub(in crate::parse::schema) const ENVELOPE: &[AttributeSchema] = with_terms!(
    may(
        "scenario",
        Text,
        "",
        "the name of the set of rules, to put several side by side",
        "規制の案の名。いくつかを並べて比べる"
    ),
    may(
        "built",
        LENGTH,
        "",
        "height of the house that stands on the lot, metres: one above its envelope is listed",
        "敷地に今ある建物の高さ(m)。エンベロープを超えるものは一覧に載る"
    )
    .metres(),
    may(
        "roads",
        Text,
        "",
        "the layer of roads; without, all streets",
        "道路のレイヤー。無ければすべての通り"
    ),
    may(
        "show",
        TRUTH,
        "yes",
        "shown as glass in the model of the town",
        "町のモデルにガラスとして示す"
    ),
    EVIDENCE,
);
