//! The boards of a gable roof by the formulas of paper 004 (004-03 to 004-13), as `docs/evidence.md` 7.2 corrects
//! them (F1 to F9).
//!
//! Two boxes lie on the slopes of a prism over a rectangle of walls. Each is made flat, turned about x by the
//! pitch, about z by the tilt of the rectangle, and moved by its control point, the middle of its lower face.
//!
//! Frame: right-handed, origin in the middle of the rectangle, x along edge 12 (a long one), y away from edge 34
//! towards edge 12, z up with its zero where storey heights are counted from (F7). Metres.
//!
//! Points that the paper leaves open, and how they are read here:
//!
//! | | |
//! |---|---|
//! | F1 | `offset` (rf_offs) goes from the prism's slope to the board's UPPER face: gap below the board + thickness |
//! | F2 | the lower faces cross the ridge plane by [`Board::crossing`]; a clean solid is cut there |
//! | F3 | `eaves` (eaves23) is measured ALONG the slope; [`Board::overhanging`] takes a horizontal one |
//! | F4 | a board is as wide as the formula gives, not the sentence: half the span along the slope + eaves + offset · tanθ |
//! | F5 | it overhangs at both ends: length = w_L + 2 · verge |
//! | F6 | the edge that points right has a tilt above -90° up to 90°; of a square's the more horizontal, then the first |
//! | F7 | side 12 turns by -θ about x, side 34 by +θ |
//! | F8 | `start` (st_heit) is the sum of the storeys' heights, not one height times their number |
//! | F9 | the eaves end square to the slope or upright: [`Cut`] |
//!
//! The roofs of this program are these boards with no gap below, cut at the ridge plane and upright at the
//! eaves; their upper faces, heights and thickness measured upright come from here.

use glam::{DMat3, DVec2, DVec3, dvec2, dvec3};

/// A roof board and its supporting rectangle; lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Board {
    /// w_L: the long edges 12 and 34.
    pub w_long: f64,
    /// w_S: the short edges 23 and 41.
    pub w_short: f64,
    /// tanθ, rise per horizontal metre, above 0.
    pub pitch: f64,
    /// eaves23, along the slope (F3).
    pub eaves: f64,
    /// eaves12, beyond each end (F5).
    pub verge: f64,
    /// rf_offs, from the prism's slope to the upper face (F1).
    pub offset: f64,
    /// thick_rf, at right angles to the slope.
    pub thickness: f64,
    /// st_heit, the level at which the prism starts (F8).
    pub start: f64,
}

/// The long edge of a board.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Edge 12, at greater y.
    E12,
    /// Edge 34.
    E34,
}

impl Edge {
    /// Returns +1 for edge 12, -1 for edge 34.
    fn sign(self) -> f64 {
        match self {
            Edge::E12 => 1.0,
            Edge::E34 => -1.0,
        }
    }
}

/// The cut of a board at the eaves (F9).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// At right angles to the slope, as a box ends.
    Square,
    /// Upright.
    Plumb,
}

/// Converts a thickness at right angles to a slope to a vertical one: thick / cosθ.
pub fn upright(thickness: f64, pitch: f64) -> f64 {
    thickness * secant(pitch)
}

/// Returns 1 / cosθ of a pitch.
fn secant(pitch: f64) -> f64 {
    (1.0 + pitch * pitch).sqrt()
}

/// Returns the top of storeys of these heights, metres: st_heit (F8).
pub fn start(storeys: &[f64]) -> f64 {
    storeys.iter().sum()
}

/// The corners of a rectangle, given clockwise, numbered 1 to 4 so that edge 12 is a long one and points right
/// (004-03, F6). Plan coordinates, y up on the sheet.
pub fn numbered(mut clockwise: [DVec2; 4]) -> [DVec2; 4] {
    let edge = |k: usize| clockwise[(k + 1) % 4] - clockwise[k];
    let (first, second) = (edge(0), edge(1));
    let longer = second.length_squared() - first.length_squared();
    let turned = if longer.abs() > 1e-9 * first.length_squared() {
        longer > 0.0
    } else {
        second.x.abs() > first.x.abs() + 1e-9 * first.length()
    };
    let long = usize::from(turned);
    let d = edge(long);
    let points_right = d.x > 0.0 || (d.x == 0.0 && d.y > 0.0);
    clockwise.rotate_left(long + if points_right { 0 } else { 2 });
    clockwise
}

