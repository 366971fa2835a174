//! Tolerances of the geometry kernel: one meaning, one value, one name. Lengths are in metres unless stated otherwise.
//!
//! | name | used for |
//! |---|---|
//! | [`SAME`] | plan lengths as written, in U |
//! | [`POINT`] | welding corners of finished surfaces |
//! | [`CUT`] | cutting facets in plan |
//! | [`HEIGHT`] | surfaces over one place in plan |
//! | [`JOINT`] | members and roof parts that touch |
//! | [`SLIVER`] | facets left over by cuts |
//! | [`EAR`] | triangles of a triangulation |
//! | [`PARALLEL`], [`STRAIGHT`] | directions |
//!
//! Tolerances with one user and a meaning of its own (how far a wall may stand from the one below, say) stay with it.
//! Models are checked more strictly than they are made: see `hsd_ir::check`.

/// Plan lengths that differ by less, in U, are the same: a tenth of a millimetre.
pub const SAME: f64 = 1e-4;

/// Corners nearer to each other are one.
pub const POINT: f64 = 1e-6;

/// Cuts nearer to a corner in plan go through the corner; shorter plan distances count as none.
pub const CUT: f64 = 1e-7;

/// Surfaces over one place in plan whose heights differ by less are one.
pub const HEIGHT: f64 = 1e-5;

/// Parts of a building that are nearer to each other touch: a tenth of a millimetre.
pub const JOINT: f64 = 1e-4;

/// Facets with a smaller plan area are left out, square metres.
pub const SLIVER: f64 = 1e-7;

/// Triangles are slivers if twice their area is smaller, square metres.
pub const EAR: f64 = 1e-9;

/// Lines whose angle has a smaller sine are parallel.
pub const PARALLEL: f64 = 1e-7;

/// Corners whose turn has a smaller sine are straight.
pub const STRAIGHT: f64 = 1e-6;
