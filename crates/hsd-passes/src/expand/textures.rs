//! `Texture`: the image of a code, and the share of light that a part reflects (003-13). Reflections show only on
//! facades with `reflection` (003-14).

use super::Pass;
use super::codes::Which;
use hsd_base::source::IncludeError;
use hsd_ir::ast::{self, Texture};
use hsd_ir::messages::parts as say;
use hsd_ir::messages::xml;
use hsd_ir::program::{Content, Storey, Unit};
use std::collections::{BTreeMap, BTreeSet};

impl Pass<'_, '_> {
    /// Assigns the images that a house names by their files.
    pub(super) fn given_pictures(&mut self, house: &ast::House) {
        for texture in &house.textures {
            let Some(src) = &texture.src else { continue };
            let ast::Picture { path, from } = src;
            match self.codes.world.image(from, &path.value) {
                Ok(file) => {
                    let id = self.codes.add_picture(&texture.code.value, file);
                    for range in self.list_pieces(&texture.code) {
                        let code = ast::CodeText::new(&texture.code.value[range]);
                        self.codes.give(&code, id);
                    }
                }
                Err(IncludeError::Outside) => {
                    self.once(272, path.span, || xml::src_outside(path.span, &path.value));
                }
                Err(IncludeError::Missing) => {
                    self.once(243, path.span, || xml::src_missing(path.span, &path.value));
                }
            }
        }
    }

    /// Applies the textures of a house.
    pub(super) fn textures(&mut self, house: &ast::House, storeys: &mut [Storey]) {
        if house.textures.is_empty() {
            return;
        }
        let mut used = BTreeSet::new();
        let loops = storeys.iter().flat_map(|s| &s.loops);
        for line in loops.flat_map(|l| &l.lines) {
            gather(&line.units, &mut used);
        }
        let mut shares = BTreeMap::new();
        for texture in &house.textures {
            self.texture(texture, &used, &mut shares);
        }
        let loops = storeys.iter_mut().flat_map(|s| &mut s.loops);
        for line in loops.flat_map(|l| &mut l.lines).filter(|l| l.reflection) {
            apply(&mut line.units, &shares);
        }
    }

    fn texture(
        &mut self,
        texture: &Texture,
        used: &BTreeSet<Which>,
        shares: &mut BTreeMap<Which, f32>,
    ) {
        let share = texture.reflection.as_ref();
        let share = share.map(|share| share.value.clamp(0.0, 1.0) as f32);
        let spelling = self.spelling(&texture.code);
        for range in self.list_pieces(&texture.code) {
            let code = &texture.code.value[range.clone()];
            let which = self.codes.known(&ast::CodeText::new(code)).map(|f| f.which);
            match which.filter(|which| used.contains(which)) {
                Some(which) => shares.extend(share.map(|share| (which, share))),
                None => {
                    let span = self.within(&texture.code, spelling, &range);
                    let near = self.nearest_used(code, used);
                    self.once(317, span, || say::idle_texture(span, code, &near));
                }
            }
        }
    }

    fn nearest_used(&self, code: &str, used: &BTreeSet<Which>) -> Vec<String> {
        let names = used.iter().take(200).map(|which| self.codes.name(*which));
        let ranked = names.map(|name| (distance(code.trim(), name.trim()), name));
        let mut near: Vec<_> = ranked.filter(|(d, _)| *d <= 2).collect();
        near.sort_unstable();
        near.into_iter().take(3).map(|n| n.1.to_owned()).collect()
    }
}

fn gather(units: &[Unit], used: &mut BTreeSet<Which>) {
    for unit in units {
        match &unit.content {
            Content::Split(split) => {
                gather(&split.upper, used);
                gather(&split.lower, used);
            }
            content => used.extend(Which::of(content)),
        }
    }
}

fn apply(units: &mut [Unit], shares: &BTreeMap<Which, f32>) {
    for unit in units {
        if let Content::Split(split) = &mut unit.content {
            apply(&mut split.upper, shares);
            apply(&mut split.lower, shares);
        } else {
            let share = Which::of(&unit.content).and_then(|which| shares.get(&which));
            unit.reflection = share.copied();
        }
    }
}

/// Returns the edit distance of two names, of which only the first 64 bytes count.
fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let (a, b) = (&a[..a.len().min(64)], &b[..b.len().min(64)]);
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut corner = std::mem::replace(&mut row[0], i + 1);
        for (j, y) in b.iter().enumerate() {
            let swapped = corner + usize::from(x != y);
            corner = row[j + 1];
            row[j + 1] = swapped.min(corner + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
