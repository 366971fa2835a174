//! Source files that are large for their content, or ask for more than can be built.

/// A storey of so many teeth in a row.
pub(crate) fn comb(teeth: usize) -> Vec<u8> {
    let side = "KSK  \nKSK  L\nKSK  L\nKSK  \n".repeat(teeth - 1);
    let front = "KSK  ".repeat(2 * teeth - 1);
    format!("0 0\n9\n\n{front}\nKSK  KSK  \n{side}KSK  \nKSK  KSK  \n").into_bytes()
}

/// A house whose plan climbs in so many steps, so many thousandths of a shaku higher than usual, as its lines.
pub(crate) fn stair(steps: usize, higher: usize) -> String {
    let height = 9.0 + higher as f64 / 1000.0;
    let front = "KSK  ".repeat(steps);
    let side = "KSK  L\nKSK  \n".repeat(steps - 1);
    format!("0 0\n{height}\n\n{front}\nKSK  \n{side}KSK  \n{front}\n%\n")
}

/// Such houses up to a number of bytes, no two of one plan.
pub(crate) fn unlike_stairs(steps: usize, bytes: usize) -> Vec<u8> {
    let mut text = String::new();
    for higher in 0.. {
        let next = stair(steps, higher);
        if text.len() + next.len() > bytes {
            break;
        }
        text += &next;
    }
    text.into_bytes()
}

/// A house with more roof lines than anybody means, each in others' way.
pub(crate) fn pile_of_roofs(roofs: usize) -> Vec<u8> {
    let wall = "KSK  ".repeat(200);
    let line = |n: usize| {
        let (a, b) = (n * 37 % 190, n * 61 % 193);
        format!("K X * KIR {a} {b} {} {}\n", a + 1 + n % 5, b + 1 + n % 4)
    };
    let lines: String = (0..roofs).map(line).collect();
    format!("0 0\n9\n\n{wall}\n{wall}\n{wall}\n{wall}\n\n{lines}").into_bytes()
}

/// One piece again and again.
pub(crate) struct Heap {
    pub(crate) name: &'static str,
    head: String,
    piece: Vec<u8>,
}

impl Heap {
    /// As much of it as fits into a number of bytes.
    pub(crate) fn of(&self, bytes: usize) -> Vec<u8> {
        let count = bytes.saturating_sub(self.head.len()) / self.piece.len();
        [self.head.as_bytes(), &self.piece.repeat(count)].concat()
    }
}

