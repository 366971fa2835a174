//! Tests of `expand`: documents built by hand, so that no reader takes part.

mod build {
    //! Small builders of documents. Every construct gets a span of its own.

    use hsd::ast::*;
    use hsd::diagnostic::Diagnostic;
    use hsd::expand::{Options, expand};
    use hsd::program::{Content, Program, Unit, WallLine};
    use hsd::source::{FileId, PictureFile, Source, Span, Spanned, World};
    use std::cell::Cell;

    thread_local!(static NEXT: Cell<u32> = const { Cell::new(0) });

    pub(crate) fn at() -> Span {
        let start = NEXT.get();
        NEXT.set(start + 2);
        Span {
            file: FileId(0),
            start,
            end: start + 1,
        }
    }

    pub(crate) fn put<T>(value: T) -> Spanned<T> {
        Spanned::new(value, at())
    }

    pub(crate) fn part(code: &str) -> Item<Piece> {
        Item::One(Piece::new(CodeText::new(code), at()))
    }

    pub(crate) fn codes(text: &str) -> Vec<Item<Piece>> {
        let cells: Vec<char> = text.chars().collect();
        let cell = |cell: &[char]| part(&cell.iter().collect::<String>());
        cells.chunks(5).map(cell).collect()
    }

    pub(crate) fn random<T>(list: &str) -> Item<T> {
        weighted(list, None)
    }

    pub(crate) fn weighted<T>(list: &str, weights: Option<Vec<f64>>) -> Item<T> {
        Item::Random(Box::new(Random {
            span: at(),
            codes: put(list.into()),
            weights: weights.map(put),
        }))
    }

    pub(crate) fn replace<T>(list: &str, with: &str) -> Item<T> {
        Item::Replace(Box::new(Replace {
            span: at(),
            codes: (!list.is_empty()).then(|| put(list.into())),
            with: put(with.into()),
            at: None,
        }))
    }

    pub(crate) fn replace_at<T>(list: &str, with: &str, at: &[(u32, u32)]) -> Item<T> {
        let Item::Replace(mut replace) = replace::<T>(list, with) else {
            unreachable!()
        };
        replace.at = Some(put(at.to_vec()));
        Item::Replace(replace)
    }

    pub(crate) fn repeat<T>(num: u32, body: Vec<Item<T>>) -> Item<T> {
        Item::Repeat(Box::new(Repeat {
            span: at(),
            num: put(num),
            body,
        }))
    }

    pub(crate) fn split(upper: Vec<Item<Piece>>, lower: Vec<Item<Piece>>) -> Item<Piece> {
        let half = |pieces| Half { span: at(), pieces };
        Item::One(Piece::Split(Box::new(Split {
            span: at(),
            ratio: None,
            upper: half(upper),
            lower: half(lower),
        })))
    }

    pub(crate) fn row(pieces: Vec<Item<Piece>>) -> Item<Row> {
        Item::One(Row {
            span: at(),
            pieces,
            turn: None,
        })
    }

    pub(crate) fn storey(rows: Vec<Item<Row>>) -> Storey {
        Storey {
            span: at(),
            loops: vec![Loop {
                span: at(),
                rows,
                ..Loop::default()
            }],
            ..Storey::default()
        }
    }

    pub(crate) fn house(storeys: Vec<Storey>) -> House {
        House {
            span: at(),
            storeys: storeys.into_iter().map(Item::One).collect(),
            ..House::default()
        }
    }

    /// A house of one row.
    pub(crate) fn one_row(pieces: Vec<Item<Piece>>) -> House {
        house(vec![storey(vec![row(pieces)])])
    }

    pub(crate) fn floor(id: &str, pieces: Vec<Item<Piece>>) -> Item<Floor> {
        Item::One(Floor {
            span: at(),
            id: (!id.is_empty()).then(|| put(id.into())),
            height: None,
            kind: StoreyKind::Storey,
            pieces,
        })
    }

    pub(crate) fn facade(floors: Vec<Item<Floor>>) -> Facade {
        Facade {
            span: at(),
            id: None,
            ratio: None,
            angle: None,
            reflection: false,
            floors,
        }
    }

    pub(crate) fn structure(size: Option<f64>, facades: Vec<Facade>) -> House {
        House {
            span: at(),
            structures: vec![Structure {
                span: at(),
                size: size.map(put),
                scale: None,
                rightwards: false,
                facades: facades.into_iter().map(Item::One).collect(),
            }],
            ..House::default()
        }
    }

    /// A world with these pictures.
    pub(crate) struct Pictures(pub(crate) Vec<(&'static str, (u32, u32))>);

    impl World for Pictures {
        fn picture(&self, name: &str) -> Option<PictureFile> {
            let (name, size) = self.0.iter().find(|(n, _)| *n == name)?;
            Some(PictureFile {
                path: format!("textures/{name}.png"),
                size: *size,
            })
        }

        fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
            Err(std::io::Error::other(path))
        }
    }

    pub(crate) fn run_in(
        house: House,
        world: &dyn World,
        options: &Options,
    ) -> (Program, Vec<Diagnostic>) {
        let source = Source::new(FileId(0), "test.hsd", " ".repeat(1 << 16).as_bytes());
        let document = Document {
            houses: vec![house],
            ..Document::default()
        };
        let mut out = hsd::diagnostic::Diagnostics::new();
        let documents = [(&source, &document)];
        let program = expand(&documents, hsd::parse::builtin(), world, options, &mut out);
        (program, out.into_sorted())
    }

    pub(crate) fn run(house: House) -> (Program, Vec<Diagnostic>) {
        run_in(house, &hsd::source::NoFiles, &Options::default())
    }

    /// Runs a house of which nothing may be said.
    pub(crate) fn clean(house: House) -> Program {
        let (program, said) = run(house);
        assert!(said.is_empty(), "{said:#?}");
        program
    }

    pub(crate) fn numbers(said: &[Diagnostic]) -> Vec<u16> {
        said.iter().map(|d| d.code.0).collect()
    }

    pub(crate) fn name(program: &Program, unit: &Unit) -> String {
        match &unit.content {
            Content::Void => ".....".into(),
            Content::Part(id) => hsd::parse::builtin().part(*id).code().into(),
            Content::Picture(id) => program.pictures[id.0 as usize].name.clone(),
            Content::Split(split) => format!(
                "({}/{})",
                names_of(program, &split.upper),
                names_of(program, &split.lower)
            ),
        }
    }

    pub(crate) fn names_of(program: &Program, units: &[Unit]) -> String {
        let names: Vec<_> = units.iter().map(|unit| name(program, unit)).collect();
        names.join("|")
    }

    pub(crate) fn line(program: &Program, storey: usize, line: usize) -> &WallLine {
        &program.houses[0].storeys[storey].loops[0].lines[line]
    }

    pub(crate) fn names(program: &Program, storey: usize, at: usize) -> String {
        names_of(program, &line(program, storey, at).units)
    }

    pub(crate) fn width(units: &[Unit]) -> f64 {
        units.iter().map(|unit| unit.width).sum()
    }
}

mod codes;
mod facades;
mod limits;
mod operations;
mod pages;
mod storeys;
