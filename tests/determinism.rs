//! The same text becomes the same bytes, again and again and on several threads at a time.

use crate::support::{compile, compile_file, texts_in_turn};
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
    for path in texts_in_turn("examples", 1) {
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

/// Unlike houses for more than two batches; every seventh has a wrong code, every fortieth is the twin of its neighbour.
fn town() -> Vec<u8> {
    let house = |n: usize| {
        let (width, depth) = (3 + n % 7, 3 + n / 7 % 9);
        let code = if n.is_multiple_of(7) {
            "QQQ  "
        } else {
            "KSK  "
        };
        let (front, side) = ("GSI  ".repeat(width), "KSK  ".repeat(depth - 1));
        let height = 9.0 + n as f64 / 1000.0;
        format!("{n} 0\n{height}\n\n{front}\n{side}{code}\n{front}\n{side}{code}\n%\n")
    };
    let numbers = (0..1_200).map(|n| if n % 40 == 39 { n - 1 } else { n });
    numbers.map(house).collect::<String>().into_bytes()
}

#[test]
fn any_number_of_threads_makes_the_same_town() {
    let text = town();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let run = pool
            .build()
            .expect("threads start")
            .install(|| compile("town.hsd", &text));
        let building = serde_json::to_string(&run.building).expect("is plain data");
        (run.short(), building)
    };
    let alone = with(1);
    assert!(alone.0.contains("QQQ"), "{}", alone.0);
    for threads in [2, 7] {
        assert!(with(threads) == alone, "{threads} threads");
    }
}
