//! A value for each pixel of a sheet.

use crate::plan::raster::Parts;
use std::ops::{Index, IndexMut};

/// Values by rows.
#[derive(Clone, Debug)]
pub struct Field<T> {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    values: Vec<T>,
}

impl<T: Copy> Field<T> {
    /// Fills a field.
    pub fn new(width: usize, height: usize, mut value: impl FnMut(usize, usize) -> T) -> Field<T> {
        let mut values = Vec::with_capacity(width * height);
        for y in 0..height {
            values.extend((0..width).map(|x| value(x, y)));
        }
        Field {
            width,
            height,
            values,
        }
    }

    /// Returns a field with a value made of each.
    pub fn map<U: Copy>(&self, value: impl Fn(T) -> U) -> Field<U> {
        Field {
            width: self.width,
            height: self.height,
            values: self.values.iter().map(|v| value(*v)).collect(),
        }
    }

    /// Yields the places by rows.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> + use<T> {
        let (width, height) = (self.width, self.height);
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    /// Yields the values by rows.
    pub fn iter(&self) -> impl Iterator<Item = T> {
        self.values.iter().copied()
    }

    /// Returns the value at a place, or nothing beyond the edges.
    pub fn get(&self, x: isize, y: isize) -> Option<T> {
        let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
        (x < self.width && y < self.height).then(|| self[(x, y)])
    }

    /// Returns the places beside a place, of the four directions.
    pub fn beside(&self, (x, y): (usize, usize)) -> impl Iterator<Item = (usize, usize)> + use<T> {
        let (width, height) = (self.width, self.height);
        let steps = [(1, 0), (0, 1), (usize::MAX, 0), (0, usize::MAX)];
        let places = steps
            .into_iter()
            .map(move |(dx, dy)| (x.wrapping_add(dx), y.wrapping_add(dy)));
        places.filter(move |(x, y)| *x < width && *y < height)
    }
}

impl<T: Copy + Default> Field<T> {
    /// Returns the values in a box: x, y, width and height. Beyond the edges they are the default.
    pub(super) fn within(&self, [x, y, width, height]: [isize; 4]) -> Field<T> {
        Field::new(width as usize, height as usize, |across, down| {
            let value = self.get(x + across as isize, y + down as isize);
            value.unwrap_or_default()
        })
    }
}

impl Field<bool> {
    /// Returns the bounding box of the pixels that are true, widened by a margin: x, y, width and height. It may reach beyond the edges.
    pub(super) fn window(&self, margin: isize) -> [isize; 4] {
        let (mut low, mut high) = ([self.width, self.height], [0, 0]);
        for (x, y) in self.places().filter(|p| self[*p]) {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x + 1), high[1].max(y + 1)];
        }
        let size = |axis: usize| high[axis].saturating_sub(low[axis]) as isize + 2 * margin;
        let [x, y] = low.map(|k| k as isize - margin);
        [x, y, size(0), size(1)]
    }

    /// Finds the connected parts of the pixels that are true. Pixels that meet at a corner are connected if `diagonal`.
    pub(in crate::plan) fn parts(&self, diagonal: bool) -> Parts {
        let size = (self.width as u32, self.height as u32);
        Parts::of_set(size, |x, y| self[(x as usize, y as usize)], diagonal)
    }
}

impl Field<u32> {
    /// Returns the pixels beside another value.
    pub fn rims(&self) -> Field<bool> {
        Field::new(self.width, self.height, |x, y| {
            self.beside((x, y)).any(|p| self[p] != self[(x, y)])
        })
    }
}

impl<T> Index<(usize, usize)> for Field<T> {
    type Output = T;

    fn index(&self, (x, y): (usize, usize)) -> &T {
        &self.values[y * self.width + x]
    }
}

impl<T> IndexMut<(usize, usize)> for Field<T> {
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        &mut self.values[y * self.width + x]
    }
}
