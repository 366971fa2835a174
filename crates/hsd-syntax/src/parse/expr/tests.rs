//! Expressions: ranks, errors, and harmless oddities.

use super::*;

fn value_of(text: &str) -> Value {
    let expr = parse(text).unwrap_or_else(|f| panic!("{text}: {f:?}"));
    let names = |name: &str| match name {
        "depth" => Ok(Value::Number(8.0)),
        "間口" => Ok(Value::Number(5.0)),
        name => Err(Problem::Unknown(name.to_owned())),
    };
    evaluate(&expr, &names).unwrap_or_else(|t| panic!("{text}: {t:?}"))
}

#[test]
fn ranks_and_functions() {
    let cases = [
        ("1 + 2 * 3 - 4 / 2", 5.0),
        ("(1+2)*3 % 4", 1.0),
        ("-2 - -3", 1.0),
        ("- - 2", 2.0),
        ("-7 % 3", 2.0),
        ("depth / 2 + 間口", 9.0),
        ("min(3, 1, 2) + max(1)", 2.0),
        ("clamp(9, 1, 4) + floor(-0.5) + ceil(0.5)", 4.0),
        ("sin(90) * 2 + cos(180) + tan(180)", 1.0),
        ("atan2(1, 0) + sqrt(16) + sin(360)", 94.0),
        ("round(0.5)", 1.0), // halves away from 0, both ways
        ("round(2.5)", 3.0),
        ("round(-2.5)", -3.0),
        ("round(2.4) + round(-2.6) + abs(-1)", 0.0),
        (".5e1", 5.0),
    ];
    for (text, wanted) in cases {
        assert_eq!(value_of(text), Value::Number(wanted), "{text}");
    }
    let truths = [
        ("1 < 2 and not 2 <= 1 or no", true),
        ("not not (1 = 1)", true),
        ("'a' != \"b\" and yes == true", true),
        ("depth >= 9 or depth > 8", false),
        ("depth = 0 or 8 / depth = 1", true),
        ("yes or 1 / 0 = 1", true), // what cannot matter is not worked out
    ];
    for (text, wanted) in truths {
        assert_eq!(value_of(text), Value::Truth(wanted), "{text}");
    }
    assert_eq!(value_of("'GDE ' + '2'"), Value::Text("GDE 2".into()));
}

#[test]
fn faults_name_their_place() {
    let cases = [
        ("a +", 3..3, OPERAND),
        ("", 0..0, OPERAND),
        ("1 2", 2..3, OPERATOR),
        ("(1 + 2", 6..6, CLOSING),
        ("min(1, )", 7..8, OPERAND),
        ("1 < 2 < 3", 6..7, AND),
        ("'open", 0..1, QUOTE),
        ("1e400", 0..5, SMALLER),
        ("a ＋ b", 2..5, OPERATOR),
        ("3 shaku", 2..7, OPERATOR),
    ];
    for (text, range, wanted) in cases {
        assert_eq!(parse(text), Err(Fault { range, wanted }), "{text}");
    }
}

#[test]
fn long_and_deep_expressions_do_no_harm() {
    for text in ["-".repeat(100_000), "not ".repeat(50_000)] {
        assert!(parse(&(text + "1")).is_ok());
    }
    let sum = "1+".repeat(100_000) + "1";
    assert_eq!(value_of(&sum), Value::Number(100_001.0));
    let deep = "(".repeat(64) + "1" + &")".repeat(64);
    assert_eq!(value_of(&deep), Value::Number(1.0));
    assert!(parse(&("(".repeat(100_000) + "1")).is_err());
}

#[test]
fn troubles_name_the_operand() {
    let trouble = |text: &str| {
        let expr = parse(text).expect("is an expression");
        let found = evaluate(&expr, &|n: &str| Err(Problem::Unknown(n.to_owned())));
        let trouble = found.expect_err("is in trouble");
        text[trouble.range].to_owned()
    };
    assert_eq!(trouble("1 + (2 * (x))"), "(x)");
    assert_eq!(trouble("1 + 'a'"), "'a'");
    assert_eq!(trouble("4 / (1 - 1)"), "(1 - 1)");
    assert_eq!(trouble("1 and yes"), "1");
    assert_eq!(trouble("1 < 'a'"), "'a'");
    assert_eq!(trouble("1 + clamp(1, 2)"), "clamp(1, 2)");
    assert_eq!(trouble("1e300 * 1e300"), "1e300 * 1e300");
    assert_eq!(trouble("log(2)"), "log(2)");
    assert_eq!(trouble("1 + sqrt(0 - 2)"), "sqrt(0 - 2)");
    assert_eq!(trouble("tan(90) + 1"), "tan(90)");
}
