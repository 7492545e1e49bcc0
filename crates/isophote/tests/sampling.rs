//! Pixels as means over their area.

use isophote::lanes::Precision;
use isophote::map::{Map, Pixel, Quantity, Region, Resolution, Values};
use isophote::prepare::PreparedScene;
use isophote::render::{ReferenceRenderer, RenderSettings, Renderer, SimdRenderer};
use isophote::scene::Filter;
use isophote::scene::{Scene, Syntax};
use isophote::units::Keyword;

/// A sphere of radius 0.25 at distance 2.6 on the axis, screen at distance 3: the silhouette has the radius
/// 0.289804351503 (5.6).
fn disc(sampling: &str) -> PreparedScene {
    let text = format!(
        "version = 1\nlength = \"m\"\nconvention = \"lambert\"
        [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nresolution = [80, 60]
        screen = {{ distance = 3, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
        [sampling]\n{sampling}
        [material.white]\ndiffuse = 1
        [[sphere]]\ncenter = [0, 0, 2.6]\nradius = 0.25\nmaterial = \"white\"
        [[light]]\nposition = [0.5, 0.5, -3]\nintensity = 10"
    );
    PreparedScene::new(&Scene::from_text("test", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

const RADIUS: f64 = 0.289_804_351_503;

fn render(scene: &PreparedScene, region: Option<Region>) -> Map {
    let quantities =
        vec![Quantity::Brightness, Quantity::Samples, Quantity::Coverage, Quantity::Depth, Quantity::Shape];
    let settings = RenderSettings { quantities, region, ..RenderSettings::default() };
    SimdRenderer::new(Precision::Double, None).render(scene, &settings).expect("it renders")
}

fn values(map: &Map, quantity: &Quantity) -> Vec<f64> {
    map.scalar(quantity).expect("it was asked for").iter().collect()
}

/// ∫ √(R² − x²) dx from 0 to x.
fn half_disc(x: f64) -> f64 {
    let x = x.clamp(-RADIUS, RADIUS);
    0.5 * (x * (RADIUS * RADIUS - x * x).sqrt() + RADIUS * RADIUS * (x / RADIUS).asin())
}

/// The area of the disc within x₀ < x < x₁ and below y.
fn area_below([left, right]: [f64; 2], y: f64) -> f64 {
    let (left, right) = (left.clamp(-RADIUS, RADIUS), right.clamp(-RADIUS, RADIUS));
    if y <= -RADIUS {
        return 0.0;
    }
    let whole = 2.0 * (half_disc(right) - half_disc(left));
    if y >= RADIUS {
        return whole;
    }
    if y < 0.0 {
        return whole - area_below([left, right], -y);
    }
    // Above y there is disc only where |x| < w.
    let w = (RADIUS * RADIUS - y * y).sqrt();
    let (a, b) = (left.clamp(-w, w), right.clamp(-w, w));
    whole - ((half_disc(b) - half_disc(a)) - y * (b - a))
}

/// The part of a pixel of 0.01 that the disc covers.
fn covered(pixel: Pixel) -> f64 {
    let left = -0.4 + 0.01 * f64::from(pixel.column);
    let top = 0.3 - 0.01 * f64::from(pixel.row);
    let columns = [left, left + 0.01];
    (area_below(columns, top) - area_below(columns, top - 0.01)) / 1e-4
}

#[test]
fn the_exact_coverage_adds_up_to_the_disc() {
    let pixels = (0..60).flat_map(|row| (0..80).map(move |column| Pixel { column, row }));
    let total: f64 = pixels.map(covered).sum::<f64>() * 1e-4;
    assert!((total - std::f64::consts::PI * RADIUS * RADIUS).abs() < 1e-12, "{total}");
}

#[test]
fn the_mean_over_a_silhouette_pixel_is_the_area_that_is_covered() {
    let mut worst = Vec::new();
    for samples in [16, 64, 256] {
        let map = render(&disc(&format!("samples = {samples}")), None);
        let coverage = values(&map, &Quantity::Coverage);
        let errors = coverage.iter().enumerate().map(|(index, found)| (found - covered(map.pixel(index))).abs());
        let error = errors.fold(0.0, f64::max);
        // A straight edge is known to n^(−3/4); see the pattern.
        assert!(error < 1.7 * f64::from(samples).powf(-0.75), "{samples}: {error}");
        worst.push(error);
        let area: f64 = coverage.iter().sum::<f64>() * 1e-4;
        assert!((area / (std::f64::consts::PI * RADIUS * RADIUS) - 1.0).abs() < 2e-3, "{samples}: {area}");
    }
    assert!(worst.windows(2).all(|pair| pair[1] < 0.75 * pair[0]), "{worst:?}");
}

#[test]
fn an_adaptive_map_is_within_its_tolerance_of_many_samples_and_refines_little() {
    let exact = values(&render(&disc("samples = 1024"), None), &Quantity::Brightness);
    let peak = exact.iter().fold(0.0, |peak: f64, value| peak.max(*value));
    for tolerance in [0.03, 0.01, 0.003] {
        let map = render(&disc(&format!("tolerance = {tolerance}\nsamples = 1024")), None);
        let found = values(&map, &Quantity::Brightness);
        let error = found.iter().zip(&exact).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max) / peak;
        assert!(error < tolerance, "{tolerance}: {error}");
        let refined = values(&map, &Quantity::Samples).iter().filter(|samples| **samples > 1.0).count();
        // In so small an image the shading of a matt sphere bends by 0.003 from pixel to pixel.
        let most = if tolerance < 0.01 { 2400 } else { 1200 };
        assert!((50..most).contains(&refined), "{tolerance}: {refined} of 4800 pixels");
    }
}

/// Within the outline a tolerance integrates: the area that a pixel shows is far better known than from as many points.
#[test]
fn the_outline_of_a_sphere_is_integrated() {
    let map = render(&disc("tolerance = 0.01"), None);
    let (coverage, samples) = (values(&map, &Quantity::Coverage), values(&map, &Quantity::Samples));
    let mut cut = 0;
    for (index, found) in coverage.iter().enumerate().filter(|(index, _)| samples[*index] > 1.0) {
        let error = (found - covered(map.pixel(index))).abs();
        assert!(
            samples[index] <= 80.0 && error < 4e-3,
            "{:?}: {error} by {} samples",
            map.pixel(index),
            samples[index]
        );
        cut += u32::from(*found < 1.0);
    }
    assert!(cut > 100, "{cut}");
}

/// Highlights and the terminators of three lights, in front of and beside each other; the channels are means of the same places.
#[test]
fn integrated_pixels_are_within_the_tolerance_of_many_samples() {
    for (convention, shininess) in [("lab", 5), ("radiance", 40), ("lambert", 1), ("radiance", 100)] {
        let scene = |sampling: &str| {
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"{convention}\"
                [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nresolution = [80, 60]
                screen = {{ distance = 3, x = [-0.8, 0.8], y = [-0.6, 0.6] }}
                [sampling]\n{sampling}
                [material.gloss]\ndiffuse = 0.6\nspecular = 0.4\nshininess = {shininess}
                [[sphere]]\ncenter = [0.3, 0.1, 5]\nradius = 0.8\nmaterial = \"gloss\"
                [[sphere]]\ncenter = [-0.5, 0, 4]\nradius = 0.35\nmaterial = \"gloss\"
                [[sphere]]\ncenter = [-0.9, 0.62, 5]\nradius = 0.03\nmaterial = \"gloss\"
                [[light]]\nposition = [3, 2, -3]\nintensity = 10
                [[light]]\nname = \"side\"\nposition = [-4, 0.5, 4.5]\nintensity = 8
                [[light]]\nposition = [0, -5, 6]\nintensity = 12"
            );
            PreparedScene::new(&Scene::from_text("test", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
        };
        let side = Quantity::Light("side".into());
        let quantities = [Quantity::Brightness, Quantity::Diffuse, Quantity::Specular, side, Quantity::Samples];
        let settings = RenderSettings { quantities: quantities.to_vec(), ..RenderSettings::default() };
        let render = |sampling: &str| {
            SimdRenderer::new(Precision::Double, None).render(&scene(sampling), &settings).expect("it renders")
        };
        let (exact, map) = (render("samples = 4096"), render("tolerance = 0.01\nsamples = 1024"));
        let samples = values(&map, &Quantity::Samples);
        for quantity in &quantities[..4] {
            let (exact, found) = (values(&exact, quantity), values(&map, quantity));
            let peak = exact.iter().fold(0.0, |peak: f64, value| peak.max(*value));
            let is_brightness = *quantity == Quantity::Brightness;
            for (index, (found, exact)) in found.iter().zip(exact).enumerate() {
                // The tolerance is one of the brightness; rays, 16 or a higher power of two, promise no more.
                if !is_brightness && ![8.0, 24.0, 40.0].contains(&samples[index]) {
                    continue;
                }
                let error = (found - exact).abs();
                assert!(
                    error <= 0.01 * peak,
                    "{convention}, n = {shininess}, {quantity:?} at {:?}, {} samples: {found} {exact}, peak {peak}",
                    map.pixel(index),
                    samples[index]
                );
            }
        }
        let [brightness, diffuse, specular] = [0, 1, 2].map(|index| values(&map, &quantities[index]));
        for ((whole, diffuse), specular) in brightness.iter().zip(diffuse).zip(specular) {
            assert!((whole - diffuse - specular).abs() <= 1e-13 * (1.0 + whole.abs()));
        }
        let integrated = samples.iter().filter(|samples| [8.0, 24.0, 40.0].contains(*samples)).count();
        assert!(integrated > 100, "{integrated}");
    }
}

#[test]
fn one_sample_in_a_box_is_the_plain_map() {
    let [plain, one] = ["", "samples = 1"].map(|sampling| render(&disc(sampling), None));
    assert_eq!(values(&plain, &Quantity::Brightness), values(&one, &Quantity::Brightness));
    assert!(values(&plain, &Quantity::Samples).iter().all(|samples| [0.0, 1.0].contains(samples)));
}

#[test]
fn regions_and_the_reference_give_the_same_pixels() {
    for filter in Filter::ALL {
        for sampling in ["samples = 9", "tolerance = 0.02"] {
            let scene = disc(&format!("{sampling}\nfilter = \"{}\"", filter.name()));
            let whole = render(&scene, None);
            let region = Region { corner: Pixel { column: 7, row: 20 }, size: Resolution { width: 30, height: 25 } };
            let part = render(&scene, Some(region));
            for (quantity, index) in &[(Quantity::Brightness, 0), (Quantity::Coverage, 1), (Quantity::Depth, 2)] {
                let whole = values(&whole, quantity);
                for (at, value) in values(&part, quantity).into_iter().enumerate() {
                    let pixel = part.pixel(at);
                    let expected = whole[pixel.row as usize * 80 + pixel.column as usize];
                    assert_eq!(
                        value.to_bits(),
                        expected.to_bits(),
                        "{filter:?}, {sampling}, {pixel:?}, channel {index}"
                    );
                }
            }
            let settings = RenderSettings { quantities: vec![Quantity::Brightness], ..RenderSettings::default() };
            let reference = ReferenceRenderer.render(&scene, &settings).expect("it renders");
            for (lanes, reference) in
                values(&whole, &Quantity::Brightness).iter().zip(values(&reference, &Quantity::Brightness))
            {
                assert!((lanes - reference).abs() < 1e-12, "{lanes} {reference}");
            }
        }
    }
}

/// A filter moves light between pixels and adds none: far from the image's border, the sum stays.
#[test]
fn filters_keep_the_sum_of_the_light() {
    let sum = |filter: Filter| {
        let map = render(&disc(&format!("samples = 64\nfilter = \"{}\"", filter.name())), None);
        values(&map, &Quantity::Brightness).iter().sum::<f64>()
    };
    let [boxed, triangle, mitchell] = [Filter::Box, Filter::Triangle, Filter::Mitchell].map(sum);
    for other in [triangle, mitchell] {
        assert!((other / boxed - 1.0).abs() < 1e-3, "{other} {boxed}");
    }
}

/// Where only a part of a pixel sees the surface, its geometry is that of the part.
#[test]
fn pixels_that_are_seen_in_part_have_a_depth_and_a_shape() {
    let map = render(&disc("samples = 16"), None);
    let depth = values(&map, &Quantity::Depth);
    let Some(Values::Index(shapes)) = map.channel(&Quantity::Shape).map(|channel| &channel.values) else {
        panic!("it was asked for")
    };
    for (index, coverage) in values(&map, &Quantity::Coverage).into_iter().enumerate() {
        assert_eq!(coverage > 0.0 || depth[index] > 0.0, shapes[index] == 0, "{index}");
        assert!(shapes[index] < 0 || (2.3..2.7).contains(&depth[index]), "{index}: {}", depth[index]);
    }
}

/// Pixels that a tolerance refines trace each of their rays by itself; the same rays come from whole images of one place in
/// every pixel when all have as many. Both find the same, in lanes, in tiles and through the tree.
#[test]
fn rays_one_by_one_and_images_of_each_place_find_the_same() {
    let ball = |index: u32| {
        let place = f64::from(index) * 0.37 - 1.5;
        format!(
            "[[sphere]]\ncenter = [{place}, {}, 5]\nradius = 0.3\nmaterial = \"white\"\n",
            0.3 * (3.0 * place).sin()
        )
    };
    let balls = |count: u32| (0..count).map(ball).collect::<String>();
    let cases = [
        (balls(2), "shadows = false"),
        (balls(9), "shadows = true"),
        (balls(3) + "[[box]]\ncenter = [0, -0.6, 5]\nsize = [4, 0.2, 1]\nmaterial = \"white\"", "shadows = true"),
    ];
    for (shapes, shadows) in cases {
        let scene = |sampling: &str| {
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"lambert\"\n{shadows}
                [camera]\neye = [0, 0, 0]\nforward = [0, 0, 1]\nresolution = [80, 60]
                screen = {{ distance = 3, x = [-0.8, 0.8], y = [-0.6, 0.6] }}
                [sampling]\n{sampling}
                [material.white]\ndiffuse = 1
                [[light]]\nposition = [3, 2, -3]\nintensity = 10\n{shapes}"
            );
            PreparedScene::new(&Scene::from_text("test", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
        };
        let fixed = values(&render(&scene("samples = 16"), None), &Quantity::Brightness);
        let map = render(&scene("samples = 16\ntolerance = 0.0001"), None);
        let adaptive = values(&map, &Quantity::Brightness);
        let peak = fixed.iter().copied().fold(0.0, f64::max);
        let refined: Vec<usize> = values(&map, &Quantity::Samples)
            .iter()
            .enumerate()
            .filter(|(_, n)| **n == 16.0)
            .map(|(at, _)| at)
            .collect();
        assert!(refined.len() > 200, "{}", refined.len());
        for index in refined {
            let (fixed, adaptive) = (fixed[index], adaptive[index]);
            assert!((fixed - adaptive).abs() <= 1e-12 * peak, "{fixed} {adaptive} at {:?}", map.pixel(index));
        }
    }
}

/// The fraction of the pixel with this upper left corner where a·x + b·y ≤ d, with a and b positive.
fn below_the_edge([a, b]: [f64; 2], d: f64, [left, top]: [f64; 2]) -> f64 {
    let distance = d - a * left - b * (top - 1.0);
    let half_square = |distance: f64| 0.5 * distance.max(0.0) * distance.max(0.0);
    (half_square(distance) - half_square(distance - a) - half_square(distance - b) + half_square(distance - a - b))
        / (a * b)
}

/// Parallel light on a half plane: a pixel is as bright as it is covered. Along the diagonal, unscrambled Hammersley points
/// would be off by 1/(2√n).
#[test]
fn the_mean_over_a_straight_edge_is_within_the_tolerance_and_the_bound() {
    let mut worst = 0.0_f64;
    for [a, b] in [[1.0, 1.0], [1.0, 2.0], [2.0, 1.0], [1.0, 3.0], [0.3, 0.9]] {
        for step in 0..12 {
            let d = 0.3 + f64::from(step) / 12.0 * (a + b);
            let length = f64::hypot(a, b);
            let center = [a, b].map(|part| part / length * (d / length - 500.0));
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"irradiance\"
                [camera]\nprojection = \"orthographic\"\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nresolution = [16, 12]
                window = {{ x = [-8, 8], y = [-6, 6] }}
                [sampling]\ntolerance = 0.01
                [[rectangle]]\ncenter = [{}, {}, 0]\nnormal = [0, 0, 1]\nup = [{a}, {b}, 0]\nwidth = 1000\nheight = 1000
                [[light]]\nemission = \"parallel\"\ndirection = [0, 0, -1]\nirradiance = 1",
                center[0], center[1]
            );
            let map = render_with_errors(&scene(&text));
            let (found, bounds) = (values(&map, &Quantity::Brightness), values(&map, &Quantity::SamplingError));
            // As many samples as notice what matters, and those that locate the edge.
            assert!(values(&map, &Quantity::Samples).iter().all(|samples| *samples < 400.0));
            for (index, (found, bound)) in found.iter().zip(bounds).enumerate() {
                let Pixel { column, row } = map.pixel(index);
                let exact = below_the_edge([a, b], d, [f64::from(column) - 8.0, 6.0 - f64::from(row)]);
                let error = (found - exact).abs();
                assert!(
                    error <= 0.01 && error <= bound + 1e-7,
                    "{a} {b} {d}, {column} {row}: {found} {exact} ± {bound}"
                );
                worst = worst.max(error);
            }
            assert_eq!(map.over_tolerance, Some(0));
        }
    }
    assert!(worst > 1e-3, "{worst}");
}

fn scene(text: &str) -> PreparedScene {
    PreparedScene::new(&Scene::from_text("test", text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

fn render_with_errors(scene: &PreparedScene) -> Map {
    let quantities = vec![Quantity::Brightness, Quantity::Samples, Quantity::SamplingError, Quantity::Coverage];
    let settings = RenderSettings { quantities, ..RenderSettings::default() };
    SimdRenderer::new(Precision::Double, None).render(scene, &settings).expect("it renders")
}

/// Rods 0.4 pixels wide, which pass between the centres of pixels: the sum of the coverage is their area.
#[test]
fn rods_narrower_than_a_pixel_are_seen_all_along() {
    for degrees in [0.0_f64, 1.0, 17.0, 45.0, 63.0, 90.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        for beside in [0.0, 0.3, 0.5] {
            let [x, y] = [-sine * beside, cosine * beside];
            let [across, up] = [4.5 * cosine, 4.5 * sine];
            let rods = [
                format!(
                    "[[cylinder]]\nfrom = [{}, {}, 0]\nto = [{}, {}, 0]\nradius = 0.2",
                    x - across,
                    y - up,
                    x + across,
                    y + up
                ),
                format!(
                    "[[box]]\ncenter = [{x}, {y}, 0]\nsize = [9, 0.4, 0.4]\nrotation = {{ axis = [0, 0, 1], degrees = {degrees} }}"
                ),
            ];
            for rod in rods {
                let text = format!(
                    "version = 1\nlength = \"m\"\nconvention = \"irradiance\"
                    [camera]\nprojection = \"orthographic\"\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nresolution = [16, 12]
                    window = {{ x = [-8, 8], y = [-6, 6] }}
                    [sampling]\ntolerance = 0.01\n{rod}
                    [[light]]\nemission = \"parallel\"\ndirection = [0, 0, -1]\nirradiance = 1"
                );
                let map = render_with_errors(&scene(&text));
                let area: f64 = values(&map, &Quantity::Coverage).iter().sum();
                assert!((area - 9.0 * 0.4).abs() < 0.01 * 9.0 * 0.4, "{degrees}° at {beside}: {area}, {rod}");
            }
        }
    }
}

/// Their shadows under parallel light have the same area, wherever they fall.
#[test]
fn shadows_narrower_than_a_pixel_are_seen_all_along() {
    for degrees in [0.0_f64, 17.0, 45.0, 90.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        for beside in [0.0, 0.3, 0.5] {
            // The light falls slantwise, so that the rod is outside the image and its shadow in the middle.
            let [x, y] = [-sine * beside + 20.0, cosine * beside];
            let text = format!(
                "version = 1\nlength = \"m\"\nconvention = \"irradiance\"\nshadows = true
                [camera]\nprojection = \"orthographic\"\neye = [0, 0, 50]\ntarget = [0, 0, 0]\nresolution = [16, 12]
                window = {{ x = [-8, 8], y = [-6, 6] }}
                [sampling]\ntolerance = 0.01
                [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]
                [[box]]\ncenter = [{x}, {y}, 20]\nsize = [9, 0.4, 0.01]\nrotation = {{ axis = [0, 0, 1], degrees = {degrees} }}
                [[light]]\nemission = \"parallel\"\ndirection = [-1, 0, -1]\nirradiance = 1"
            );
            let map = render_with_errors(&scene(&text));
            let brightest = 0.5_f64.sqrt();
            let dark: f64 = values(&map, &Quantity::Brightness).iter().map(|found| 1.0 - found / brightest).sum();
            // The box casts the shadow of its thickness too, on the side away from the light.
            let area = 9.0 * 0.4 + 0.01 * (9.0 * sine + 0.4 * cosine);
            assert!((dark - area).abs() < 0.02 * area, "{degrees}° at {beside}: {dark} {area}");
        }
    }
}

/// Spheres, boxes, cylinders and cones on a floor under four lamps, some of them thin.
fn still_life(seed: u64, size: [u32; 2], sampling: &str) -> PreparedScene {
    use std::fmt::Write;
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut between = |least: f64, greatest: f64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        #[expect(clippy::cast_precision_loss, reason = "a fraction")]
        let part = (state >> 40) as f64 / (1_u64 << 24) as f64;
        least + (greatest - least) * part
    };
    let mut text = format!(
        "version = 1\nlength = \"m\"\nconvention = \"radiance\"\nshadows = true
        [camera]\neye = [0, 3, -8]\ntarget = [0, 0.4, 0]\nresolution = [{}, {}]
        screen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.3, 0.3] }}
        [sampling]\n{sampling}
        [material.chalk]\ndiffuse = 0.6
        [material.glaze]\ndiffuse = 0.3\nspecular = 0.4\nshininess = 20
        [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"chalk\"\n",
        size[0], size[1]
    );
    let kinds = ["sphere", "box", "cylinder", "cone", "rod"];
    for kind in kinds {
        let (x, y, z) = (between(-2.5, 2.5), between(0.5, 0.9), between(-2.0, 2.0));
        let form = match kind {
            "sphere" => format!("center = [{x}, {y}, {z}]\nradius = {}", between(0.3, 0.5)),
            "box" => format!(
                "center = [{x}, {y}, {z}]\nsize = [{}, 0.5, 0.7]\nrotation = {{ axis = [1, 2, 0], degrees = {} }}",
                between(0.4, 1.0),
                between(0.0, 90.0)
            ),
            "cylinder" => format!(
                "from = [{x}, {y}, {z}]\nto = [{}, {}, {z}]\nradius = {}",
                x + between(-1.0, 1.0),
                y + 0.8,
                between(0.15, 0.4)
            ),
            "cone" => format!("base = [{x}, 0.05, {z}]\napex = [{x}, {}, {z}]\nradius = 0.4", between(0.8, 1.5)),
            _ => format!("from = [{x}, {y}, {z}]\nto = [{}, {}, {z}]\nradius = 0.01", x + 1.0, y + between(0.0, 1.0)),
        };
        let name = if kind == "rod" { "cylinder" } else { kind };
        let casts_shadow = if kind == "rod" { "\ncasts_shadow = false" } else { "" };
        let material = if matches!(kind, "cone" | "rod") { "chalk" } else { "glaze" };
        write!(text, "[[{name}]]\n{form}\nmaterial = \"{material}\"{casts_shadow}\n").expect("a text takes it");
    }
    for _ in 0..4 {
        let position = [between(-5.0, 5.0), between(3.0, 7.0), between(-6.0, 0.0)];
        write!(text, "[[light]]\nposition = {position:?}\nintensity = {}\n", between(20.0, 80.0))
            .expect("a text takes it");
    }
    scene(&text)
}

#[test]
fn a_tolerance_is_kept_among_shapes_and_their_shadows() {
    for seed in 0..5 {
        let exact = values(&render(&still_life(seed, [24, 18], "samples = 4096"), None), &Quantity::Brightness);
        let peak = exact.iter().copied().fold(0.0, f64::max);
        for tolerance in [0.03, 0.01] {
            let map = render_with_errors(&still_life(seed, [24, 18], &format!("tolerance = {tolerance}")));
            let samples = values(&map, &Quantity::Samples);
            for (index, (found, exact)) in values(&map, &Quantity::Brightness).iter().zip(&exact).enumerate() {
                let (pixel, rays) = (map.pixel(index), samples[index]);
                let error = (found - exact).abs() / peak;
                assert!(error <= tolerance, "scene {seed}, {tolerance}, {pixel:?}: off by {error} with {rays} rays");
            }
        }
    }
}

/// Whether so many samples are a power of two and some rounds that locate an edge.
fn is_of_cut(samples: f64) -> bool {
    (1..=8).any(|rounds| [64.0, 128.0, 256.0, 512.0].contains(&(samples - 9.0 * f64::from(rounds))))
}

#[test]
fn narrow_shapes_and_neighbours_are_the_same_in_any_region() {
    let scene = still_life(3, [60, 45], "tolerance = 0.01");
    let whole = render(&scene, None);
    let [all, samples] = [Quantity::Brightness, Quantity::Samples].map(|quantity| values(&whole, &quantity));
    assert!(samples.iter().filter(|samples| is_of_cut(**samples)).count() > 20);
    let mut refined = 0;
    for (column, row) in (0..60).step_by(7).flat_map(|column| (0..45).step_by(5).map(move |row| (column, row))) {
        let size = Resolution { width: (60 - column).min(7), height: 5 };
        let part = render(&scene, Some(Region { corner: Pixel { column, row }, size }));
        for (index, value) in values(&part, &Quantity::Brightness).into_iter().enumerate() {
            let pixel = part.pixel(index);
            let at = pixel.row as usize * 60 + pixel.column as usize;
            assert_eq!(value.to_bits(), all[at].to_bits(), "{pixel:?}");
            refined += usize::from(samples[at] > 1.0);
        }
    }
    assert!((100..2700).contains(&refined), "{refined}");
}

#[test]
fn pixels_that_so_many_rays_do_not_assure_are_counted() {
    let peak_of = |map: &Map| values(map, &Quantity::Brightness).into_iter().fold(0.0, f64::max);
    // The image is as small as the one that tells the largest brightness.
    let peak = peak_of(&render(&still_life(1, [32, 24], "samples = 1"), None));
    let mut counts = Vec::new();
    for samples in [16, 64, 4096] {
        let map = render_with_errors(&still_life(1, [32, 24], &format!("tolerance = 0.02\nsamples = {samples}")));
        let errors = values(&map, &Quantity::SamplingError);
        let over = errors.iter().filter(|bound| **bound > 0.02 * peak).count();
        assert_eq!(map.over_tolerance, Some(over), "{samples}");
        counts.push(over);
        let of_one = errors.iter().zip(values(&map, &Quantity::Samples)).filter(|(_, samples)| *samples <= 1.0);
        assert!(of_one.into_iter().all(|(bound, _)| *bound == 0.0));
    }
    assert!(counts[0] > counts[1] && counts[1] > 0 && counts[2] == 0, "{counts:?}");
    assert_eq!(render(&disc("samples = 16"), None).over_tolerance, None);
}

#[test]
fn without_a_tolerance_there_is_no_bound() {
    let settings = RenderSettings { quantities: vec![Quantity::SamplingError], ..RenderSettings::default() };
    let refused = SimdRenderer::new(Precision::Double, None).render(&disc("samples = 16"), &settings);
    let message = refused.expect_err("it has no tolerance").to_string();
    assert!(message.contains("`sampling-error`") && message.contains("`sampling.tolerance`"), "{message}");
}
