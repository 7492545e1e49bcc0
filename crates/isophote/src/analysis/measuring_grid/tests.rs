use super::*;
use crate::analysis::statistics::statistics;
use crate::scene::{Scene, Syntax};
use crate::shape::Side;

const HEAD: &str = "version = 1\nlength = \"m\"\nquantities = \"photometric\"\nconvention = \"irradiance\"\n";
const CAMERA: &str = "[camera]\neye = [0, 1, -9]\ntarget = [0, 0, 0]\nresolution = [4, 4]\n\
    screen = { distance = 1, x = [-1, 1], y = [-1, 1] }\n";
const FLOOR: &str =
    "[[rectangle]]\nname = \"floor\"\ncenter = [0, 0, 0]\nwidth = 8\nheight = 8\nnormal = [0, 1, 0]\nup = [0, 0, 1]\n";
const LAMP: &str = "[[light]]\nname = \"lamp\"\nposition = [0, 3, 0]\nintensity = 1000\nemission = \"lambertian\"\naxis = [0, -1, 0]\n";
/// A point every half metre from −1.5 m to 1.5 m.
const GRID: &str =
    "[[grid]]\nname = \"floor\"\ncenter = [0, 0, 0]\nu = [3.5, 0, 0]\nv = [0, 0, -3.5]\npoints = [7, 7]\n";

fn prepared(shadows: bool, parts: &[&str]) -> PreparedScene {
    let text = format!("{HEAD}shadows = {shadows}\n{CAMERA}{}", parts.concat());
    PreparedScene::new(&Scene::from_text("test", &text, Syntax::Toml).unwrap_or_else(|error| panic!("{error}")))
}

fn illuminance(scene: &PreparedScene) -> (Map, Vec<f64>) {
    let map = scene.grid(&scene.scene().grids()[0], &[Quantity::Irradiance]).expect("the channel exists");
    let values = map.scalar(&Quantity::Irradiance).expect("it is there").iter().collect();
    (map, values)
}

/// (5.4): CIE 171:2006, test 5.2, table 11.
#[test]
fn a_grid_under_a_lambertian_lamp_has_the_illuminances_of_cie_171() {
    const TABLE: [(f64, f64, f64); 10] = [
        (0.0, 0.0, 111.11),
        (0.5, 0.0, 105.21),
        (1.0, 0.0, 90.02),
        (1.5, 0.0, 71.11),
        (0.5, 0.5, 99.73),
        (1.0, 0.5, 85.64),
        (1.5, 0.5, 68.06),
        (1.0, 1.0, 74.36),
        (1.5, 1.0, 59.98),
        (1.5, 1.5, 49.39),
    ];
    let scene = prepared(false, &[LAMP, GRID]);
    let grid = &scene.scene().grids()[0];
    let (map, values) = illuminance(&scene);
    for (index, value) in values.iter().enumerate() {
        let Vector { x, y, z } = grid.point(map.pixel(index));
        assert_eq!(y, 0.0);
        let slant_squared = 9.0 + x * x + z * z;
        let expected = 1000.0 * 9.0 / (slant_squared * slant_squared);
        assert!((value - expected).abs() <= 1e-13 * expected, "{value} {expected}");
        let (far, near) = (x.abs().max(z.abs()), x.abs().min(z.abs()));
        let is_here = |entry: &&(f64, f64, f64)| (entry.0 - far).abs() < 1e-9 && (entry.1 - near).abs() < 1e-9;
        let printed = TABLE.iter().find(is_here).expect("every point stands in the table").2;
        // The table prints 74.36 and 49.39 where the formula gives 74.380 and 49.383.
        assert!((value / printed - 1.0).abs() <= 3e-4, "{value} is printed as {printed}");
    }
    let found = statistics(&map, &Quantity::Irradiance).expect("there are points");
    assert_eq!((found.max.pixel, values.len()), (Pixel { column: 3, row: 3 }, 49));
    assert!((found.min.value / found.max.value - 49.39 / 111.11).abs() < 1e-4);
}

