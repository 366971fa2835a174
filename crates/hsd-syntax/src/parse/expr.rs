//! Expressions (docs/contract.md 3): the content of braces, as a tree with places.
//!
//! From the loosest to the tightest: `or`, `and`, `not`, one comparison, `+ -`, `* / %`, the sign. Chains of equal
//! operators are lists, so that only parentheses nest, and those at most [`DEEPEST`] deep: no expression is too
//! long for the stack. `hsd` has no operator that is written otherwise in XML but `&lt;` for `<`.

mod evaluate;

pub(super) use evaluate::{FUNCTIONS, Meanings, PI, Problem, TOWN_FUNCTIONS, evaluate};

use hsd_base::diagnostic::{Noun, noun};
use hsd_ir::ast::Value;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while};
use nom::character::complete::{char, digit1, one_of, satisfy};
use nom::combinator::{cut, not, opt, recognize, value};
use nom::error::{ErrorKind, ParseError};
use nom::multi::separated_list1;
use nom::sequence::{delimited, pair, preceded, terminated};
use nom::{Err, IResult, Parser};
use std::ops::Range;

/// The maximum depth of open parentheses.
const DEEPEST: usize = 64;

/// Reserved words, which cannot be names.
pub(super) const RESERVED: [&str; 8] = ["and", "or", "not", "true", "false", "yes", "no", "k"];

/// An expression and its range of bytes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Expr {
    pub(super) range: Range<usize>,
    pub(super) kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    Value(Value),
    Name(String),
    Call(String, Vec<Expr>),
    Negative(Box<Expr>),
    Not(Box<Expr>),
    /// Operands with operators of one rank between them.
    Chain(Box<Expr>, Vec<(Operator, Expr)>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Or,
    And,
    Equal,
    Unequal,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Plus,
    Minus,
    Times,
    Divided,
    Remainder,
}

/// The reason why a string is not an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// The unexpected part; empty at the end.
    pub(super) range: Range<usize>,
    pub(super) wanted: Noun,
}

const OPERAND: Noun = noun(
    "a number, a name, a text in quotes or `(`",
    "数値、名前、引用符で囲んだ文字列、`(` のどれか",
);
const OPERATOR: Noun = noun("an operator such as `+`", "`+` などの演算子");
const CLOSING: Noun = noun("`)` or an operator", "`)` か演算子");
const NEXT: Noun = noun("`,`, `)` or an operator", "`,`、`)` か演算子");
const QUOTE: Noun = noun(
    "the quote that closes this text",
    "この文字列を閉じる引用符",
);
const SMALLER: Noun = noun("a smaller number", "もっと小さい数値");
const AND: Noun = noun("`and` between two comparisons", "二つの比較をつなぐ `and`");
const FLATTER: Noun = noun(
    "an expression with fewer parentheses inside one another",
    "括弧の入れ子がもっと浅い式",
);

/// Parses the content of braces.
pub(super) fn parse(text: &str) -> Result<Expr, Fault> {
    let grammar = Grammar { whole: text };
    if let Some(at) = too_deep(text) {
        let wanted = FLATTER;
        return Err(Fault {
            range: at..at + 1,
            wanted,
        });
    }
    let missed = match grammar.either(text) {
        Ok((rest, expr)) => match blanks(rest) {
            "" => return Ok(expr),
            rest => Missed {
                rest,
                wanted: OPERATOR,
            },
        },
        Err(Err::Error(missed) | Err::Failure(missed)) => missed,
        Err(Err::Incomplete(_)) => Missed {
            rest: "",
            wanted: OPERAND,
        },
    };
    let rest = blanks(missed.rest);
    let start = text.len() - rest.len();
    Err(Fault {
        range: start..start + word_at(rest),
        wanted: missed.wanted,
    })
}

/// Returns true if the text is a valid name.
pub(super) fn is_name(text: &str) -> bool {
    text.starts_with(begins_name) && text.chars().all(in_name)
}

fn begins_name(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

fn in_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Returns the places of the author's names in an expression, even in an invalid one; words in quotes, numbers,
/// functions and reserved words are not names.
pub(super) fn names(text: &str) -> Vec<Range<usize>> {
    let (mut found, mut at) = (vec![], 0);
    while let Some(c) = text[at..].chars().next() {
        let end = at + word_at(&text[at..]);
        if let '\'' | '"' = c {
            let close = text[end..].find(c).map(|i| end + i + 1);
            at = close.unwrap_or(text.len());
            continue;
        }
        let (word, rest) = (&text[at..end], blanks(&text[end..]));
        if begins_name(c) && !RESERVED.contains(&word) && !rest.starts_with('(') {
            found.push(at..end);
        }
        at = end;
    }
    found
}

/// Returns the offset of a parenthesis that exceeds the maximum depth.
fn too_deep(text: &str) -> Option<usize> {
    let (mut depth, mut quote) = (0usize, None);
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(open), _) if open == c => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') => quote = Some(c),
            (None, '(') => depth += 1,
            (None, ')') => depth = depth.saturating_sub(1),
            (None, _) => {}
        }
        if depth > DEEPEST {
            return Some(at);
        }
    }
    None
}

