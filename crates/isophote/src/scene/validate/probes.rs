//! Validates probes.

use super::names::{Kind, Names};
use super::{Checked, Validator};
use crate::scene::Probe;
use crate::scene::document::Path;
use crate::scene::limits;
use crate::scene::source::{ProbeSource, SceneSource};

impl Validator<'_> {
    pub(super) fn probes(&mut self, source: &SceneSource) -> Checked<Probe> {
        if !self.few_enough("probe", source.probe.len(), limits::PROBES) {
            return Vec::new();
        }
        let mut names = Names::new(Kind::Probe);
        let check = |(index, probe): (usize, &ProbeSource)| {
            let path = Path::root().key("probe").index(index);
            let name = names.check(self, &path, probe.name.as_deref());
            let at = self.required_point(&path, "at", probe.at);
            Some(Probe { name: name?, at: at?, published: probe.published })
        };
        source.probe.iter().enumerate().map(check).collect()
    }
}
