//! The corpus of the fuzz targets, replayed: whatever once made a reader stumble stays mended.

use crate::support::root;
use std::fs;

#[test]
fn the_corpus_passes() {
    let mut count = 0;
    for entry in fs::read_dir(root().join("tests/corpus")).expect("the corpus is there") {
        let path = entry.expect("can be listed").path();
        let bytes = fs::read(&path).expect("can be read");
        hsd::driver::compile_bytes(&path.to_string_lossy(), &bytes);
        count += 1;
    }
    assert!(count > 0, "the corpus is empty");
}
