//! The brightness of a group of pixels.

use super::Tiles;
use super::group::{Group, MOST};
use super::shadow::Shadows;
use crate::lanes::{Element, Instructions, Lane, LaneJob, Precision, SimdToken};
use crate::light::{Ambient, PlacedLight};
use crate::map::Pixel;
use crate::outline::PlaceInRow;
use crate::prepare::PreparedScene;
use crate::reflectance::{BrightnessFormula, Lobe};
use crate::render::RenderError;
use crate::render::band::{Band, BandChannel, ScalarChannel};
use crate::render::lanes::lights::{BLOCK, fits_single};
use crate::render::lanes::power::{NoPower, Power};
use crate::shade::light_term;
use crate::shape::{Sphere, SurfacePoint};
use crate::sum::Sum;
use crate::vector::Vector;

/// Shades groups, one after the other.
pub struct Shader<'a> {
    scene: &'a PreparedScene,
    order: &'a [usize],
    precision: Precision,
    instructions: Instructions,
    places: Box<Places>,
    shadows: Box<Shadows>,
    lights: Vec<PlacedLight>,
    /// E_a (3.9), which nothing obstructs in the scenes that are drawn so.
    ambient: f64,
    /// The lights that are above the horizon of a pixel, by their index among `lights`.
    chosen: Vec<usize>,
    /// v_j of the pixels for each of those.
    visible: Vec<f64>,
    /// Lanes that are in doubt, by eights.
    doubtful: [u32; MOST / 8],
}

/// What the pixels of a group see, as far as the lights do not matter. The last pixel fills up the last vector.
pub struct Places {
    /// How many pixels there are.
    pub count: usize,
    /// What they see.
    pub sphere: Sphere,
    /// Of each pixel, its index in the band.
    index: [usize; MOST],
    /// Columns and rows, counted as the outline does.
    column: [f64; MOST],
    row: [f64; MOST],
    after_first: [f64; MOST],
    after_last: [f64; MOST],
    /// N: the point, in radii from the centre.
    normal: [[f64; MOST]; 3],
    /// t in radii.
    distance: [f64; MOST],
}

impl Places {
    fn new() -> Self {
        let zeros = [0.0; MOST];
        Self {
            count: 0,
            sphere: Sphere { center: Vector::default(), radius: 1.0 },
            index: [0; MOST],
            column: zeros,
            row: zeros,
            after_first: zeros,
            after_last: zeros,
            normal: [zeros; 3],
            distance: zeros,
        }
    }

    /// Counts the pixels of a group as its outline does.
    fn prepare(&mut self, group: &Group<'_>, sphere: Sphere, band: &Band<'_>) {
        let ellipse = &group.seen.ellipse;
        self.sphere = sphere;
        self.count = group.pixels.len();
        let end = self.count.next_multiple_of(16);
        let mut pixel = Pixel { column: 0, row: 0 };
        for at in 0..end {
            if let Some(cell) = group.pixels.get(at) {
                pixel = cell.within(group.tile);
            }
            self.index[at] = band.index(pixel);
            self.column[at] = f64::from(pixel.column) - ellipse.column;
            self.row[at] = f64::from(pixel.row) - ellipse.row;
        }
    }

    /// Finds what they see.
    #[inline(always)]
    fn find<D: Lane<Element = f64>>(&mut self, token: D::Token, group: &Group<'_>) {
        let end = self.count.next_multiple_of(16);
        let outline = group.seen.ellipse.map(
            #[inline(always)]
            |number| D::splat(token, number),
        );
        for at in (0..end).step_by(D::COUNT) {
            let column = D::load(token, &self.column[at..]);
            let row = outline.row_at(D::load(token, &self.row[at..]));
            let place = PlaceInRow { column, after_first: column - row.roots[0], after_last: column - row.roots[1] };
            place.after_first.store(&mut self.after_first[at..]);
            place.after_last.store(&mut self.after_last[at..]);
            let seen = row.point(self.sphere.center, &place);
            seen.point.normal.x.store(&mut self.normal[0][at..]);
            seen.point.normal.y.store(&mut self.normal[1][at..]);
            seen.point.normal.z.store(&mut self.normal[2][at..]);
            seen.distance.store(&mut self.distance[at..]);
        }
    }

    /// N of a vector of pixels.
    #[inline(always)]
    pub fn normal_at<D: Lane<Element = f64>>(&self, token: D::Token, vector: usize) -> Vector<D> {
        let at = vector * D::COUNT;
        let [x, y, z] = &self.normal;
        Vector::new(D::load(token, &x[at..]), D::load(token, &y[at..]), D::load(token, &z[at..]))
    }
}

