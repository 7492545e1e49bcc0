//! Names of materials of triangles or spheres.

use crate::message;
use std::collections::HashMap;

use super::FileProblem;

/// The material of each triangle or sphere. Only names: what they mean is not in the files that are read here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MaterialSlots {
    /// The names in the order of their first use; `None` is the slot of all elements without a named material.
    pub names: Vec<Option<String>>,
    /// The slot of each element: an index into `names`.
    pub slots: Vec<u16>,
}

/// Collects slots while a file is read.
#[derive(Debug, Default)]
pub(super) struct SlotBook {
    names: Vec<Option<String>>,
    known: HashMap<Option<String>, u16>,
    slots: Vec<u16>,
    last: u16,
}

impl SlotBook {
    /// The slot of this name; a new one on first use.
    pub fn slot(&mut self, name: Option<&str>) -> Result<u16, FileProblem> {
        // Neighbours usually have the same material: then nothing is hashed or allocated.
        if self.names.get(usize::from(self.last)).is_some_and(|last| last.as_deref() == name) {
            return Ok(self.last);
        }
        let name = name.map(str::to_owned);
        let slot = if let Some(slot) = self.known.get(&name) {
            *slot
        } else {
            let slot = u16::try_from(self.names.len())
                .map_err(|_| FileProblem::TooMany { what: message!("materials"), most: u64::from(u16::MAX) + 1 })?;
            self.names.push(name.clone());
            self.known.insert(name, slot);
            slot
        };
        self.last = slot;
        Ok(slot)
    }

    /// Assigns this slot to the next element.
    pub fn push(&mut self, slot: u16) {
        self.slots.push(slot);
    }

    /// `None` if no element has a named material. Names without elements are dropped, since they are not needed.
    pub fn finish(self) -> Option<MaterialSlots> {
        let Self { names, mut slots, .. } = self;
        let mut is_used = vec![false; names.len()];
        for slot in &slots {
            is_used[usize::from(*slot)] = true;
        }
        // It can only wrap after the last of 65536.
        let mut count = 0_u16;
        let new_slots: Vec<u16> = is_used
            .iter()
            .map(|is_used| {
                let slot = count;
                count = count.wrapping_add(u16::from(*is_used));
                slot
            })
            .collect();
        for slot in &mut slots {
            *slot = new_slots[usize::from(*slot)];
        }
        let names: Vec<_> =
            names.into_iter().zip(is_used).filter_map(|(name, is_used)| is_used.then_some(name)).collect();
        names.iter().any(Option::is_some).then_some(MaterialSlots { names, slots })
    }
}
