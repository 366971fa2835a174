//! What every feature of a town's map knows beside its fields.

use crate::vocabulary::Table;
use hsd_base::diagnostic::noun;

/// The descriptions of the measures of features, in the order of [`hsd_town::site::MEASURES`].
#[rustfmt::skip]
pub(crate) const MEASURES: &Table = &[
    ("key", noun("the feature's name in its layer", "レイヤーの中での地物の名")),
    ("x", noun("its centroid: metres east of the origin", "重心。原点から東へ(m)")),
    ("y", noun("its centroid: metres north of the origin", "重心。原点から北へ(m)")),
    ("z", noun("the mean height of its points, m", "点の高さの平均(m)")),
    ("area", noun("of its outline, square metres", "輪郭の面積(m²)")),
    ("perimeter", noun("of its outline, m", "輪郭の周長(m)")),
    ("vertices", noun("the number of its corners", "輪郭の頂点の数")),
    ("orthogonal", noun("all corners within 10 degrees of right angles", "すべての角が直角(10 度以内)")),
    ("word", noun("its turns, clockwise from the front: RRRR is a rectangle", "正面から時計回りの折れ。RRRR は矩形")),
    ("frontage", noun("the length of its front, m", "間口(m)")),
    ("depth", noun("its extent behind the front, m", "奥行(m)")),
    ("facing", noun("the compass direction of its front, degrees", "正面の方位(度)")),
    ("street", noun("the distance to the side of its street, m", "道の端までの距離(m)")),
    ("corner", noun("a second side faces another street", "角地。もう一辺が別の道に面する")),
    ("through", noun("the opposite side faces a street too", "反対側も道に面する")),
    ("access", noun("street, rear (none is seen past other houses) or none (none within 30 m)", "street(道)、rear(他の家の裏)、none(30 m 以内に道がない)")),
    ("left", noun("the distance to the neighbour on the left, m; 0 where they touch", "左隣までの距離(m)。接すれば 0")),
    ("right", noun("the distance to the neighbour on the right, m; 0 where they touch", "右隣までの距離(m)。接すれば 0")),
    ("block", noun("the key of the polygon of another layer that it lies in", "入っている別レイヤーの面のキー")),
    ("length", noun("of a line, m", "線の長さ(m)")),
    ("bearing", noun("the compass direction of a line, degrees", "線の方位(度)")),
    ("randloc", noun("the published draw from 0 to 99, by the last digits of the place", "位置の末尾の桁による 0 から 99 の値(公表の方法)")),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measure_is_described() {
        let names: Vec<&str> = MEASURES.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, hsd_town::site::MEASURES);
    }
}
