//! Damages maps and plans at random and gives them to the program. Whatever a file contains, the program must end by itself
//! within its memory and leave the file unchanged.
//!
//! Each case follows from the seed and its number, so that a finding can be made again with `--first`.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

/// Kilobytes of addresses that the program may use; it reserves more than it takes.
const MEMORY: u32 = 4_000_000;
/// A run that takes more processor time hangs, seconds: other programs on the machine do not count.
const PROCESSOR: u32 = 30;
/// A run that takes longer waits for something that does not happen.
const LONGEST: Duration = Duration::from_secs(300);
/// The folder of cases that the program does not survive.
const KEPT: &str = "target/mutate";

const USAGE: &str =
    "Usage: cargo run -p xtask -- mutate PROGRAM [--count N] [--first N] [--seed N] FILE...";

/// Numbers that are written in place of others.
const NUMBERS: [&str; 16] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1e-308",
    "NaN",
    "1e22",
    "180.0001",
    "-180",
    "90.1",
    "-9999",
    "4294967296",
    "18446744073709551615",
    "0.30000000000000004",
    "1e5",
    "",
];

/// The arguments of the task.
struct Wish {
    program: PathBuf,
    count: u64,
    first: u64,
    seed: u64,
    files: Vec<PathBuf>,
}

/// Runs the task.
pub(crate) fn run(arguments: &[String], out: &mut impl Write) -> io::Result<ExitCode> {
    let wish = wish(arguments).ok_or_else(|| io::Error::other(USAGE))?;
    let (mut findings, mut refused, mut built) = (0_u64, 0_u64, 0_u64);
    for number in wish.first..wish.first + wish.count {
        let file = &wish.files[(number % wish.files.len() as u64) as usize];
        let folder = std::env::temp_dir().join(format!("hsd-mutate-{}", std::process::id()));
        fs::create_dir_all(&folder)?;
        let found = case(&wish, file, number, &folder)?;
        match found {
            Ended::Well(0) => built += 1,
            Ended::Well(_) => refused += 1,
            Ended::Badly(why) => {
                findings += 1;
                let kept = Path::new(KEPT).join(number.to_string());
                copy(&folder, &kept)?;
                writeln!(
                    out,
                    "{number} {}: {why}; kept in {}",
                    file.display(),
                    kept.display()
                )?;
            }
        }
        fs::remove_dir_all(&folder)?;
    }
    let count = wish.count;
    writeln!(
        out,
        "{count} cases: {built} built, {refused} refused or with skipped features, {findings} findings"
    )?;
    Ok(ExitCode::from(u8::from(findings > 0)))
}

fn wish(arguments: &[String]) -> Option<Wish> {
    let (program, rest) = arguments.split_first()?;
    let mut wish = Wish {
        program: fs::canonicalize(program).ok()?,
        count: 1000,
        first: 0,
        seed: 1,
        files: vec![],
    };
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        let place = match word.as_str() {
            "--count" => &mut wish.count,
            "--first" => &mut wish.first,
            "--seed" => &mut wish.seed,
            file => {
                wish.files.push(file.into());
                continue;
            }
        };
        *place = rest.next()?.parse().ok()?;
    }
    (!wish.files.is_empty()).then_some(wish)
}

/// The end of a run.
enum Ended {
    /// With this code, by itself.
    Well(i32),
    /// In a way that users must not see.
    Badly(String),
}

/// Damages a file and runs the program on it in a new folder.
fn case(wish: &Wish, file: &Path, number: u64, folder: &Path) -> io::Result<Ended> {
    let mut random = Random::new(wish.seed, number);
    let name = file
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let mut input = fs::read(file)?;
    for _ in 0..=random.below(3) {
        damage(&mut input, &mut random);
    }
    for beside in beside(file)? {
        fs::copy(&beside, folder.join(beside.file_name().unwrap_or_default()))?;
    }
    fs::write(folder.join(&name), &input)?;
    let arguments = arguments(&name, folder)?;
    let ended = ended(wish, &arguments, folder)?;
    Ok(match fs::read(folder.join(&name))? == input {
        true => ended,
        false => Ended::Badly("the input was changed".to_owned()),
    })
}

/// Returns the files that belong to a file: of the same name up to the extension.
fn beside(file: &Path) -> io::Result<Vec<PathBuf>> {
    let folder = file
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let mut all = vec![];
    for entry in fs::read_dir(folder.unwrap_or(Path::new(".")))? {
        let path = entry?.path();
        if path.file_stem() == file.file_stem() && path.is_file() {
            all.push(path);
        }
    }
    Ok(all)
}