/// Finds out what the pixels of a group see, and which lights.
struct See<'s, 'a, 'g> {
    shader: &'s mut Shader<'a>,
    group: &'s mut Group<'g>,
}

impl LaneJob for See<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn run<S, D>(self, token: S::Token)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        token.in_own_function(
            #[inline(always)]
            || self.shader.places.find::<D::Narrow>(token, self.group),
        );
        self.shader.see_lights::<S::Narrow, D::Narrow>(token, self.group);
    }
}

/// Shades the pixels of a group.
struct Shade<'s, 'a, 'g, 'm> {
    shader: &'s Shader<'a>,
    group: &'s Group<'g>,
    formula: &'s BrightnessFormula,
    band: &'s mut Band<'m>,
}

struct ShadeInSingle<'s, 'a, 'g, 'm>(Shade<'s, 'a, 'g, 'm>);

struct ShadeInDouble<'s, 'a, 'g, 'm>(Shade<'s, 'a, 'g, 'm>);

impl LaneJob for ShadeInSingle<'_, '_, '_, '_> {
    type Output = Result<(), RenderError>;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Shade { shader, group, formula, band } = self.0;
        shader.shade_in::<S::Narrow>(token, group, formula, band)
    }
}

impl LaneJob for ShadeInDouble<'_, '_, '_, '_> {
    type Output = Result<(), RenderError>;

    #[inline(always)]
    fn run<S, D>(self, token: S::Token) -> Self::Output
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Shade { shader, group, formula, band } = self.0;
        shader.shade_in::<D::Narrow>(token, group, formula, band)
    }
}

/// With more lights fewer pixels are shaded together, for what is remembered of each light at each pixel.
const MANY_LIGHTS: usize = 1024;

impl<'a> Shader<'a> {
    /// For the lights of a scene in an order.
    pub fn new(tiles: &Tiles<'a>) -> Self {
        let Tiles { scene, order, precision, instructions, .. } = *tiles;
        Self {
            scene,
            order,
            precision,
            instructions,
            places: Box::new(Places::new()),
            shadows: Box::new(Shadows::NEW),
            lights: Vec::new(),
            ambient: scene.scene().ambient().map_or(0.0, Ambient::unobstructed_irradiance),
            chosen: Vec::new(),
            visible: Vec::new(),
            doubtful: [0; MOST / 8],
        }
    }

    /// Shades the pixels of a group; those whose shadow is in doubt go into a list besides.
    pub fn shade(
        &mut self,
        group: &mut Group<'_>,
        band: &mut Band<'_>,
        doubtful: &mut Vec<Pixel>,
    ) -> Result<(), RenderError> {
        let instructions = self.instructions;
        let Some(sphere) = self.scene.sphere(group.primitive).copied() else { return Ok(()) };
        self.place_lights(&sphere);
        let most = if self.order.len() > MANY_LIGHTS { 16 } else { MOST };
        let pixels = group.pixels;
        for pixels in pixels.chunks(most) {
            group.pixels = pixels;
            self.places.prepare(group, sphere, band);
            instructions.run(See { shader: &mut *self, group: &mut *group });
            for (vector, lanes) in self.doubtful[..pixels.len().div_ceil(8)].iter().enumerate() {
                let cells = pixels[vector * 8..].iter().take(8).enumerate();
                let in_doubt = cells.filter(|(lane, _)| lanes >> lane & 1 == 1);
                doubtful.extend(in_doubt.map(|(_, cell)| cell.within(group.tile)));
            }
            let formula = self.scene.formula(group.primitive);
            let fits = group.seen.ellipse.fits_single() && fits_single(&self.lights, self.ambient, formula.sharpness());
            let shader = &*self;
            if self.precision == Precision::Single && fits {
                instructions.run(ShadeInSingle(Shade { shader, group, formula, band }))?;
            } else {
                instructions.run(ShadeInDouble(Shade { shader, group, formula, band }))?;
            }
            self.store_geometry(band);
        }
        Ok(())
    }

    /// Lengths in radii from the centre: irradiances then come out right when intensities are divided by R².
    #[inline(always)]
    fn place_lights(&mut self, sphere: &Sphere) {
        let Sphere { center, radius } = *sphere;
        let (per_radius, per_squared) = (1.0 / radius, 1.0 / (radius * radius));
        self.lights.clear();
        self.lights.extend(self.order.iter().map(|index| {
            let light = self.scene.scene().lights()[*index].seen_from::<f64>(center);
            PlacedLight { position: light.position * per_radius, intensity: light.intensity * per_squared, ..light }
        }));
    }

