//! Evaluates expressions. `and` and `or` skip operands that can no longer matter, so that a test may guard a division.

use super::{Expr, Kind, Operator};
use hsd_base::diagnostic::{Noun, noun};
use hsd_base::geometry::Heading;
use hsd_ir::ast::Value;
use std::ops::Range;

/// The maximum length of a string: longer ones are no codes or names, and without a bound a few lines could exhaust
/// memory.
const LONGEST: usize = 4096;

/// The reason why an expression has no value, and the part of it that causes it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::parse) struct Trouble {
    pub(in crate::parse) range: Range<usize>,
    pub(in crate::parse) problem: Problem,
}

#[derive(Clone, Debug, PartialEq)]
pub(in crate::parse) enum Problem {
    /// An undefined name.
    Unknown(String),
    /// An unknown function.
    NoFunction(String),
    /// `k` outside a storey.
    NoStorey,
    /// An operand of a type that its operator does not accept.
    Mismatch { wanted: Noun, found: Value },
    /// A function has too many or too few arguments.
    Arguments {
        function: String,
        wanted: Noun,
        found: usize,
    },
    /// A division by 0.
    Division,
    /// `clamp` with its bounds in the wrong order.
    Bounds,
    /// A function that has no value here.
    NoValue,
    /// A result out of range.
    Overflow,
    /// A string that is too long.
    TooLong,
    /// The name's own value could not be computed, which was reported.
    Reported,
    /// A field that this feature of a map does not have.
    Missing(String),
    /// A word that a table does not have: the number of the argument, the word, and those that there are.
    Unfound(usize, String, Vec<String>),
}

/// What the names of an expression mean.
pub(in crate::parse) trait Meanings {
    /// Returns the value of a name.
    fn value(&self, name: &str) -> Result<Value, Problem>;

    /// Calls a function that only some places know; `None` if this one does not.
    fn call(&self, _function: &str, _arguments: &[Value]) -> Option<Result<Value, Problem>> {
        None
    }
}

impl<F: Fn(&str) -> Result<Value, Problem>> Meanings for F {
    fn value(&self, name: &str) -> Result<Value, Problem> {
        self(name)
    }
}

/// The names of an expression.
pub(in crate::parse) type Names<'n> = &'n dyn Meanings;

const NUMBER: Noun = noun("a number", "数値");
const TEXT: Noun = noun("a text", "文字列");
const TRUTH: Noun = noun("a truth such as `depth > 8`", "`depth > 8` のような真偽値");

fn kind(value: &Value) -> Noun {
    match value {
        Value::Number(_) => NUMBER,
        Value::Text(_) => TEXT,
        Value::Truth(_) => TRUTH,
    }
}

type Outcome = Result<Value, Trouble>;

/// Returns the value of an expression.
pub(in crate::parse) fn evaluate(expr: &Expr, names: Names<'_>) -> Outcome {
    let trouble = |problem| {
        let range = expr.range.clone();
        Trouble { range, problem }
    };
    match &expr.kind {
        Kind::Value(value) => Ok(value.clone()),
        Kind::Name(name) => names.value(name).map_err(trouble),
        Kind::Negative(inner) => Ok(Value::Number(-number(inner, names)?)),
        Kind::Not(inner) => Ok(Value::Truth(!truth(inner, names)?)),
        Kind::Call(function, list) if function == IF => choice(expr, list, names),
        Kind::Call(function, list) => {
            let mut numbers = vec![];
            if TOWN_FUNCTIONS.contains(&&**function) {
                let values: Result<Vec<Value>, Trouble> = list
                    .iter()
                    .map(|argument| evaluate(argument, names))
                    .collect();
                if let Some(found) = names.call(function, &values?) {
                    return found.map_err(trouble);
                }
            }
            if !FUNCTIONS.contains(&&**function) {
                return Err(trouble(Problem::NoFunction(function.clone())));
            }
            for argument in list {
                numbers.push(number(argument, names)?);
            }
            call(function, &numbers).map_err(trouble)
        }
        Kind::Chain(first, more) => chain(first, more, names),
    }
}

/// Evaluates `if(test, a, b)`: only the case that counts.
fn choice(expr: &Expr, list: &[Expr], names: Names<'_>) -> Outcome {
    let [test, then, otherwise] = list else {
        let problem = Problem::Arguments {
            function: IF.to_owned(),
            wanted: noun("a test and two values", "条件と二つの値"),
            found: list.len(),
        };
        let range = expr.range.clone();
        return Err(Trouble { range, problem });
    };
    match truth(test, names)? {
        true => evaluate(then, names),
        false => evaluate(otherwise, names),
    }
}

fn chain(first: &Expr, more: &[(Operator, Expr)], names: Names<'_>) -> Outcome {
    if let Some((logic @ (Operator::And | Operator::Or), _)) = more.first() {
        let deciding = *logic == Operator::Or;
        for operand in std::iter::once(first).chain(more.iter().map(|m| &m.1)) {
            if truth(operand, names)? == deciding {
                return Ok(Value::Truth(deciding));
            }
        }
        return Ok(Value::Truth(!deciding));
    }
    let mut left = evaluate(first, names)?;
    let mut range = first.range.clone();
    for (operator, operand) in more {
        let right = evaluate(operand, names)?;
        let whole = range.start..operand.range.end;
        let sides = [(&left, range), (&right, operand.range.clone())];
        left = apply(*operator, sides, whole.clone())?;
        range = whole;
    }
    Ok(left)
}

