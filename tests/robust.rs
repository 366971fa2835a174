//! Bad input: nothing panics, every error has its place, nothing takes long (docs/contract.md 7). How long is compared with the
//! examples and with smaller inputs; the seconds of a mebibyte are shown by `cargo bench --bench reading`.

pub(crate) mod heaps;
#[cfg(target_os = "linux")]
mod mebibyte;
mod mutations;

use crate::support::cpu::{assert_linear, growth, spent};
use crate::support::{
    OPTIMISED, Run, assert_none, compile, flaws_of_diagnostics, number, on_all_processors, stem,
    texts, texts_in_turn, thorough,
};
use heaps::{comb, heaps, pile_of_roofs, unlike_stairs};
use hsd::diagnostic::{Code, Diagnostics, Severity};
use hsd::source::{FileId, NoFiles, Source};
use hsd::{Options, driver};
use mutations::mutation;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::LazyLock;
use std::time::Duration;

/// The most processor time that an input may take: ten times that of the longest example.
static BOUND: LazyLock<Duration> = LazyLock::new(|| {
    let examples = read(texts("examples"));
    let time = |(name, bytes): &(String, Vec<u8>)| spent(|| compile(name, bytes)).1;
    10 * examples.iter().map(time).max().expect("there are examples")
});

/// Returns the number of inputs to try: half of all, or all if [`thorough`] and `HSD_INPUTS` times as many. An unoptimised program
/// tries fewer.
fn share(all: usize) -> usize {
    let all = all * number("HSD_INPUTS", 1);
    match (OPTIMISED, thorough()) {
        (false, _) => all / 8,
        (true, false) => all / 2,
        (true, true) => all,
    }
}

/// Compiles an input and reports what is wrong with the diagnostics and with the time that it took.
fn findings_of(name: &str, bytes: &[u8]) -> (Run, Vec<String>) {
    let (run, took) = spent(|| compile(name, bytes));
    let mut findings = flaws_of_diagnostics(&run, bytes.len());
    // Once more, in case something else disturbed the first try.
    if took > *BOUND && spent(|| compile(name, bytes)).1 > *BOUND {
        findings.push(format!("took {took:?}, more than {:?}", *BOUND));
    }
    (run, findings)
}

/// The examples that are cut and changed.
fn examples() -> Vec<(String, Vec<u8>)> {
    read(texts_in_turn("examples", 1))
}

fn read(paths: Vec<PathBuf>) -> Vec<(String, Vec<u8>)> {
    let read = |path: PathBuf| (stem(&path), fs::read(&path).expect("examples can be read"));
    paths.into_iter().map(read).collect()
}

#[test]
fn examples_cut_anywhere() {
    let examples = examples();
    let cuts: Vec<(&str, &[u8])> = examples
        .iter()
        .flat_map(|(name, bytes)| {
            let step = 1 + bytes.len() / share(120); // the long ones in steps
            let ends = (0..bytes.len()).step_by(step);
            ends.map(|end| (name.as_str(), &bytes[..end]))
        })
        .collect();
    assert_none(&on_all_processors(cuts.len(), |index| {
        let (name, bytes) = cuts[index];
        let (_, findings) = findings_of(name, bytes);
        let told = |finding| format!("{name} cut at {}: {finding}", bytes.len());
        findings.into_iter().map(told).collect()
    }));
}

#[test]
fn examples_changed_at_random() {
    let examples = examples();
    assert_none(&on_all_processors(share(800), |index| {
        let (name, bytes) = mutation(&examples, index);
        let (_, findings) = findings_of(&name, &bytes);
        findings
            .into_iter()
            .map(|f| format!("{name}: {f}"))
            .collect()
    }));
}

/// A sample goes through the back end too.
#[test]
fn changed_examples_become_files() {
    let examples = examples();
    assert_none(&on_all_processors(share(200), |index| {
        let (name, bytes) = mutation(&examples, index * 7);
        hsd::driver::compile_bytes(&name, &bytes);
        vec![]
    }));
}

fn check(path: &std::path::Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hsd"))
        .arg("check")
        .arg(path)
        .output()
        .expect("the program starts")
}

#[test]
fn the_exit_status_tells_of_errors() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let examples = examples();
    let mut findings = vec![];
    for index in 0..40 {
        let (name, bytes) = mutation(&examples, index);
        let path = folder.path().join("changed.hsd");
        fs::write(&path, &bytes).expect("can be written");
        let wanted = i32::from(compile("changed.hsd", &bytes).has_errors());
        let output = check(&path);
        if output.status.code() != Some(wanted) {
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            findings.push(format!("{name}: {:?}, not {wanted}\n{told}", output.status));
        }
    }
    assert_none(&findings);
}

/// Fails unless an input is refused, quickly and with a place.
fn assert_refused(name: &str, bytes: &[u8]) {
    let (run, findings) = findings_of(name, bytes);
    assert_none(&findings);
    assert!(run.has_errors(), "{name} is taken without an error");
}

/// Fails if an input makes the program panic or takes long; any diagnostics will do.
fn assert_survived(name: &str, bytes: &[u8]) {
    let (_, findings) = findings_of(name, bytes);
    assert_none(&findings);
}

#[test]
fn entities_are_refused() {
    let lol: String = (1..10)
        .map(|n| {
            format!(
                "<!ENTITY lol{n} \"{}\">",
                format!("&lol{};", n - 1).repeat(10)
            )
        })
        .collect();
    let bomb = format!(
        "<?xml version=\"1.0\"?><!DOCTYPE a [<!ENTITY lol0 \"lol\">{lol}]><House name=\"&lol9;\"/>"
    );
    assert_refused("billion laughs", bomb.as_bytes());
    let file = "<!DOCTYPE a [<!ENTITY e SYSTEM \"file:///etc/passwd\">]><House><Storey><Row>&e;</Row></Storey></House>";
    assert_refused("a file as entity", file.as_bytes());
    assert_refused(
        "an unknown entity",
        b"<House><Storey><Row>&nbsp;</Row></Storey></House>",
    );
}

