//! The brightness of what a ray hits.

use std::cell::OnceCell;

use super::{Blocking, Hit, PreparedScene};
use crate::camera::{ScreenPosition, Sight};
use crate::double_double::DoubleDouble;
use crate::shade::{LightTerm, Shading, shade};
use crate::shape::{Located, Primitive, SurfacePoint};

impl PreparedScene {
    /// The brightness of a hit by the scene's convention, summed over the lights; `each` is called with every light's own
    /// term. `seen_at` is the screen position at which the hit was found: at a shadow edge it is traced again with 32
    /// digits. A hit made from a given point has none, and is taken as exact.
    pub fn shade(&self, hit: &Hit, seen_at: Option<ScreenPosition>, each: impl FnMut(usize, &LightTerm)) -> Shading {
        let (ambient, visibility) = (self.ambient_irradiance(hit).irradiance, self.visibility(hit, seen_at));
        shade(&hit.point, self.emitters.all(), self.formula(hit.primitive), ambient, visibility, each)
    }

    /// v of each emitter at a hit, computed on demand.
    pub(crate) fn visibility<'h>(
        &'h self,
        hit: &'h Hit,
        seen_at: Option<ScreenPosition>,
    ) -> impl Fn(usize) -> f64 + 'h {
        let precise = OnceCell::new();
        let find_again = move || seen_at.and_then(|position| self.trace_precisely(position));
        move |emitter| {
            let Blocking { blocker, is_doubtful } = self.blocking(hit, emitter);
            let blocker = if is_doubtful {
                let precise = precise.get_or_init(|| find_again().unwrap_or_else(|| hit.exactly()));
                self.blocking(precise, emitter).blocker
            } else {
                blocker
            };
            if blocker.is_some() { 0.0 } else { 1.0 }
        }
    }

    /// The same shading for a hit with 32 digits.
    pub fn shade_precisely(
        &self,
        hit: &Hit<DoubleDouble>,
        each: impl FnMut(usize, &LightTerm<DoubleDouble>),
    ) -> Shading<DoubleDouble> {
        let visibility = |emitter| {
            let is_blocked = self.blocking(hit, emitter).blocker.is_some();
            DoubleDouble::from_f64(if is_blocked { 0.0 } else { 1.0 })
        };
        // The directions are sampled, so a double is accurate enough.
        let ambient = DoubleDouble::from_f64(self.ambient_irradiance(&hit.rounded()).irradiance);
        shade(&hit.point, self.emitters.all(), self.formula(hit.primitive), ambient, visibility, each)
    }

    /// A point of a surface as the eye sees it, even where the eye cannot see it: cosθ_o is then negative. The eye sees a
    /// closed shape's outside, unless it is inside; of any other shape it sees the side that faces it.
    #[must_use]
    pub fn surface_point(&self, located: &Located) -> Hit {
        let nearest = &located.nearest;
        let geometry = &self.shapes[located.shape].geometry;
        let Sight { start, view, distance } = self.frame.sight(nearest.anchor, nearest.offset);
        let from_inside = geometry.part_encloses(nearest.part, start);
        let from_behind = !geometry.is_closed() && nearest.face_normal.dot(view) < 0.0;
        let normal = if from_inside || from_behind { -nearest.outward_normal } else { nearest.outward_normal };
        let shadow_ray_offset = if from_behind { nearest.shadow_ray_offset_behind } else { nearest.shadow_ray_offset };
        let point = SurfacePoint {
            anchor: nearest.anchor,
            offset: nearest.offset,
            normal,
            view,
            cos_theta_o: normal.dot(view),
        };
        let primitive = Primitive { shape: located.shape, part: nearest.part };
        let hit = Hit { primitive, distance, point, from_inside, shadow_ray_offset };
        Hit { shadow_ray_offset: self.clear_shadow_ray_offset(&hit).0, ..hit }
    }
}
