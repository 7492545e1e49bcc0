//! Areas of interest against closed forms (5.9).

use isophote::analysis::area::AreaReading;
use isophote::analysis::probe::SeenFromEye;
use isophote::prepare::PreparedScene;
use isophote::scene::{Scene, Syntax};

const INTENSITY: f64 = 1000.0;
const HEIGHT: f64 = 3.0;

/// A Lambertian lamp over a point of the plane z = 0, aimed straight down; areas and the rest of the camera are given.
fn plane(lamp: [f64; 2], rest: &str) -> PreparedScene {
    let [x, y] = lamp;
    let text = format!(
        r#"
        version = 1
        length = "m"
        convention = "irradiance"
        camera.eye = [0, 0, 10]
        camera.tilt = 0
        camera.projection = "orthographic"
        camera.window = {{ x = [-4, 4], y = [-4, 4] }}
        [[plane]]
        name = "floor"
        point = [0, 0, 0]
        normal = [0, 0, 1]
        [[light]]
        position = [{x}, {y}, {HEIGHT}]
        emission = "lambertian"
        tilt = 0
        intensity = {INTENSITY}
        {rest}
        "#
    );
    PreparedScene::new(&Scene::from_text("plane", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

/// The reading of the only area.
fn reading(scene: &PreparedScene) -> AreaReading {
    scene.area(&scene.scene().areas()[0]).expect("the plane is seen")
}

/// (5.4), at a distance along the plane from the foot of the lamp.
fn irradiance(along: f64) -> f64 {
    INTENSITY * HEIGHT * HEIGHT / (HEIGHT * HEIGHT + along * along).powi(2)
}

fn assert_close(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found - expected).abs() <= relative * expected, "{what}: {found} {expected}");
}

const CIRCLE: &str = "[[area]]\non = \"floor\"\ncenter = [0, 0, 0]\nradius = 2\n";
const ON_SCREEN: &str = "[[area]]\nat = [0, 0]\nradius = 2\n";

/// (5.9): I/h² at the centre, I/(h² + R²) on average, I h²/(h² + R²)² at the edge; the same on the plane and, seen straight from
/// above, on the screen.
#[test]
fn a_circle_under_a_lamp_has_the_extremes_and_the_mean_of_the_closed_form() {
    for area in [CIRCLE, ON_SCREEN] {
        let found = reading(&plane([0.0, 0.0], area));
        assert_close(found.max.value, INTENSITY / 9.0, 1e-14, "maximum");
        assert_close(found.mean, INTENSITY / 13.0, 1e-12, "mean");
        assert_close(found.min.value, irradiance(2.0), 1e-14, "minimum");
        assert_eq!(found.max.point.to_array(), [0.0, 0.0, 0.0]);
        assert!((found.min.point.length() - 2.0).abs() < 1e-12);
        assert_eq!((found.visible, found.max.seen), (1.0, SeenFromEye::Seen));
        assert!(found.mean_error < 1e-11 * found.mean, "{found:?}");
        assert_eq!(found.max.screen.is_some(), area == ON_SCREEN);
    }
}

/// Wherever the foot of the lamp is in the circle; outside, the maximum is on the edge, straight towards the foot.
#[test]
fn extremes_are_found_between_the_points_and_on_the_edge() {
    for [x, y] in [[0.3, -0.7], [1.234, 1.234], [-1.9, 0.1], [0.0, 1e-5], [1.5, 2.5], [-7.0, 0.2]] {
        let foot = f64::hypot(x, y);
        let found = reading(&plane([x, y], CIRCLE));
        assert_close(found.max.value, irradiance((foot - 2.0).max(0.0)), 1e-13, "maximum");
        assert_close(found.min.value, irradiance(foot + 2.0), 1e-13, "minimum");
        let place = if foot < 2.0 { [x, y] } else { [2.0 * x / foot, 2.0 * y / foot] };
        let [at_x, at_y, _] = found.max.point.to_array();
        assert!(f64::hypot(at_x - place[0], at_y - place[1]) < 1e-6, "{:?} {place:?}", found.max.point);
    }
}

#[test]
fn a_rectangle_is_darkest_in_its_corners() {
    let area = "[[area]]\non = \"floor\"\ncenter = [0.5, 0, 0]\nsize = [3, 2]\n";
    let found = reading(&plane([0.0, 0.0], area));
    assert_close(found.max.value, INTENSITY / 9.0, 1e-14, "maximum");
    assert_close(found.min.value, irradiance(f64::hypot(2.0, 1.0)), 1e-14, "minimum");
    // ∫∫ by Simpson's rule.
    let steps = 200_i32;
    let weight = |k: i32| if k == 0 || k == steps { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    let mut sum = 0.0;
    for row in 0..=steps {
        for column in 0..=steps {
            let (x, y) =
                (-1.0 + 3.0 * f64::from(column) / f64::from(steps), -1.0 + 2.0 * f64::from(row) / f64::from(steps));
            sum += weight(row) * weight(column) * irradiance(f64::hypot(x, y));
        }
    }
    assert_close(found.mean, sum / (9.0 * f64::from(steps * steps)), 1e-8, "mean");
    // The height runs along `up`.
    let turned = area.replace("size = [3, 2]", "size = [2, 3]\nup = [1, 0, 0]");
    assert_close(reading(&plane([0.0, 0.0], &turned)).mean, found.mean, 1e-12, "turned");
}

/// What shows no surface does not count; what the eye does not see counts, and is told.
#[test]
fn what_is_seen_of_an_area_is_told() {
    let ball = "[[sphere]]\ncenter = [0, 0, 5]\nradius = 1\ncasts_shadow = false\n";
    let found = reading(&plane([3.0, 0.0], &format!("{ball}{CIRCLE}")));
    assert!((found.visible - 0.75).abs() < 0.01, "a quarter of the circle is behind the ball: {found:?}");
    let without_floor = plane([0.0, 0.0], &format!("{ball}[[area]]\nat = [0, 0]\nradius = 2\n"));
    assert_eq!(reading(&without_floor).visible, 1.0);
    let nothing = "[[sphere]]\ncenter = [0, 0, -3]\nradius = 1\n[[area]]\nat = [100, 0]\nradius = 0.5\n";
    let scene = plane([0.0, 0.0], nothing);
    assert!(scene.area(&scene.scene().areas()[0]).is_some(), "a plane has no end");
}

/// What is said about an area that cannot be.
#[test]
fn areas_that_cannot_be_are_refused() {
    let refused = |area: &str| {
        let text = format!(
            r#"
            version = 1
            length = "m"
            convention = "irradiance"
            camera = {{ eye = [0, 0, 10], tilt = 0, field_of_view = 40 }}
            [[disk]]
            name = "floor"
            center = [0, 0, 0]
            normal = [0, 0, 1]
            radius = 2
            [[sphere]]
            name = "ball"
            center = [0, 0, 5]
            radius = 1
            [[area]]
            {area}
            "#
        );
        Scene::from_text("areas", &text, Syntax::Toml).expect_err("a mistake is refused").report(false)
    };
    for (area, words) in [
        ("on = \"floor\"\ncenter = [0, 0, 0]\nradius = 3", "`area[0]` reaches beyond the edge of \"floor\""),
        ("on = \"floor\"\ncenter = [0, 0, 0.1]\nradius = 1", "`area[0].center` is not on \"floor\": it is 0.1 m away"),
        ("on = \"ball\"\ncenter = [0, 0, 6]\nradius = 1", "`area[0]` is on \"ball\", a sphere"),
        ("on = \"flor\"\ncenter = [0, 0, 0]\nradius = 1", "did you mean `floor`?"),
        ("on = \"floor\"\ncenter = [0, 0, 0]\nradius = 0", "`area[0].radius` is 0"),
        ("on = \"floor\"\ncenter = [0, 0, 0]\nsize = [1, -1]", "`area[0].size[1]` is -1"),
        ("on = \"floor\"\ncenter = [0, 0, 0]\nradius = 1\nsize = [1, 1]", "`area[0]` has both `radius` and `size`"),
        (
            "on = \"floor\"\ncenter = [0, 0, 0]\nsize = [1, 1]\nup = [0, 0, 1]",
            "`area[0].up` is along the normal [0, 0, 1] of",
        ),
        ("on = \"floor\"\nat = [0, 0]\nradius = 1", "where `at` means nothing"),
        ("at = [0, 0]", "the key `radius` is missing"),
        ("radius = 1", "the key `at` is missing"),
        ("at = [0, 0]\ncenter = [0, 0, 0]\nradius = 1", "`area[0].center` means nothing for an area on the screen"),
    ] {
        let report = refused(area);
        assert!(report.contains(words), "{area}: {report}");
    }
}
