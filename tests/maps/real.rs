//! The maps beside the repository, with the counts that their descriptions give.

use super::read_in;
use crate::support::root;
use hsd::map::Options;

/// Maps of GeoJSON with the number of their features.
const GEOJSON: &[(&str, usize)] = &[
    ("edo_codh/edo-coastline-clip.geojson", 3),
    ("edo_codh/edo-machiya-areas.geojson", 28),
    ("edo_codh/edo-places.geojson", 5784),
    ("edo_codh/kyoto-bakumatsu-places.geojson", 36),
    ("moj_parcels/joetsu_15222.geojson", 541),
    ("osm_kyoto_route18/buildings.geojson", 1771),
    ("osm_kyoto_route18/hedges.geojson", 48),
    ("osm_kyoto_route18/roads.geojson", 1276),
    ("osm_kyoto_route18/sidewalks.geojson", 270),
    ("osm_kyoto_route18/trees.geojson", 439),
    ("osm_kyoto_streets/streets.geojson", 620),
    ("osm_kyoto_streets/water.geojson", 130),
    ("osm_meijimura/barriers.geojson", 169),
    ("osm_meijimura/buildings.geojson", 143),
    ("osm_meijimura/landuse.geojson", 128),
    ("osm_meijimura/roads.geojson", 366),
    ("osm_meijimura/trees.geojson", 20),
    ("osm_tokyo_asakusa/barriers.geojson", 211),
    ("osm_tokyo_asakusa/buildings.geojson", 1489),
    ("osm_tokyo_asakusa/landuse.geojson", 20),
    ("osm_tokyo_asakusa/roads.geojson", 488),
    ("osm_tokyo_asakusa/trees.geojson", 150),
    ("plateau_kyoto_roads/blocks_derived.geojson", 640),
    ("plateau_kyoto_roads/roads_tran.geojson", 1311),
    ("plateau_tokyo_yanaka/buildings.geojson", 1307),
];

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn every_map_of_geojson_has_its_features() {
    let folder = root().join("../shared/data");
    for (name, count) in GEOJSON {
        let read = read_in(&folder, name, &Options::default()).unwrap();
        let (built, lost) = read.counts();
        println!(
            "{name}: {built} features, {lost} lost, {} remarks",
            read.remarks.len()
        );
        for fault in read.lost.iter().chain(&read.remarks).take(5) {
            println!("  {fault:?}");
        }
        assert_eq!(built + lost, *count, "{name}");
    }
}
