//! The public interface, re-exported at the crate's root: compile house files, check and format them, write the model,
//! roof an outline. Everything else is internal and may change with any release.

use glam::DVec2;
use hsd_base::diagnostic::Diagnostics;
use hsd_base::source::{Limits, Source};
use hsd_ir::building::Roof;
use hsd_roof::shape::look::Look;
use hsd_roof::skeleton::Invalid;
use hsd_syntax::print;

/// Formats a source file in its own form of the language, with its own line ends. A legacy file must be free of
/// errors, an XML file well-formed. Returns `None` if the meaning is in doubt; `out` receives the reason.
///
/// ```
/// use hsd::{Diagnostics, FileId, Source};
/// let source = Source::new(FileId(0), "wall.hsd", b"0 0  180\n\nGSI  GSI  GDE 2\n");
/// let mut out = Diagnostics::new();
/// let formatted = hsd::format(&source, &mut out).expect("the file has no errors");
/// assert!(formatted.starts_with("0 0 180\n"));
/// ```
pub fn format(source: &Source, out: &mut Diagnostics) -> Option<String> {
    print::format(source, &Limits::default(), out)
}

/// Roofs an outline: one closed solid with a slope over each wall, from the straight skeleton.
///
/// `outline` and `courts` are simple polygons in metres (east, north), walked either way, closed or not. `base` is the
/// height of the wall plates in metres, `pitch` the rise per horizontal metre.
///
/// # Errors
/// The reason why the outline bounds no area that could be roofed.
///
/// ```
/// use hsd::glam::dvec2;
/// let house = [dvec2(0.0, 0.0), dvec2(9.0, 1.0), dvec2(8.0, 6.0), dvec2(0.5, 6.5)];
/// let roof = hsd::roof_over(&house, &[], 3.0, 0.45).expect("the outline is a simple polygon");
/// assert_eq!(roof.solids.len(), 1);
/// assert!(hsd::roof_over(&house[..2], &[], 3.0, 0.45).is_err());
/// ```
pub fn roof_over(
    outline: &[DVec2],
    courts: &[Vec<DVec2>],
    base: f64,
    pitch: f64,
) -> Result<Roof, Invalid> {
    // The span and unit choose a default pitch only.
    let usual = Look::gable(None, &Default::default(), 6.0, 1.0);
    hsd_roof::over(outline, courts, base, &Look { pitch, ..usual })
}

#[cfg(feature = "models")]
pub use models::glb;

#[cfg(feature = "models")]
mod models {
    use hsd_base::diagnostic::Diagnostics;
    use hsd_base::source::World;
    use hsd_driver::{Compiled, Options};
    use hsd_export::gltf;

    /// Writes a compiled model as binary glTF 2.0 (`.glb`) with its textures inside. Part images that cannot be read
    /// are reported and left out.
    ///
    /// ```
    /// use hsd::{Diagnostics, FileId, NoFiles, Options, Source};
    /// let text = "0 0 180\n9.5\n\nKKS  TKD 2MRE\nKSK  MRE  KSK\nKKS  TIT 2KKS\nKSK  KSK  KSK\n";
    /// let source = Source::new(FileId(0), "house.hsd", text.as_bytes());
    /// let (options, mut out) = (Options::default(), Diagnostics::new());
    /// let compiled = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    /// let glb = hsd::glb(&compiled, &NoFiles, &options, &mut out);
    /// assert_eq!(&glb[..4], b"glTF");
    /// assert!(!out.has_errors());
    /// ```
    pub fn glb(
        compiled: &Compiled,
        world: &dyn World,
        options: &Options,
        out: &mut Diagnostics,
    ) -> Vec<u8> {
        let scene = &compiled.scene;
        let limits = &options.expand.limits;
        let building = &compiled.building;
        let mut images = hsd_driver::pictures(&scene.pictures, building, world, limits, out);
        images.bake(&scene.baked);
        hsd_driver::flaws(compiled, out);
        gltf::glb(scene, &images)
    }
}