impl Board {
    /// Returns the board with its upper face overhanging the wall by `overhang` in plan: e = (h - d · sinθ) / cosθ
    /// (F3).
    #[must_use]
    pub fn overhanging(self, overhang: f64) -> Self {
        let eaves = (overhang - self.offset * self.sin()) / self.cos();
        Self { eaves, ..self }
    }

    /// Returns the board laid `gap` above the prism: rf_offs = d_low + thick (F1).
    #[must_use]
    pub fn above(self, gap: f64) -> Self {
        let offset = gap + self.thickness;
        Self { offset, ..self }
    }

    fn cos(&self) -> f64 {
        1.0 / secant(self.pitch)
    }

    fn sin(&self) -> f64 {
        self.pitch * self.cos()
    }

    /// Returns the gap between the prism and the board, metres; negative if the board enters the prism (F1).
    pub fn gap(&self) -> f64 {
        self.offset - self.thickness
    }

    /// Returns the length of the box along the ridge (004-08, F5).
    pub fn length(&self) -> f64 {
        self.w_long + 2.0 * self.verge
    }

    /// Returns side23L = 0.5 · w_S · √(1 + tan²θ): half the span along the slope (004-09).
    pub fn side(&self) -> f64 {
        0.5 * self.w_short * secant(self.pitch)
    }

    /// Returns wid_rfb = side23L + eaves23 + rf_offs · tanθ (004-09, F4).
    pub fn width(&self) -> f64 {
        self.side() + self.eaves + self.offset * self.pitch
    }

    /// Returns ratio_s: the position of the control points between the middles of edges 12 and 34 (004-10).
    pub fn ratio(&self) -> f64 {
        let over = self.eaves * self.cos() + self.offset * self.sin();
        0.25 - 0.5 * over / self.w_short + self.thickness * self.sin() / self.w_short
    }

    /// Returns cp_rf1 and cp_rf2 from the middles of edges 12 and 34 in any plan (004-11).
    pub fn control_points(&self, pt12: DVec2, pt34: DVec2) -> [DVec2; 2] {
        let ratio = self.ratio();
        let between = |ratio: f64| (1.0 - ratio) * pt12 + ratio * pt34;
        [between(ratio), between(1.0 - ratio)]
    }

    /// Returns hei_rf: the height of the control points (004-12).
    pub fn height(&self) -> f64 {
        self.start - 0.5 * self.width() * self.sin() - self.thickness * self.cos()
            + self.offset / self.cos()
            + 0.5 * self.pitch * self.w_short
    }

    /// Returns the rotation of the flat box of a side into its slope (004-13, F7).
    pub fn rotation(&self, edge: Edge) -> DMat3 {
        // About x by -θ or +θ, computed without the angle.
        let (sin, cos) = (-edge.sign() * self.sin(), self.cos());
        DMat3::from_cols(DVec3::X, dvec3(0.0, cos, sin), dvec3(0.0, -sin, cos))
    }

    /// Returns the eight corners of a board in place: the lower face, then the upper one, each round from the ridge end
    /// at least x.
    pub fn corners(&self, edge: Edge) -> [DVec3; 8] {
        let (x, y) = (self.length() / 2.0, edge.sign() * self.width() / 2.0);
        let half = 0.5 * self.w_short;
        let [cp1, cp2] = self.control_points(dvec2(0.0, half), dvec2(0.0, -half));
        let place = match edge {
            Edge::E12 => cp1,
            Edge::E34 => cp2,
        };
        let rotation = self.rotation(edge);
        let corner =
            |(x, y, z): (f64, f64, f64)| rotation * dvec3(x, y, z) + place.extend(self.height());
        let face = |z: f64| [(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)];
        let ([a, b, c, d], [e, f, g, h]) = (face(0.0), face(self.thickness));
        [a, b, c, d, e, f, g, h].map(corner)
    }