#[test]
fn deep_nesting_is_refused() {
    for element in ["repeat num=\"1\"", "split", "House", "Row"] {
        let name = element.split(' ').next().unwrap_or(element);
        let (open, close) = (format!("<{element}>"), format!("</{name}>"));
        for depth in [100, 50_000] {
            let body = format!("{}{}", open.repeat(depth), close.repeat(depth));
            let text = format!("<House><Storey><Row>{body}</Row></Storey></House>");
            assert_refused(&format!("{depth} times {name}"), text.as_bytes());
            assert_refused(
                &format!("{depth} times {name}, open"),
                open.repeat(depth).as_bytes(),
            );
        }
    }
    let deep = format!(
        "<House unit=\"{{{}1{}}}\"/>",
        "(".repeat(50_000),
        ")".repeat(50_000)
    );
    assert_refused("a deep expression", deep.as_bytes());
}

#[test]
fn endless_repetition_is_refused() {
    let row = |inner: &str| format!("<House><Storey><Row>{inner}</Row></Storey></House>");
    let once = row("<repeat num=\"1000000000\"><Part code=\"KSK\"/></repeat>");
    assert_refused("repeat 1e9", once.as_bytes());
    let nested = "<repeat num=\"1000\">".repeat(6) + "KSK" + &"</repeat>".repeat(6);
    assert_refused("repeat in repeat", row(&nested).as_bytes());
    let empty = "<repeat num=\"4000000000\">".repeat(6) + &"</repeat>".repeat(6);
    assert_survived("repeat of nothing", row(&empty).as_bytes());
    let storeys =
        "<House><repeat num=\"1000000000\"><Storey><Row>KSK</Row></Storey></repeat></House>";
    assert_refused("storeys without end", storeys.as_bytes());
    let splits =
        row("<repeat num=\"2000000\"><split><upper>KSK</upper><lower>KSK</lower></split></repeat>");
    assert_refused("too many halves", splits.as_bytes());
}

#[test]
fn storeys_of_monuments_are_counted_over_all_houses() {
    let text = format!("<Houses>{}</Houses>", "<House><Pagoda/></House>".repeat(5));
    let source = Source::new(FileId(0), "short.hsd", text.as_bytes());
    let mut options = hsd::Options::default();
    options.expand.limits.parts = 15_000; // twelve storeys
    let mut out = Diagnostics::new();
    let made = hsd::compile(&[&source], &NoFiles, &options, &mut out);
    assert_eq!(made.building.houses.len(), 2, "what fits is built");
    let codes: Vec<_> = out.iter().map(|d| d.code).collect();
    assert_eq!(codes, [Code(904), Code(420)], "each said once");
}

#[test]
fn a_file_beyond_the_limit_is_refused() {
    let bytes = vec![b'#'; (16 << 20) + 1];
    assert_refused("more than 16 MiB", &bytes);
}

/// Far longer than any example, so they are compared with a quarter of themselves.
#[test]
fn more_than_can_be_roofed_is_told() {
    type Make = fn(usize) -> Vec<u8>;
    let inputs: [(&str, Make); 2] = [("comb", comb), ("pile", pile_of_roofs)];
    assert_none(&on_all_processors(inputs.len(), |index| {
        let (name, make) = inputs[index];
        let bytes = make(20_000);
        let run = compile(name, &bytes);
        let mut findings = flaws_of_diagnostics(&run, bytes.len());
        if !run.diagnostics.iter().any(|d| d.code == Code(906)) {
            findings.push("HSD0906 is missing".into());
        }
        findings.extend(growth(5_000, make, |bytes| compile(name, bytes)));
        let told = |finding| format!("{name}: {finding}");
        findings.into_iter().map(told).collect()
    }));
}

/// Houses of thirty roofs each, no two of them alike, cannot all be searched for their best cuts. Only the roofs are measured:
/// a scene of them is some hundred times as large as the source file.
#[test]
fn more_than_can_be_searched_is_reported_and_takes_linear_time() {
    let make = |bytes| Source::new(FileId(0), "stairs.hsd", &unlike_stairs(30, bytes));
    assert_linear("a row of stairs", 1 << 16, make, |source| {
        let (options, mut out) = (Options::default(), Diagnostics::new());
        let checked = driver::check(&[source], &NoFiles, &options, &mut out);
        assert!(checked.building.houses.len() > 40);
        let told = out.iter().any(|d| d.code == Code(906));
        assert!(told, "HSD0906 is missing");
    });
}

#[test]
fn a_heap_of_anything_takes_linear_time() {
    let heaps = heaps();
    let size = (1 << 15) * number("HSD_INPUTS", 1);
    assert_none(&on_all_processors(heaps.len(), |index| {
        let heap = &heaps[index];
        let (_, mut findings) = findings_of(heap.name, &heap.of(4 * size));
        findings.extend(growth(
            size,
            |bytes| heap.of(bytes),
            |b| compile(heap.name, b),
        ));
        let told = |finding| format!("{}: {finding}", heap.name);
        findings.into_iter().map(told).collect()
    }));
}

#[test]
fn every_error_has_a_severity_that_counts() {
    let run = compile("broken.hsd", b"0 0\n9\n\nXXXXX\n");
    let errors = run
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error);
    assert_eq!(run.has_errors(), errors.count() > 0);
    assert!(run.has_errors());
}
