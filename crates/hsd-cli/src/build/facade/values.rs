//! Values of the options of `hsd facade`.

use glam::{DVec2, dvec2};

/// Places of lines, ascending, metres.
#[derive(Clone, Debug)]
pub(super) struct Lines(pub(super) Vec<f64>);

fn numbers(text: &str) -> Option<Vec<f64>> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    numbers.filter(|n| n.iter().all(|n| n.is_finite()))
}

/// Width and height in metres.
pub(super) fn size(text: &str) -> Result<DVec2, String> {
    match numbers(text).as_deref() {
        Some([width, height])
            if (0.01..=1000.0).contains(width) && (0.01..=1000.0).contains(height) =>
        {
            Ok(dvec2(*width, *height))
        }
        _ => Err("expected width and height of the wall in metres, as in 12.6,9.3".to_owned()),
    }
}

/// How a lens bends lines.
pub(super) fn lens(text: &str) -> Result<[f64; 2], String> {
    match numbers(text).as_deref() {
        Some([k1, k2]) if k1.abs() <= 2.0 && k2.abs() <= 5.0 => Ok([*k1, *k2]),
        _ => Err("expected two numbers, as in -0.155,0.047".to_owned()),
    }
}

/// A focal length in pixels.
pub(super) fn focal(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(focal) if (50.0..=200_000.0).contains(&focal) => Ok(focal),
        _ => Err("expected the focal length in pixels, from 50 to 200000".to_owned()),
    }
}

/// Numbers of bays and storeys.
pub(super) fn grid(text: &str) -> Result<(usize, usize), String> {
    let pair = text.split_once(['x', 'X', '×']);
    match pair.map(|(bays, storeys)| {
        (
            bays.trim().parse::<usize>(),
            storeys.trim().parse::<usize>(),
        )
    }) {
        Some((Ok(bays), Ok(storeys)))
            if (1..=100).contains(&bays) && (1..=100).contains(&storeys) =>
        {
            Ok((bays, storeys))
        }
        _ => Err("expected the numbers of bays and storeys, as in 7x3".to_owned()),
    }
}

/// Lines in metres.
pub(super) fn lines(text: &str) -> Result<Lines, String> {
    let ascending = |n: &Vec<f64>| n.windows(2).all(|n| n[0] < n[1]) && n.iter().all(|n| *n > 0.0);
    match numbers(text).filter(ascending) {
        Some(lines) => Ok(Lines(lines)),
        None => Err("expected ascending metres, as in 1.8,3.6,5.4".to_owned()),
    }
}

/// The name of a front.
pub(super) fn name(text: &str) -> Result<String, String> {
    match !text.is_empty()
        && text
            .chars()
            .all(|c| c.is_alphanumeric() || c == '-' || c == '_')
    {
        true => Ok(text.to_owned()),
        false => Err("expected a name of letters, digits, - and _".to_owned()),
    }
}

/// A number of further pictures.
pub(super) fn variations(text: &str) -> Result<usize, String> {
    let number = text.trim().parse().ok().filter(|n| (0..=50).contains(n));
    number.ok_or_else(|| "expected a number from 0 to 50".to_owned())
}
