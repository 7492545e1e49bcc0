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