fn apply(
    operator: Operator,
    [(left, left_range), (right, right_range)]: [(&Value, Range<usize>); 2],
    whole: Range<usize>,
) -> Outcome {
    use Operator::{Divided, Equal, Greater, GreaterOrEqual, Less, LessOrEqual};
    use Operator::{Minus, Plus, Remainder, Times, Unequal};
    let mismatch = |wanted, found: &Value, range| {
        let found = found.clone();
        let problem = Problem::Mismatch { wanted, found };
        Err(Trouble { range, problem })
    };
    let at = |range: Range<usize>, problem| Err(Trouble { range, problem });
    match (operator, left, right) {
        (Equal | Unequal, l, r) if l.is_like(r) => {
            Ok(Value::Truth((l == r) == (operator == Equal)))
        }
        (Equal | Unequal, l, r) => mismatch(kind(l), r, right_range),
        (Plus, Value::Text(l), Value::Text(r)) if l.len() + r.len() > LONGEST => {
            at(whole, Problem::TooLong)
        }
        (Plus, Value::Text(l), Value::Text(r)) => Ok(Value::Text(format!("{l}{r}"))),
        (Plus, Value::Text(_), r) => mismatch(TEXT, r, right_range),
        (_, Value::Number(l), Value::Number(r)) => {
            let (l, r) = (*l, *r);
            let number = match operator {
                Less => return Ok(Value::Truth(l < r)),
                LessOrEqual => return Ok(Value::Truth(l <= r)),
                Greater => return Ok(Value::Truth(l > r)),
                GreaterOrEqual => return Ok(Value::Truth(l >= r)),
                Divided | Remainder if r == 0.0 => return at(right_range, Problem::Division),
                Plus => l + r,
                Minus => l - r,
                Times => l * r,
                Divided => l / r,
                // The sign of the divisor, so that positions wrap round from below 0 too.
                _ => l - r * (l / r).floor(),
            };
            finite(number).or_else(|problem| at(whole, problem))
        }
        (_, Value::Number(_), r) => mismatch(NUMBER, r, right_range),
        (_, l, _) => mismatch(NUMBER, l, left_range),
    }
}

fn finite(number: f64) -> Result<Value, Problem> {
    let finite = number.is_finite().then_some(Value::Number(number));
    finite.ok_or(Problem::Overflow)
}

fn number(expr: &Expr, names: Names<'_>) -> Result<f64, Trouble> {
    match evaluate(expr, names)? {
        Value::Number(number) => Ok(number),
        found => Err(mismatch(NUMBER, found, expr)),
    }
}

fn truth(expr: &Expr, names: Names<'_>) -> Result<bool, Trouble> {
    match evaluate(expr, names)? {
        Value::Truth(truth) => Ok(truth),
        found => Err(mismatch(TRUTH, found, expr)),
    }
}

fn mismatch(wanted: Noun, found: Value, expr: &Expr) -> Trouble {
    Trouble {
        range: expr.range.clone(),
        problem: Problem::Mismatch { wanted, found },
    }
}

/// Names of the functions.
pub(in crate::parse) const FUNCTIONS: [&str; 13] = [
    "min", "max", "floor", "ceil", "round", "abs", "clamp", "sin", "cos", "tan", "atan2", "sqrt",
    IF,
];

/// The function that chooses between two values, of any type.
const IF: &str = "if";

/// Names of the functions that only the content of a `for` knows.
pub(in crate::parse) const TOWN_FUNCTIONS: [&str; 3] = ["draw", "look", "randloc"];

/// The name of the number that every file knows; another meaning given to it comes first.
pub(in crate::parse) const PI: &str = "pi";

fn call(function: &str, numbers: &[f64]) -> Result<Value, Problem> {
    let count = |wanted| Problem::Arguments {
        function: function.to_owned(),
        wanted,
        found: numbers.len(),
    };
    let result = match (function, numbers) {
        ("min" | "max", [first, rest @ ..]) => {
            let pick = if function == "min" {
                f64::min
            } else {
                f64::max
            };
            rest.iter().copied().fold(*first, pick)
        }
        ("min" | "max", []) => return Err(count(noun("one number at least", "1 個以上の数値"))),
        ("floor", [n]) => n.floor(),
        ("ceil", [n]) => n.ceil(),
        ("round", [n]) => n.round(), // halves away from 0
        ("abs", [n]) => n.abs(),
        // Of degrees, and exact for right angles.
        ("sin", [n]) => Heading::new(*n).vector().y,
        ("cos", [n]) => Heading::new(*n).vector().x,
        ("tan", [n]) => match Heading::new(*n).vector() {
            way if way.x == 0.0 => return Err(Problem::NoValue),
            way => way.y / way.x,
        },
        ("atan2", [y, x]) => libm::atan2(*y, *x).to_degrees(),
        ("atan2", _) => return Err(count(noun("two numbers: y, x", "2 個の数値（y、x）"))),
        ("sqrt", [n]) if *n < 0.0 => return Err(Problem::NoValue),
        ("sqrt", [n]) => n.sqrt(),
        ("clamp", [_, least, most]) if least > most => return Err(Problem::Bounds),
        ("clamp", [n, least, most]) => n.clamp(*least, *most),
        ("clamp", _) => {
            return Err(count(noun(
                "three numbers: value, least, most",
                "3 個の数値（値、下限、上限）",
            )));
        }
        _ => return Err(count(noun("one number", "1 個の数値"))),
    };
    finite(result)
}