/// Returns the length of the word or sign at the start of a string.
fn word_at(text: &str) -> usize {
    let first = text.chars().next();
    match first {
        Some(c) if in_name(c) => text.find(|c| !in_name(c)).unwrap_or(text.len()),
        Some(c) => c.len_utf8(),
        None => 0,
    }
}

fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{3000}')
}

fn blanks(text: &str) -> &str {
    text.trim_start_matches(is_blank)
}

/// A parse failure: the remaining input and the expected item.
#[derive(Debug)]
struct Missed<'a> {
    rest: &'a str,
    wanted: Noun,
}

impl<'a> ParseError<&'a str> for Missed<'a> {
    fn from_error_kind(rest: &'a str, _: ErrorKind) -> Self {
        let wanted = OPERAND;
        Missed { rest, wanted }
    }

    fn append(_: &'a str, _: ErrorKind, other: Self) -> Self {
        other
    }
}

type Step<'a, T> = IResult<&'a str, T, Missed<'a>>;

/// The grammar rules, with the whole string for computing offsets.
#[derive(Clone, Copy)]
struct Grammar<'a> {
    whole: &'a str,
}

type Rule<'a> = fn(Grammar<'a>, &'a str) -> Step<'a, Expr>;

impl<'a> Grammar<'a> {
    fn either(self, text: &'a str) -> Step<'a, Expr> {
        let or = value(Operator::Or, keyword("or"));
        self.chain(text, Self::both, or)
    }

    fn both(self, text: &'a str) -> Step<'a, Expr> {
        let and = value(Operator::And, keyword("and"));
        self.chain(text, Self::negation, and)
    }

    fn negation(self, text: &'a str) -> Step<'a, Expr> {
        let (mut rest, mut starts) = (blanks(text), vec![]);
        while let Ok((after, _)) = keyword("not").parse(rest) {
            starts.push(self.at(rest));
            rest = blanks(after);
        }
        let (rest, inner) = self.comparison(rest)?;
        Ok((rest, wrap(inner, &starts, Kind::Not)))
    }

    fn comparison(self, text: &'a str) -> Step<'a, Expr> {
        let mut operator = alt((
            value(Operator::LessOrEqual, tag("<=")),
            value(Operator::GreaterOrEqual, tag(">=")),
            value(Operator::Unequal, tag("!=")),
            value(Operator::Equal, alt((tag("=="), tag("=")))),
            value(Operator::Less, tag("<")),
            value(Operator::Greater, tag(">")),
        ));
        let (rest, left) = self.sum(text)?;
        let found: Step<'a, Operator> = operator.parse(blanks(rest));
        let Ok((after, sign)) = found else {
            return Ok((rest, left));
        };
        let (rest, right) = self.sum(after)?;
        if operator.parse(blanks(rest)).is_ok() {
            let wanted = AND;
            return Err(Err::Failure(Missed { rest, wanted }));
        }
        Ok((rest, joined(left, vec![(sign, right)])))
    }

    fn sum(self, text: &'a str) -> Step<'a, Expr> {
        let plus = value(Operator::Plus, char('+'));
        let minus = value(Operator::Minus, one_of("-−"));
        self.chain(text, Self::product, alt((plus, minus)))
    }

    fn product(self, text: &'a str) -> Step<'a, Expr> {
        let times = value(Operator::Times, one_of("*×"));
        let divided = value(Operator::Divided, one_of("/÷"));
        let remainder = value(Operator::Remainder, char('%'));
        self.chain(text, Self::signed, alt((times, divided, remainder)))
    }

    fn signed(self, text: &'a str) -> Step<'a, Expr> {
        let (mut rest, mut starts) = (blanks(text), vec![]);
        while let Some(c) = rest.chars().next().filter(|c| "-−+".contains(*c)) {
            if c != '+' {
                starts.push(self.at(rest));
            }
            rest = blanks(&rest[c.len_utf8()..]);
        }
        let (rest, inner) = self.operand(rest)?;
        Ok((rest, wrap(inner, &starts, Kind::Negative)))
    }

    fn operand(self, text: &'a str) -> Step<'a, Expr> {
        let text = blanks(text);
        match text.chars().next() {
            Some('(') => {
                let (rest, mut inner) = self.either(&text[1..])?;
                let rest = self.close(rest)?;
                inner.range = self.at(text)..self.at(rest);
                Ok((rest, inner))
            }
            Some('\'' | '"') => self.quoted(text),
            Some('0'..='9' | '.') => self.number(text),
            Some(c) if begins_name(c) => self.name(text),
            _ => Err(Err::Error(Missed {
                rest: text,
                wanted: OPERAND,
            })),
        }
    }

    fn close(self, text: &'a str) -> Result<&'a str, Err<Missed<'a>>> {
        let rest = blanks(text);
        rest.strip_prefix(')').ok_or(Err::Failure(Missed {
            rest,
            wanted: CLOSING,
        }))
    }

    fn quoted(self, text: &'a str) -> Step<'a, Expr> {
        let single = delimited(char('\''), take_till(|c| c == '\''), char('\''));
        let double = delimited(char('"'), take_till(|c| c == '"'), char('"'));
        let read: Step<'a, &str> = alt((single, double)).parse(text);
        let (rest, inner) = read.map_err(|_| {
            let wanted = QUOTE;
            Err::Failure(Missed { rest: text, wanted })
        })?;
        Ok(self.made(text, rest, Kind::Value(Value::Text(inner.to_owned()))))
    }

    fn number(self, text: &'a str) -> Step<'a, Expr> {
        let sign = opt(one_of("+-"));
        let power = opt((one_of("eE"), sign, digit1));
        let whole = recognize((digit1, opt(pair(char('.'), digit1))));
        let share = recognize((char('.'), digit1));
        let read: Step<'a, &str> = recognize((alt((whole, share)), power)).parse(text);
        let (rest, digits) = read?;
        let number = digits.parse().ok().filter(|n: &f64| n.is_finite());
        let number = number.ok_or(Err::Failure(Missed {
            rest: text,
            wanted: SMALLER,
        }))?;
        Ok(self.made(text, rest, Kind::Value(Value::Number(number))))
    }

    fn name(self, text: &'a str) -> Step<'a, Expr> {
        let (rest, name) = take_while(in_name).parse(text)?;
        let kind = match name {
            "true" | "yes" => Kind::Value(Value::Truth(true)),
            "false" | "no" => Kind::Value(Value::Truth(false)),
            "and" | "or" | "not" => {
                let (rest, wanted) = (text, OPERAND);
                return Err(Err::Failure(Missed { rest, wanted }));
            }
            _ => match blanks(rest).strip_prefix('(') {
                Some(arguments) => return self.call(text, name, arguments),
                None => Kind::Name(name.to_owned()),
            },
        };
        Ok(self.made(text, rest, kind))
    }

    fn call(self, text: &'a str, name: &str, arguments: &'a str) -> Step<'a, Expr> {
        let comma = preceded(take_while(is_blank), char(','));
        let argument = |text| self.either(text);
        let (rest, list) = match blanks(arguments).starts_with(')') {
            true => (arguments, vec![]),
            false => separated_list1(comma, cut(argument)).parse(arguments)?,
        };
        let rest = blanks(rest);
        let rest = rest
            .strip_prefix(')')
            .ok_or(Err::Failure(Missed { rest, wanted: NEXT }))?;
        Ok(self.made(text, rest, Kind::Call(name.to_owned(), list)))
    }

    /// Parses operands of one rank.
    fn chain(
        self,
        text: &'a str,
        operand: Rule<'a>,
        mut operator: impl Parser<&'a str, Output = Operator, Error = Missed<'a>>,
    ) -> Step<'a, Expr> {
        let (mut rest, first) = operand(self, text)?;
        let mut more = vec![];
        while let Ok((after, sign)) = operator.parse(blanks(rest)) {
            let (after, next) = operand(self, after)?;
            more.push((sign, next));
            rest = after;
        }
        Ok((rest, joined(first, more)))
    }

    fn made(self, text: &str, rest: &'a str, kind: Kind) -> (&'a str, Expr) {
        let range = self.at(text)..self.at(rest);
        (rest, Expr { range, kind })
    }

    fn at(self, rest: &str) -> usize {
        self.whole.len() - rest.len()
    }
}

fn joined(first: Expr, more: Vec<(Operator, Expr)>) -> Expr {
    let Some((_, last)) = more.last() else {
        return first;
    };
    Expr {
        range: first.range.start..last.range.end,
        kind: Kind::Chain(Box::new(first), more),
    }
}

/// Applies signs to an expression; two of a kind cancel each other, except for the type they require.
fn wrap(inner: Expr, starts: &[usize], kind: fn(Box<Expr>) -> Kind) -> Expr {
    let kept = match starts.len() {
        0 => 0,
        n => 2 - n % 2,
    };
    starts[..kept]
        .iter()
        .rev()
        .fold(inner, |inner, start| Expr {
            range: *start..inner.range.end,
            kind: kind(Box::new(inner)),
        })
}

/// Parses a word that no longer name begins with.
fn keyword<'a>(word: &'static str) -> impl Parser<&'a str, Output = &'a str, Error = Missed<'a>> {
    terminated(tag(word), not(satisfy(in_name)))
}

#[cfg(test)]
mod tests;