/// Heaps of everything that either form of the language knows, and of what neither does.
pub(crate) fn heaps() -> Vec<Heap> {
    let walls = "0 0\n9\n\nKSK  \nKSK  \nKSK  \nKSK  \n";
    let house = "<House><Storey><Row>";
    let roofed = format!("{walls}\n");
    let long_row = format!("{house}{}", "KSK  ".repeat(1_000));
    let text = |name: &'static str, head: &str, piece: &str| Heap {
        name,
        head: head.to_owned(),
        piece: piece.as_bytes().to_vec(),
    };
    let bytes = |name, piece: &[u8]| Heap {
        name,
        head: String::new(),
        piece: piece.to_vec(),
    };
    vec![
        text("codes in one line", "0 0\n9\n\n", "KSK  "),
        text("lines", "0 0\n9\n\n", "KSK  \n"),
        text("zigzag", "0 0\n9\n\n", "KSK  \nKSK  L\n"),
        text("unknown codes", "0 0\n9\n\n", "XXXXX\n"),
        text("full-width blanks", "0 0\n9\n\n", "\u{3000}"),
        text("tabs", "0 0\n9\n\n", "KSK\t\n"),
        text("storeys", "0 0\n9\n\n", "KSK  ^\n"),
        text("houses", "", &format!("{walls}%\n")),
        text("empty houses", "", "%\n"),
        text("stairs of 10", "", &stair(10, 0)),
        text("stairs of 100", "", &stair(100, 0)),
        text("stairs of 300", "", &stair(300, 0)),
        text("stairs of 1000", "", &stair(1000, 0)),
        bytes("combs of 15", &[comb(15), b"%\n".to_vec()].concat()),
        text("heights", "0 0\n", "9 "),
        text("roof lines", &roofed, "K X * KIR 0 0 1 1\n"),
        text("broken roof lines", &roofed, "K X\n"),
        text("NUL", "", "\0"),
        bytes("0xff", b"\xff"),
        bytes("kana of Shift_JIS", b"\x83\x41"),
        text("angle brackets", "", "<"),
        text("open rows", house, "<Row>"),
        text("open attributes", house, "<Part code=\""),
        text("empty elements", house, "<Part/>"),
        text("unknown elements", house, "<X/>"),
        text("attributes", "<House ", "a=\"1\" "),
        text("text", house, "KSK  "),
        text("unknown text", house, "XXXXX"),
        text("ampersands", house, "&"),
        text("entities", house, "&lol;"),
        text("expressions", house, "{1}"),
        text("wrong expressions", house, "{(}"),
        text("one long expression", "<House unit=\"{1", "+1"),
        text("one long sum", "<House><let name=\"a\" value=\"{1", "-(1)"),
        text("comments", "<House>", "<!-- -->"),
        text("comment openings", "<House>", "<!--"),
        text("draws", house, "<random code=\"KSK, KTU\"/>"),
        text(
            "substitutions",
            house,
            "<replace code=\"KSK\" with=\"KTU\"/>",
        ),
        text(
            "edits of a long row",
            &long_row,
            "<replace code=\"KSK\" with=\"KTU\"/>",
        ),
        text(
            "loops",
            "<House><Storey>",
            "<Loop hole=\"yes\"><Row>KSK</Row></Loop>",
        ),
        text(
            "pagodas",
            "<Houses>",
            "<House><Pagoda storeys=\"15\" bays=\"9\"/></House>",
        ),
        text("shrines", "<Houses>", "<House><Shrine/></House>"),
        text("lets", "<House>", "<let name=\"a\" value=\"1\"/>"),
        text("houses of a word", "", "x\n%\n"),
        text("houses of a number", "", "0\n%\n"),
        text("houses of a header", "", "0 0\n%\n"),
        text("houses of a wall", "", "1 1\n9\n\nKSK  \n%\n"),
        text("houses of nothing", "<Houses>", "<House/>"),
        text("storeys of nothing", "<House>", "<Storey/>"),
        text("rows of nothing", "<House><Storey>", "<Row/>"),
        text("carets", "0 0\n9\n\n", "^\n"),
        text("comment lines", walls, "# x\n"),
        text("control characters", "0 0\n9\n\n", "\u{1}"),
        text(
            "full-width codes",
            "0 0\n9\n\n",
            "\u{ff2b}\u{ff33}\u{ff2b}\n",
        ),
        text("one long name", "<House name=\"", "\u{753a}"),
        text("character references", house, "&#75;"),
        text("definitions", "<House>", "<define name=\"p\">KSK</define>"),
        text(
            "uses",
            "<House><define name=\"p\">KSK KTU KSK KTU</define><Storey><Row>",
            "<use name=\"p\"/>",
        ),
        text("parts", "<Catalog>", "<PartDef code=\"ABC\" width=\"1\"/>"),
        text(
            "repetitions in one row",
            house,
            "<repeat num=\"70\">KSK</repeat>",
        ),
        text(
            "repetitions in rows",
            "<House><Storey>",
            "<Row><repeat num=\"90\">KSK</repeat></Row>",
        ),
        text(
            "repetitions in houses",
            "<Houses>",
            "<House><Storey><Row><repeat num=\"1500000\">KSK</repeat></Row></Storey></House>",
        ),
        text(
            "repeated storeys",
            "<Houses>",
            "<House><repeat num=\"1000000\"><Storey><Row/></Storey></repeat></House>",
        ),
        text(
            "facades",
            "<Structure><Facades>",
            "<Facade><Floor>KSK</Floor></Facade>",
        ),
    ]
}