    /// Returns the height of the ridge line in which the upper faces meet.
    pub fn ridge_top(&self) -> f64 {
        self.start + 0.5 * self.w_short * self.pitch + self.offset / self.cos()
    }

    /// Returns the upper edge of the eaves: y from the middle, and height.
    pub fn eaves_top(&self) -> DVec2 {
        let (sin, cos) = (self.sin(), self.cos());
        let y = 0.5 * self.w_short + self.eaves * cos + self.offset * sin;
        dvec2(y, self.start - self.eaves * sin + self.offset * cos)
    }

    /// Returns the lower edge of the eaves with the given cut (F9).
    pub fn eaves_bottom(&self, cut: Cut) -> DVec2 {
        let down = match cut {
            Cut::Square => self.thickness * dvec2(self.sin(), self.cos()),
            Cut::Plumb => dvec2(0.0, upright(self.thickness, self.pitch)),
        };
        self.eaves_top() - down
    }

    /// Returns the length of an uncut box's lower face beyond the ridge plane: thick · sinθ on each side (F2). A ridge
    /// cap that hides the gap instead must be twice as wide.
    pub fn crossing(&self) -> f64 {
        self.thickness * self.sin()
    }
}

#[cfg(test)]
mod tests {
    use crate::shape::board::*;

    /// The board with which 7.2 checked the formulas: 4.5 sun, eaves of 0.9 along the slope.
    const BOARD: Board = Board {
        w_long: 9.0,
        w_short: 5.4,
        pitch: 0.45,
        eaves: 0.9,
        verge: 0.3,
        offset: 0.2,
        thickness: 0.12,
        start: 5.4,
    };

    fn near(found: f64, wanted: f64, digits: i32) {
        let off = (found - wanted).abs();
        assert!(off < 0.51 * 10f64.powi(-digits), "{found} for {wanted}");
    }

    /// Returns the distance from the prism's slope on side 12.
    fn above_slope(b: &Board, p: DVec3) -> f64 {
        let apex = dvec3(0.0, 0.0, b.start + 0.5 * b.w_short * b.pitch);
        (p - apex).dot(dvec3(0.0, b.sin(), b.cos()))
    }

    #[test]
    fn the_numbers_of_the_paper_by_hand() {
        // cosθ = 0.911922, sinθ = 0.410365.
        near(BOARD.side(), 2.96078, 5);
        near(BOARD.width(), 3.95078, 5);
        near(BOARD.ratio(), 0.17553, 5);
        near(BOARD.height(), 5.91426, 5);
        let [cp1, cp2] = BOARD.control_points(dvec2(0.0, 2.7), dvec2(0.0, -2.7));
        near(cp1.y, 1.75216, 5);
        near(cp1.y + cp2.y, 0.0, 12);
    }

    #[test]
    fn f1_the_offset_goes_to_the_upper_face() {
        let corners = BOARD.corners(Edge::E12);
        for k in 0..4 {
            near(above_slope(&BOARD, corners[k]), 0.080, 12);
            near(above_slope(&BOARD, corners[k + 4]), 0.200, 12);
        }
        near(BOARD.gap(), 0.080, 12);
        assert_eq!(BOARD.above(0.08), BOARD);
        // Read literally, up to the board, a thick board would penetrate the prism.
        assert!(
            Board {
                offset: 0.05,
                ..BOARD
            }
            .gap()
                < 0.0
        );
    }

    #[test]
    fn f2_the_lower_faces_cross_the_ridge_plane() {
        let (one, other) = (BOARD.corners(Edge::E12), BOARD.corners(Edge::E34));
        for k in [4, 5] {
            near(one[k].y, 0.0, 12);
            near(one[k].z, BOARD.ridge_top(), 12);
            near(other[k].z, BOARD.ridge_top(), 12);
        }
        near(one[0].y, -BOARD.crossing(), 12);
        near(other[0].y, BOARD.crossing(), 12);
        near(BOARD.crossing(), 0.12 * 0.410365, 6);
    }

