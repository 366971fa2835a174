//! The same text becomes the same bytes, again and again and on several threads at a time.

use crate::support::{compile_file, texts};
use hsd::building::Building;

/// Everything a run shows, as text: every number of it is written out.
fn all_of(path: &std::path::Path) -> String {
    let run = compile_file(path);
    let json = |building: &Building| serde_json::to_string(building).expect("is plain data");
    let scene = serde_json::to_string(&run.scene).expect("is plain data");
    format!("{}\n{}\n{scene}", run.short(), json(&run.building))
}

#[test]
fn the_same_text_becomes_the_same_scene() {
    for path in texts("examples") {
        let first = all_of(&path);
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| all_of(&path))).collect();
            for thread in threads {
                let again = thread.join().expect("no panic");
                assert!(first == again, "{} differs", path.display());
            }
        });
    }
}
