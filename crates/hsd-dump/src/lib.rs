//! The trees between the passes as JSON, for tests and other tools. Every document has a `version`, which changes when a
//! field changes its meaning or is removed.

use glam::{DVec2, DVec3};
use hsd_base::source::Source;
use hsd_export::number::Number;
use hsd_ir::ast::{Document, RoofShape};
use hsd_ir::building::{Building, Built, EdgeKind, HouseRoofs, PlanRegion, StoreyPlan};
use hsd_ir::program::Program;
use hsd_scene::Scene;
use serde::{Serialize, Serializer};

const VERSION: u32 = 1;

/// The version of `--stage building`: since 2 a house holds its roofs and fittings.
const BUILDING_VERSION: u32 = 2;

#[derive(Serialize)]
struct Versioned<T> {
    version: u32,
    #[serde(flatten)]
    content: T,
}

/// Returns a line of JSON.
fn line(version: u32, content: impl Serialize) -> serde_json::Result<String> {
    let mut text = serde_json::to_string(&Versioned { version, content })?;
    text.push('\n');
    Ok(text)
}

#[derive(Serialize)]
struct Files<'a> {
    files: Vec<File<'a>>,
}

#[derive(Serialize)]
struct File<'a> {
    file: &'a str,
    #[serde(flatten)]
    document: &'a Document,
}

/// `--stage ast`: the parsed source, file by file.
///
/// # Errors
/// Never for documents of the readers, whose numbers are finite. The same holds for the other functions here.
pub fn ast(sources: &[&Source], documents: &[Document]) -> serde_json::Result<String> {
    let both = sources.iter().zip(documents);
    let files = both.map(|(source, document)| File {
        file: source.name(),
        document,
    });
    let files = files.collect();
    line(VERSION, Files { files })
}

/// `--stage program`: the program after expansion.
///
/// # Errors
/// See [`ast`].
pub fn program(program: &Program) -> serde_json::Result<String> {
    line(VERSION, program)
}

/// `--stage building`: walls in place, roofs as solids.
///
/// # Errors
/// See [`ast`].
pub fn building(building: &Building) -> serde_json::Result<String> {
    line(BUILDING_VERSION, building)
}

/// `--stage scene`: meshes, materials, nodes.
///
/// # Errors
/// See [`ast`].
pub fn scene(scene: &Scene) -> serde_json::Result<String> {
    line(VERSION, scene)
}

/// `--stage regions`: the automatic roofs in plan (docs/contract.md 5), in U.
///
/// # Errors
/// See [`ast`].
pub fn regions(building: &Building) -> serde_json::Result<String> {
    let house = |made: &Built| House {
        name: made.house.name.clone(),
        unit_m: Number(made.house.unit),
        storeys: made
            .roofs
            .plans
            .iter()
            .map(|plan| storey(plan, built(&made.roofs, plan, made.house.unit)))
            .collect(),
    };
    let houses = building.houses.iter().map(house).collect();
    line(VERSION, Houses { houses })
}

#[derive(Serialize)]
struct Houses {
    houses: Vec<House>,
}

#[derive(Serialize)]
struct House {
    name: String,
    unit_m: Number,
    storeys: Vec<Storey>,
}

type Outline = Vec<[Number; 2]>;

#[derive(Serialize)]
struct Storey {
    storey: u32,
    z: Number,
    /// The first outer ring.
    outline: Outline,
    /// All outer rings, if a storey has several.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    outlines: Vec<Outline>,
    holes: Vec<Outline>,
    regions: Vec<Region>,
    /// Ridges, hips and valleys of the automatic roofs as built.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    lines: Vec<RidgeLine>,
}

/// A line of a roof.
#[derive(Serialize)]
struct RidgeLine {
    /// ridge, hip or valley.
    kind: &'static str,
    /// (a, b) in U and height in metres.
    from: [Number; 3],
    to: [Number; 3],
}

/// One automatic region.
#[derive(Debug, Serialize)]
pub struct Region {
    a0: Number,
    b0: Number,
    a1: Number,
    b1: Number,
    ridge: Option<&'static str>,
    fall: Option<&'static str>,
    role: &'static str,
    #[serde(serialize_with = "letters")]
    shape: RoofShape,
    over: Option<usize>,
    /// The outline, if it is not a rectangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    polygon: Option<Outline>,
}

fn letters<S: Serializer>(shape: &RoofShape, s: S) -> Result<S::Ok, S::Error> {
    s.serialize_str(shape.letters())
}