/// Writes what the program needs beside the file; returns its arguments.
fn arguments(name: &str, folder: &Path) -> io::Result<Vec<String>> {
    let all = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
    let extension = name.rsplit('.').next().unwrap_or_default();
    if ["png", "jpg", "jpeg", "webp", "pdf", "svg", "dxf"].contains(&extension) {
        return Ok(all(&["plan", name, "-o", "out.hsd"]));
    }
    let (houses, ground) = match extension {
        "asc" | "tif" => (
            "houses.geojson",
            format!("<Layer name=\"g\" src=\"{name}\" crs=\"local\"/>"),
        ),
        _ => (name, String::new()),
    };
    if houses != name {
        let square = "[[[0,0],[9,0],[9,7],[0,7],[0,0]]]";
        let text = format!(
            "{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{{\"type\":\"Polygon\",\"coordinates\":{square}}}}}"
        );
        fs::write(folder.join(houses), text)?;
    }
    let local = if houses == name { "" } else { " crs=\"local\"" };
    let town = format!(
        "<Town name=\"t\"><Layer name=\"a\" src=\"{houses}\"{local}/>{ground}<for each=\"a\"><if test=\"{{area > 0}}\"><Place type=\"block\" on=\"outline\"/></if><else><Fence/></else></for></Town>"
    );
    fs::write(folder.join("t.hsd"), town)?;
    Ok(all(&["town", "t.hsd", "-o", "out", "--detail", "0"]))
}

/// Runs the program with bounds on memory and time.
fn ended(wish: &Wish, arguments: &[String], folder: &Path) -> io::Result<Ended> {
    let mut child = Command::new("sh")
        .args([
            "-c",
            &format!("ulimit -v {MEMORY}; ulimit -t {PROCESSOR}; exec \"$0\" \"$@\""),
        ])
        .arg(&wish.program)
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(fs::File::create(folder.join("messages.txt"))?)
        .spawn()?;
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if begun.elapsed() > LONGEST {
            child.kill()?;
            child.wait()?;
            return Ok(Ended::Badly(format!(
                "ran for more than {} s",
                LONGEST.as_secs()
            )));
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let mut messages = vec![];
    fs::File::open(folder.join("messages.txt"))?.read_to_end(&mut messages)?;
    let said = String::from_utf8_lossy(&messages);
    Ok(match status.code() {
        Some(code @ 0..=3) if !said.contains("panicked at") => Ended::Well(code),
        Some(code) => Ended::Badly(format!("exit {code}")),
        None => Ended::Badly("killed by a signal".to_owned()),
    })
}

/// Damages bytes in one of several ways.
fn damage(bytes: &mut Vec<u8>, random: &mut Random) {
    if bytes.is_empty() {
        return;
    }
    let from = random.below(bytes.len());
    let to = (from + 1 + random.below(64)).min(bytes.len());
    match random.below(7) {
        0 => bytes[from] ^= 1 << random.below(8),
        1 => bytes[from..to].iter_mut().for_each(|b| *b = 0xff),
        2 => bytes[from..to].iter_mut().for_each(|b| *b = 0),
        3 => bytes.truncate(from),
        4 => {
            let copy = bytes[from..to].repeat(1 + random.below(50));
            let at = random.below(bytes.len());
            bytes.splice(at..at, copy);
        }
        5 => drop(bytes.drain(from..to)),
        _ => replace_number(bytes, from, random),
    }
}

/// Writes another number in place of the first one behind a place.
fn replace_number(bytes: &mut Vec<u8>, from: usize, random: &mut Random) {
    let is_digit = |b: &u8| b.is_ascii_digit() || *b == b'.';
    let Some(start) = bytes[from..].iter().position(is_digit).map(|at| from + at) else {
        return;
    };
    let length = bytes[start..].iter().take_while(|b| is_digit(b)).count();
    let other = NUMBERS[random.below(NUMBERS.len())];
    bytes.splice(start..start + length, other.bytes());
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        if path.is_file() {
            fs::copy(&path, to.join(path.file_name().unwrap_or_default()))?;
        }
    }
    Ok(())
}

/// Numbers that follow from a seed (xorshift64*).
struct Random(u64);

impl Random {
    fn new(seed: u64, number: u64) -> Random {
        let mixed = (seed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15)) | 1;
        let mut random = Random(mixed);
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.next() >> 11) % count as u64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_follows_from_its_number() {
        let damaged = |number: u64| {
            let mut bytes = br#"{"coordinates": [135.75, 35.02]}"#.to_vec();
            let mut random = Random::new(7, number);
            (0..3).for_each(|_| damage(&mut bytes, &mut random));
            bytes
        };
        let all: std::collections::BTreeSet<Vec<u8>> = (0..50).map(damaged).collect();
        assert!(all.len() > 40, "{}", all.len());
        assert_eq!(damaged(3), damaged(3));
    }
}
