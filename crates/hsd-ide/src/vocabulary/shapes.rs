//! The body elements, of which parts are made.

use crate::vocabulary::Table;
use hsd_base::diagnostic::noun;

/// The descriptions of the body elements; their attributes are those of the catalogue.
#[rustfmt::skip]
pub(crate) const SHAPES: &Table = &[
    ("box", noun("a plain box", "箱")),
    ("wall", noun("the panel of a wall", "壁面")),
    ("boards", noun("boards side by side", "並べた板")),
    ("bars", noun("upright bars, counted", "竪桟")),
    ("rails", noun("level bars, counted", "横桟")),
    ("frame", noun("a frame inside the edges", "枠")),
    ("leaf", noun("sliding leaves side by side", "引戸")),
    ("track", noun("sill and head with their grooves", "敷居と鴨居")),
    ("oriel", noun("a box in front of the wall; holds elements", "出格子などの張り出し。中に要素を書く")),
    ("cloth", noun("cloths on a pole", "暖簾")),
    ("apron", noun("laths in an arc from the foot of the wall (inu-yarai)", "犬矢来")),
    ("coping", noun("a small roof along the place, both sides", "両側に流れる小屋根")),
    ("hood", noun("a small roof in front of the place", "前に付く小屋根")),
    ("wing", noun("a wall at right angles to the facade (udatsu)", "袖壁・卯建")),
    ("depth", noun("dark walls of what lies behind an opening", "開口の奥の暗がり")),
    ("namako", noun("raised plaster joints of a tile wall", "海鼠の目地")),
    ("panels", noun("a grid of panels with open joints", "目地を開けたパネル")),
    ("studs", noun("round studs in a grid", "鋲")),
    ("jambs", noun("frames one inside another (storehouse)", "蔵の段々の枠")),
    ("open", noun("leaves that stand open", "開いた扉")),
    ("corners", noun("what rounds the corners of an opening", "開口の丸い隅")),
    ("pole", noun("a round bar", "丸棒")),
    ("slats", noun("level slats that bulge: a roller shutter", "シャッターの羽根")),
    ("grid", noun("its children again in each cell of a grid", "中身を格子状に並べる")),
    ("post", noun("a post on the line", "柱")),
    ("dado", noun("boards at the foot of a wall", "腰板")),
    ("picture", noun("a panel that shows the texture of its part", "画像を見せる面")),
    ("change", noun("sets attributes of elements of the base anew", "base の要素の属性を変える")),
    ("remove", noun("takes elements of the base away", "base の要素を除く")),
];