    /// Finds out which lights the pixels see.
    #[inline(always)]
    fn see_lights<S, D>(&mut self, token: S::Token, group: &mut Group<'_>)
    where
        S: Lane<Element = f32>,
        D: Lane<Element = f64, Token = S::Token>,
    {
        let Self { scene, order, places, shadows, lights, chosen, visible, doubtful, .. } = self;
        let stride = places.count.next_multiple_of(16);
        let vectors = places.count.div_ceil(D::COUNT);
        doubtful[..vectors].fill(0);
        chosen.clear();
        visible.resize(visible.len().max(stride * lights.len()), 1.0);
        for (index, light) in lights.iter().enumerate().filter(|(_, light)| light.intensity > 0.0) {
            let visible = &mut visible[chosen.len() * stride..][..stride];
            if !scene.scene().casts_shadows(group.primitive.shape, order[index]) {
                visible.fill(1.0);
            } else if !shadows.find::<S, D>(token, scene, group, places, light.position, visible) {
                continue;
            } else {
                for (vector, doubtful) in doubtful[..vectors].iter_mut().enumerate() {
                    *doubtful |= shadows.doubtful(vector);
                }
            }
            chosen.push(index);
        }
    }

    #[inline(always)]
    fn shade_in<V: Lane>(
        &self,
        token: V::Token,
        group: &Group<'_>,
        formula: &BrightnessFormula,
        band: &mut Band<'_>,
    ) -> Result<(), RenderError> {
        match Power::new(formula.sharpness(), V::Element::PRECISION) {
            Power::None => self.shade_with::<V, _>(token, group, formula, &NoPower, band),
            Power::Even(lobe) => self.shade_with::<V, _>(token, group, formula, &lobe, band),
            Power::Odd(lobe) => self.shade_with::<V, _>(token, group, formula, &lobe, band),
            Power::Any(lobe) => self.shade_with::<V, _>(token, group, formula, &lobe, band),
        }
    }

    #[inline(always)]
    fn shade_with<V: Lane, L: Lobe<V>>(
        &self,
        token: V::Token,
        group: &Group<'_>,
        formula: &BrightnessFormula,
        lobe: &L,
        band: &mut Band<'_>,
    ) -> Result<(), RenderError> {
        token.in_own_function(
            #[inline(always)]
            || self.shade_places(token, group, formula, lobe, band),
        )
    }

    #[inline(always)]
    fn shade_places<V: Lane, L: Lobe<V>>(
        &self,
        token: V::Token,
        group: &Group<'_>,
        formula: &BrightnessFormula,
        lobe: &L,
        band: &mut Band<'_>,
    ) -> Result<(), RenderError> {
        let places = &self.places;
        let outline = group.seen.ellipse.map(
            #[inline(always)]
            |number| V::splat(token, V::Element::from_f64(number)),
        );
        for at in (0..places.count).step_by(V::COUNT) {
            let column = V::load_doubles(token, &places.column[at..]);
            let row = outline.row_at(V::load_doubles(token, &places.row[at..]));
            let place = PlaceInRow {
                column,
                after_first: V::load_doubles(token, &places.after_first[at..]),
                after_last: V::load_doubles(token, &places.after_last[at..]),
            };
            let point = row.point(places.sphere.center, &place).point;
            let (irradiance, lobes) = self.sum(token, &point, at, lobe);
            let ambient = V::splat(token, V::Element::from_f64(self.ambient));
            let irradiance = irradiance + ambient;
            let diffuse = irradiance * formula.diffuse_factor(point.cos_theta_o);
            let specular = lobes * formula.specular_factor(point.cos_theta_o);
            for channel in &mut band.channels {
                let (BandChannel::Double(quantity, _) | BandChannel::Single(quantity, _)) = channel else { continue };
                let values = match *quantity {
                    ScalarChannel::Brightness => diffuse + specular,
                    ScalarChannel::Irradiance => irradiance,
                    ScalarChannel::Diffuse => diffuse,
                    ScalarChannel::Specular => specular,
                    ScalarChannel::Light(light) => self.irradiance_from(token, &point, at, light),
                    ScalarChannel::Ambient => ambient,
                    ScalarChannel::AmbientError => V::splat(token, V::Element::default()),
                    ScalarChannel::Depth => continue,
                };
                let overflow = match channel {
                    BandChannel::Double(_, out) => places.put(values, at, out),
                    BandChannel::Single(_, out) => places.put(values, at, out),
                    BandChannel::Position(_) | BandChannel::Normal(_) => None,
                };
                if let Some((place, value)) = overflow {
                    return Err(RenderError::Overflow { pixel: group.pixels[place].within(group.tile), value });
                }
            }
        }
        Ok(())
    }

    /// E and Σ E_j (N·H_j)ⁿ at a vector of pixels: blocks of lights are summed plainly, the blocks' sums with
    /// compensation. (What is not chosen would add zeros.)
    #[inline(always)]
    fn sum<V: Lane, L: Lobe<V>>(&self, token: V::Token, point: &SurfacePoint<V>, at: usize, lobe: &L) -> (V, V) {
        let zero = point.cos_theta_o.splat_like(0.0);
        let (mut irradiance, mut lobes) = (Sum::starting_at(zero), Sum::starting_at(zero));
        let (mut of_block, mut lobes_of_block) = (zero, zero);
        let mut block = 0;
        let stride = self.places.count.next_multiple_of(16);
        for (index, light) in self.chosen.iter().enumerate() {
            if light / BLOCK != block {
                block = light / BLOCK;
                irradiance.add(of_block);
                lobes.add(lobes_of_block);
                (of_block, lobes_of_block) = (zero, zero);
            }
            let placed = self.lights[*light].map(
                #[inline(always)]
                |number| V::splat(token, V::Element::from_f64(number)),
            );
            let visible = V::load_doubles(token, &self.visible[index * stride + at..]);
            let term = light_term(point, &placed, visible, lobe);
            of_block = of_block + term.irradiance;
            lobes_of_block = term.irradiance.mul_add(term.lobe, lobes_of_block);
        }
        irradiance.add(of_block);
        lobes.add(lobes_of_block);
        (irradiance.value(), lobes.value())
    }

    /// E_j of one light of the scene.
    #[inline(always)]
    fn irradiance_from<V: Lane>(&self, token: V::Token, point: &SurfacePoint<V>, at: usize, light: usize) -> V {
        let zero = point.cos_theta_o.splat_like(0.0);
        let stride = self.places.count.next_multiple_of(16);
        let Some(index) = self.chosen.iter().position(|chosen| self.order[*chosen] == light) else { return zero };
        let placed = self.lights[self.chosen[index]].map(
            #[inline(always)]
            |number| V::splat(token, V::Element::from_f64(number)),
        );
        let visible = V::load_doubles(token, &self.visible[index * stride + at..]);
        light_term(point, &placed, visible, &NoPower).irradiance
    }

    fn store_geometry(&self, band: &mut Band<'_>) {
        if !band.has_geometry() {
            return;
        }
        let Places { count, sphere, index, normal: [x, y, z], distance, .. } = &*self.places;
        let length = band.length;
        let normal = |place: usize| Vector::new(x[place], y[place], z[place]);
        for channel in &mut band.channels {
            match channel {
                BandChannel::Double(ScalarChannel::Depth, out) => {
                    (0..*count)
                        .for_each(|place| out[index[place]] = length.from_metres(distance[place] * sphere.radius));
                }
                BandChannel::Normal(out) => {
                    (0..*count).for_each(|place| out[index[place]] = normal(place).to_array());
                }
                BandChannel::Position(out) => {
                    for place in 0..*count {
                        let position = sphere.center + normal(place) * sphere.radius;
                        out[index[place]] = position.to_array().map(|coordinate| length.from_metres(coordinate));
                    }
                }
                BandChannel::Double(..) | BandChannel::Single(..) => {}
            }
        }
    }
}

impl Places {
    /// Writes the values of a vector of pixels. Tells which of them, if any, is a number that the channel cannot hold.
    #[inline(always)]
    fn put<V: Lane, O: Element>(&self, values: V, at: usize, out: &mut [O]) -> Option<(usize, f64)> {
        let mut buffer = [V::Element::default(); 16];
        values.store(&mut buffer);
        for (place, value) in (at..self.count).zip(buffer).take(V::COUNT) {
            let rounded = O::from_f64(value.to_f64());
            out[self.index[place]] = rounded;
            if !rounded.to_f64().is_finite() {
                return Some((place, value.to_f64()));
            }
        }
        None
    }
}