#[test]
fn a_grid_on_a_floor_is_not_in_the_floors_shadow_and_other_shapes_stand_in_its_light() {
    let free = illuminance(&prepared(true, &[LAMP, GRID])).1;
    assert_eq!(illuminance(&prepared(true, &[FLOOR, LAMP, GRID])).1, free);
    let ball = "[[sphere]]\ncenter = [0.75, 1.5, 0]\nradius = 0.3\n";
    let shaded = illuminance(&prepared(true, &[FLOOR, ball, LAMP, GRID])).1;
    let grid = prepared(true, &[LAMP, GRID]);
    let grid = &grid.scene().grids()[0];
    for (index, (value, free)) in shaded.iter().zip(&free).enumerate() {
        let cell =
            Pixel { column: u32::try_from(index % 7).expect("small"), row: u32::try_from(index / 7).expect("small") };
        // The distance at which the light's path passes the ball's centre.
        let (lamp, centre) = (Vector::new(0.0, 3.0, 0.0), Vector::new(0.75, 1.5, 0.0));
        let way = (grid.point(cell) - lamp).normalized();
        let distance = way.cross(centre - lamp).length();
        assert_eq!(*value, if distance < 0.3 { 0.0 } else { *free }, "{cell:?} {distance}");
    }
    assert!(shaded.iter().filter(|value| **value == 0.0).count() >= 2, "{shaded:?}");
    assert_eq!(illuminance(&prepared(false, &[FLOOR, ball, LAMP, GRID])).1, free, "shadows = false");
}

/// The points beneath a box touch both the floor and the box's lower face.
#[test]
fn a_box_on_the_floor_hides_the_points_beneath_it() {
    let cuboid = "[[box]]\ncenter = [1, 0.5, 1]\nsize = [1.2, 1, 1.2]\n";
    let (_, shaded) = illuminance(&prepared(true, &[FLOOR, cuboid, LAMP, GRID]));
    let (_, free) = illuminance(&prepared(true, &[LAMP, GRID]));
    let at = |column: usize, row: usize| (shaded[row * 7 + column], free[row * 7 + column]);
    // Row 0 is farthest along v, at z = −1.5; z = 1 is row 5, x = 1 column 5.
    assert_eq!(at(5, 5).0, 0.0);
    assert_eq!(at(4, 4).0, 0.0);
    let (lit, expected) = at(1, 1);
    assert_eq!(lit, expected);
}

#[test]
fn the_side_decides_what_is_lit_and_the_lights_add_up() {
    let below = "[[light]]\nname = \"cellar\"\nposition = [1, -2, 0.25]\nintensity = 30\n";
    let scene = prepared(true, &[LAMP, below, GRID]);
    let front = scene.scene().grids()[0].clone();
    assert!((front.normal() - Vector::new(0.0, 1.0, 0.0)).length() < 1e-15);
    let back = Grid { side: Side::Back, ..front.clone() };
    let quantities = [Quantity::Irradiance, Quantity::Light("lamp".into()), Quantity::Light("cellar".into())];
    for (grid, lit, dark) in [(&front, 1, 2), (&back, 2, 1)] {
        let map = scene.grid(grid, &quantities).expect("the channels exist");
        let [all, lit, dark] = [0, lit, dark].map(|index| map.scalar(&quantities[index]).expect("it is there"));
        assert_eq!(all.iter().collect::<Vec<_>>(), lit.iter().collect::<Vec<_>>());
        assert!(dark.iter().all(|value| value == 0.0) && lit.iter().all(|value| value > 0.0));
    }
}

#[test]
fn a_light_at_a_point_and_channels_of_a_surface_are_refused() {
    let here = "[[light]]\nname = \"candle\"\nposition = [1, 0, -0.5]\nintensity = 1\n";
    let scene = prepared(false, &[here, GRID]);
    let grid = &scene.scene().grids()[0];
    let refusal = |scene: &PreparedScene, quantity| scene.grid(grid, &[quantity]).expect_err("refused").to_string();
    let message = refusal(&scene, Quantity::Irradiance);
    assert!(message.starts_with("the light \"candle\" stands at the point in column 5, row 2"), "{message}");
    let scene = prepared(false, &[LAMP, GRID]);
    assert!(refusal(&scene, Quantity::Brightness).contains("no channel `brightness`; allowed: irradiance"));
    assert!(refusal(&scene, Quantity::Light("moon".into())).contains("no light named \"moon\""));
}