fn outline(corners: &[DVec2]) -> Outline {
    corners.iter().map(|p| [Number(p.x), Number(p.y)]).collect()
}

/// Ridges, hips and valleys over the regions of a storey.
fn built(roofs: &HouseRoofs, plan: &StoreyPlan, unit: f64) -> Vec<RidgeLine> {
    let kinds = [
        (EdgeKind::Ridge, "ridge"),
        (EdgeKind::Hip, "hip"),
        (EdgeKind::Valley, "valley"),
    ];
    let place = |p: DVec3| [-p.x / unit + 0.0, p.y / unit, p.z].map(Number);
    let roofs: Vec<_> = roofs.over_regions(plan.storey).collect();
    let of = |(kind, name): (EdgeKind, &'static str)| {
        let lines = roofs.iter().flat_map(move |r| r.lines(kind));
        let line = move |[from, to]: [DVec3; 2]| RidgeLine {
            kind: name,
            from: place(from),
            to: place(to),
        };
        lines.map(line).collect::<Vec<_>>()
    };
    kinds.into_iter().flat_map(of).collect()
}

fn storey(plan: &StoreyPlan, lines: Vec<RidgeLine>) -> Storey {
    let outlines: Vec<Outline> = plan.outlines.iter().map(|o| outline(o)).collect();
    Storey {
        storey: plan.storey,
        z: Number(plan.z),
        outline: outlines.first().cloned().unwrap_or_default(),
        outlines: if outlines.len() > 1 { outlines } else { vec![] },
        holes: plan.holes.iter().map(|o| outline(o)).collect(),
        regions: plan.regions.iter().map(region).collect(),
        lines,
    }
}

/// Converts a region to its JSON form.
pub fn region(r: &PlanRegion) -> Region {
    let [a0, b0, a1, b1] = r.rect.map(Number);
    Region {
        a0,
        b0,
        a1,
        b1,
        ridge: r.ridge,
        fall: r.fall,
        role: r.role,
        shape: r.shape,
        over: r.over,
        polygon: r.polygon.as_ref().map(|o| outline(o)),
    }
}

#[cfg(test)]
mod tests {
    use super::regions;
    use glam::dvec2;
    use hsd_base::source::Span;

    #[test]
    fn regions_are_written_as_documented() {
        use hsd_ir::ast::RoofShape;
        use hsd_ir::building::{Building, Built, House, HouseRoofs, PlanRegion, StoreyPlan};
        let house = House {
            span: Span::default(),
            name: String::new(),
            variant: None,
            placed: None,
            origin: [0.0; 3],
            azimuth: 180.0,
            unit: 10.0 / 11.0,
            street: false,
            age: None,
            storeys: vec![],
            raised: 0.0,
            plinth: 0.0,
            platform: None,
            finials: vec![],
            puts: vec![],
            grounds: vec![],
            outdoors: None,
            roofs: Default::default(),
        };
        let plan = StoreyPlan {
            storey: 1,
            z: 30.0 / 11.0,
            outlines: vec![
                [(0.0, 0.0), (6.0, 0.0), (6.0, 8.5), (0.0, 8.5)]
                    .map(|(a, b)| dvec2(a, b))
                    .into(),
            ],
            holes: vec![],
            regions: vec![PlanRegion {
                rect: [0.0, 0.0, 6.0, 8.5],
                polygon: None,
                ridge: Some("a"),
                fall: None,
                role: "main",
                shape: RoofShape::Gable,
                over: None,
            }],
        };
        let building = Building {
            houses: vec![Built {
                house,
                roofs: std::sync::Arc::new(HouseRoofs {
                    plans: vec![plan],
                    ..Default::default()
                }),
                fittings: vec![],
                rooms: vec![],
                fixtures: vec![],
            }],
            images: vec![],
        };
        let expected = concat!(
            r#"{"version":1,"houses":[{"name":"","unit_m":0.909091,"storeys":[{"storey":1,"z":2.727273,"#,
            r#""outline":[[0,0],[6,0],[6,8.5],[0,8.5]],"holes":[],"#,
            r#""regions":[{"a0":0,"b0":0,"a1":6,"b1":8.5,"ridge":"a","fall":null,"role":"main","#,
            r#""shape":"KIR","over":null}]}]}]}"#,
            "\n"
        );
        assert_eq!(regions(&building).expect("has a roof"), expected);
    }
}