    #[test]
    fn f3_eaves_are_measured_along_the_slope() {
        let eaves = BOARD.eaves_top();
        near(eaves.x - 2.7, 0.9028, 4);
        for k in [6, 7] {
            let corner = BOARD.corners(Edge::E12)[k];
            near(corner.y, eaves.x, 12);
            near(corner.z, eaves.y, 12);
        }
        let again = Board {
            eaves: 0.0,
            ..BOARD
        }
        .overhanging(eaves.x - 2.7);
        near(again.eaves, 0.9, 12);
    }

    #[test]
    fn f4_and_f5_boards_are_as_long_and_wide_as_formulas_say() {
        let [ridge, end, eaves, _] = BOARD.corners(Edge::E12)[4..] else {
            panic!("four corners above");
        };
        near((end - ridge).length(), 9.0 + 2.0 * 0.3, 12);
        near((eaves - end).length(), BOARD.width(), 12);
        // The sentence has w_S + eaves + offset.
        assert!(BOARD.width() < 5.4 + 0.9 + 0.2 - 2.0);
    }

    #[test]
    fn f6_any_rectangle_has_its_corners_numbered() {
        let rectangle = |long: DVec2, short: DVec2| [DVec2::ZERO, long, long + short, short];
        for (long, short, first) in [
            (dvec2(6.0, 0.0), dvec2(0.0, -4.0), 0),
            (dvec2(-6.0, 0.0), dvec2(0.0, 4.0), 2),
            // Upright edges: up counts as right.
            (dvec2(0.0, 6.0), dvec2(4.0, 0.0), 0),
            (dvec2(0.0, -6.0), dvec2(-4.0, 0.0), 2),
            // Squares: the more horizontal edge, at 45 degrees the first.
            (dvec2(3.0, 1.0), dvec2(1.0, -3.0), 0),
            (dvec2(-1.0, 3.0), dvec2(3.0, 1.0), 1),
            (dvec2(2.0, 2.0), dvec2(2.0, -2.0), 0),
        ] {
            let corners = rectangle(long, short);
            let pt = numbered(corners);
            assert_eq!(pt[0], corners[first], "{long} {short}");
            // The numbering does not depend on the first corner, except for the square standing on a corner.
            if long.x.abs() != long.y.abs() {
                let mut other = corners;
                other.rotate_left(1);
                assert_eq!(numbered(other), pt);
            }
        }
    }

    #[test]
    fn f7_boards_turn_down_from_the_ridge() {
        for edge in [Edge::E12, Edge::E34] {
            let rotation = BOARD.rotation(edge);
            near(rotation.determinant(), 1.0, 12);
            let down = rotation * dvec3(0.0, edge.sign(), 0.0);
            near(down.z, -BOARD.sin(), 12);
            near(down.y * edge.sign(), BOARD.cos(), 12);
            let theta = BOARD.pitch.atan();
            let by_angle = DMat3::from_rotation_x(-edge.sign() * theta);
            assert!(rotation.abs_diff_eq(by_angle, 1e-12));
        }
    }

    #[test]
    fn f8_storeys_have_heights_of_their_own() {
        near(start(&[2.7, 2.4]), 5.1, 12);
        assert_eq!(start(&[]), 0.0);
    }

    #[test]
    fn f9_eaves_are_cut_square_or_upright() {
        let square = BOARD.eaves_bottom(Cut::Square);
        let box_end = BOARD.corners(Edge::E12)[2];
        near(square.x, box_end.y, 12);
        near(square.y, box_end.z, 12);
        let plumb = BOARD.eaves_bottom(Cut::Plumb);
        assert_eq!(plumb.x, BOARD.eaves_top().x);
        // Both lie on the lower face.
        for p in [square, plumb] {
            near(above_slope(&BOARD, dvec3(0.0, p.x, p.y)), 0.080, 12);
        }
    }
}
