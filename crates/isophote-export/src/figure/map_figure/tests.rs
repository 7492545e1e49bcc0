use isophote::map::{Coordinates, Quantity, Resolution, Window};
use isophote::units::LengthUnit;

use super::*;
use crate::colormap::Colormap;
use crate::figure::color_bar::ColorBar;
use crate::figure::marks::Mark;
use crate::figure::read_back::{WrittenText, decode, images, page, texts};
use crate::sample_map::{Seen, everywhere, map_over, square_map};

fn options() -> FigureOptions {
    FigureOptions::new(Quantity::Brightness, "brightness B, lab (3.3)")
}

fn svg_of(map: &Map, options: &FigureOptions) -> String {
    map_figure(map, options).unwrap().to_svg().unwrap()
}

fn bar<'c>(content: &'c Content<'_>) -> &'c ColorBar {
    match &content.picture {
        Picture::Numbers { bar, .. } => bar,
        Picture::Colors { .. } => panic!("it is of numbers"),
    }
}

fn mark(name: &str, x: f64, y: f64) -> Mark {
    Mark { name: name.into(), x, y }
}

/// The cosine over a ball: 1 at the centre, 0 at the limb.
fn ball(pixels: u32) -> Map {
    square_map(pixels, 1.5, |x, y| {
        let square = 1.0 - x * x - y * y;
        (square > 0.0).then(|| Seen { brightness: square.sqrt(), shape: 0 })
    })
}

fn wave(size: [u32; 2], x: [f64; 2], y: [f64; 2], amplitude: f64) -> Map {
    let window = Window { x, y, length: LengthUnit::Millimetre, coordinates: Coordinates::Screen };
    let (wide, high) = (x[1] - x[0], y[1] - y[0]);
    map_over(
        Resolution { width: size[0], height: size[1] },
        window,
        everywhere(move |x, y| amplitude * (1.0 + (9.0 * x / wide).sin() * (7.0 * y / high).cos())),
    )
}

fn find<'texts>(texts: &'texts [WrittenText], content: &str) -> Vec<&'texts WrittenText> {
    texts.iter().filter(|text| text.content == content).collect()
}

#[test]
fn the_embedded_image_holds_the_maps_pixels_and_nothing_where_no_surface_is_seen() {
    let map = ball(31);
    let svg = svg_of(&map, &FigureOptions { range: Some([0.0, 1.0]), ..options() });
    let image = &images(&svg)[0];
    assert_eq!(image.size, [31, 31]);
    let values = map.scalar(&Quantity::Brightness).unwrap();
    for (column, row) in [(15, 15), (10, 15), (15, 7), (20, 12)] {
        let [red, green, blue] = Colormap::Viridis.color(values.at((row * 31 + column) as usize));
        assert_eq!(image.pixel(column, row), [red, green, blue, 255]);
    }
    assert_eq!(image.pixel(0, 0), [0; 4]);
    assert!(svg.contains("image-rendering:pixelated"));
}

#[test]
fn numbers_stand_at_the_pixels_of_their_values_and_scales_are_equal() {
    let map = wave([120, 80], [-60.0, 60.0], [10.0, 90.0], 1.0);
    let svg = svg_of(&map, &options());
    let place = images(&svg)[0].place;
    assert!((place.width / place.height - 120.0 / 80.0).abs() < 1e-9, "equal scales");
    let texts = texts(&svg);
    // Labels that occur only once: 40 is on both axes.
    let below = find(&texts, "−20")[0].room.center;
    assert!((below.x - (place.left + 40.0 / 120.0 * place.width)).abs() < 0.02);
    assert!(below.y > place.top + place.height);
    let beside = find(&texts, "80")[0].room.center;
    assert!((beside.y - (place.top + 10.0 / 80.0 * place.height)).abs() < 0.02);
    assert!(beside.x < place.left);
    assert_eq!((find(&texts, "x, mm").len(), find(&texts, "y, mm").len()), (1, 1));
    assert_eq!(find(&texts, "brightness B, lab (3.3), W/m²").len(), 1);
}

#[test]
fn every_level_is_written_on_its_line_along_it_and_upright() {
    let map = square_map(200, 1.0, everywhere(|x, y| x * x + y * y));
    let svg = svg_of(&map, &FigureOptions { isophotes: 6, ..options() });
    let place = images(&svg)[0].place;
    let texts = texts(&svg);
    let is_inside = |text: &&WrittenText| text.room.lies_in(&place);
    let numbers: Vec<&WrittenText> = texts.iter().filter(is_inside).collect();
    // 1.75 only cuts the corners: too short for a label.
    for level in ["0.25", "0.50", "0.75", "1.00", "1.25", "1.50"] {
        let number = numbers.iter().find(|text| text.content == level).unwrap_or_else(|| panic!("{level}"));
        let [x, y] = [
            (number.room.center.x - place.left) / place.width * 2.0 - 1.0,
            1.0 - (number.room.center.y - place.top) / place.height * 2.0,
        ];
        let radius = level.parse::<f64>().unwrap().sqrt();
        assert!((x.hypot(y) - radius).abs() < 3.0 / place.width * 2.0, "{level} at {x}, {y}");
        // Along the circle, so perpendicular to the radius. On the page y points down.
        let (sine, cosine) = number.room.turn.sin_cos();
        assert!((x * cosine - y * sine).abs() < 0.05 * radius, "{level}");
        assert!(cosine >= 0.0);
    }
}

#[test]
fn a_line_leaves_a_gap_for_its_number() {
    let map = square_map(100, 1.0, everywhere(|_, y| y));
    let svg = svg_of(&map, &FigureOptions { isophotes: 1, ..options() });
    let place = images(&svg)[0].place;
    let number = texts(&svg).into_iter().find(|text| text.room.lies_in(&place)).unwrap();
    assert_eq!(number.content, "0");
    let (first, last) = (number.room.center.x - number.room.half[0], number.room.center.x + number.room.half[0]);
    let half_pixel = 0.005 * place.width;
    let middle = place.top + 0.5 * place.height;
    let (start, end) = (place.left + half_pixel, place.left + place.width - half_pixel);
    let line = |from: f64, to: f64| format!("M{from:.1} {middle} L{to:.1} {middle}");
    let pieces: Vec<String> = pieces_at(&svg, middle).iter().map(|[from, to]| line(*from, *to)).collect();
    assert_eq!(pieces, [line(start, first - 2.5), line(last + 2.5, end)]);
}

/// First and last x of the paths that begin at a given height.
fn pieces_at(svg: &str, height: f64) -> Vec<[f64; 2]> {
    let paths = svg.lines().filter(|line| line.starts_with("<path") && line.contains("stroke-opacity"));
    let data = paths.filter_map(|line| line.split('"').nth(1));
    let numbers = data.map(|data| {
        data.split(|sign: char| "ML ".contains(sign)).filter_map(|word| word.parse().ok()).collect::<Vec<f64>>()
    });
    numbers
        .filter(|numbers| (numbers[1] - height).abs() < 0.01)
        .map(|numbers| [numbers[0], numbers[numbers.len() - 2]])
        .collect()
}

#[test]
fn no_text_leaves_the_page_or_touches_another() {
    let long = "Освещённость стены за сферой при двух лампах: <без тени> & с тенью, подробный отчёт о работе";
    let word = "освещённость_по_всем_источникам";
    let figures = [
        (ball(60), FigureOptions { title: long.into(), isophotes: 14, ..options() }),
        (wave([300, 30], [0.0, 4000.0], [-200.0, 200.0], 1e-7), FigureOptions { label: word.into(), ..options() }),
        (wave([20, 300], [-1e-4, 1e-4], [0.0, 3e-3], 4e7), FigureOptions { label: long.into(), ..options() }),
        (ball(40), FigureOptions { colormap: Colormap::Gray, range: Some([0.2, 0.6]), ..options() }),
    ];
    for (index, (mut map, options)) in figures.into_iter().enumerate() {
        // Without a footer the page ends right below the axes and the colour bar's title.
        map.provenance.program.clear();
        map.provenance.renderer.clear();
        let x = map.window.x;
        let marks = vec![mark("P1", x[0], 0.0), mark("probe", 0.6 * x[0] + 0.4 * x[1], 0.0)];
        let svg = svg_of(&map, &FigureOptions { marks, ..options });
        let page = page(&svg);
        let texts = texts(&svg);
        for (position, text) in texts.iter().enumerate() {
            assert!(text.room.lies_in(&page), "figure {index}: `{}` leaves the page", text.content);
            for other in &texts[..position] {
                let touch = text.room.overlaps(&other.room);
                assert!(!touch, "figure {index}: `{}` touches `{}`", text.content, other.content);
            }
        }
    }
}

#[test]
fn gaps_are_hatched_and_explained_only_where_there_are_any() {
    let with = svg_of(&ball(20), &FigureOptions { no_surface: "фон".into(), ..options() });
    assert_eq!(with.matches("url(#no-surface)").count(), 2, "the picture's ground and the legend");
    assert_eq!(find(&texts(&with), "фон").len(), 1);
    let without = svg_of(&square_map(20, 1.0, everywhere(|x, _| x)), &options());
    assert!(!without.contains("no-surface") && !without.contains("no surface"));
}

#[test]
fn title_marks_units_and_version_are_written_as_given() {
    let title = "Шар при k_d < 0.5 & k_s > 0";
    let options = FigureOptions {
        title: title.into(),
        unit: Some("Вт/м²".into()),
        length_unit: Some("м".into()),
        marks: vec![mark("P<1>", 0.2, 0.1)],
        ..options()
    };
    let svg = svg_of(&ball(40), &options);
    let texts = texts(&svg);
    let wanted = [title, "P<1>", "x, м", "brightness B, lab (3.3), Вт/м²", "isophote 0.1.0 · double reference"];
    for content in wanted {
        assert_eq!(find(&texts, content).len(), 1, "{content}");
    }
}

#[test]
fn values_beyond_the_range_are_shown_by_arrows_at_the_colour_bar() {
    let beyond = |range| {
        let options = FigureOptions { range, ..options() };
        bar(&Content::new(&ball(20), &options).unwrap()).beyond
    };
    assert_eq!(beyond(None), [false, false]);
    assert_eq!(beyond(Some([-1.0, 0.5])), [false, true]);
    assert_eq!(beyond(Some([0.5, 2.0])), [true, false]);
}

#[test]
fn a_constant_map_has_a_range_around_its_value() {
    for (value, wanted) in [(4.0, [2.0, 6.0]), (0.0, [0.0, 1.0]), (-4.0, [-6.0, -2.0])] {
        let map = square_map(4, 1.0, everywhere(move |_, _| value));
        let options = options();
        let content = Content::new(&map, &options).unwrap();
        assert_eq!(bar(&content).scale.range.map(f64::to_bits), wanted.map(f64::to_bits));
        assert!(map_figure(&map, &options).is_ok());
    }
}

#[test]
fn what_cannot_be_drawn_is_refused_by_name() {
    let refuse = |map: &Map, options: FigureOptions| map_figure(map, &options).unwrap_err().to_string();
    let map = ball(20);
    let nothing = square_map(8, 1.0, |_, _| None);
    assert!(refuse(&nothing, options()).contains("give one"));
    assert!(map_figure(&nothing, &FigureOptions { range: Some([0.0, 1.0]), ..options() }).is_ok());
    for range in [[1.0, 1.0], [2.0, 1.0], [0.0, f64::INFINITY], [f64::NAN, 1.0]] {
        assert!(refuse(&map, FigureOptions { range: Some(range), ..options() }).starts_with("`range` is"));
    }
    assert!(refuse(&map, FigureOptions { quantity: Quantity::Normal, ..options() }).contains("`normal`"));
    assert!(refuse(&map, FigureOptions { quantity: Quantity::Depth, ..options() }).contains("`depth`"));
    let lost = refuse(&map, FigureOptions { marks: vec![mark("lost", 1.6, 0.0)], ..options() });
    assert_eq!(lost, "mark `lost` at x = 1.6, y = 0 lies outside the map's window");
    let broken = square_map(4, 1.0, everywhere(|x, _| if x > 0.5 { f64::NAN } else { x }));
    assert!(refuse(&broken, options()).starts_with("brightness[3] is NaN"));
}

#[test]
fn the_png_shows_the_colours_and_the_texts_of_the_svg() {
    let figure = map_figure(&ball(20), &FigureOptions { isophotes: 0, ..options() }).unwrap();
    let svg = figure.to_svg().unwrap();
    let (size, rgba) = decode(&figure.to_png(0.5, None).unwrap());
    let page = page(&svg);
    let sides = [(size[0], page.width), (size[1], page.height)];
    assert!(sides.iter().all(|(pixels, side)| (f64::from(*pixels) - 0.5 * side).abs() <= 0.5), "{size:?}");
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places on the page")]
    let pixel = |place: Place| {
        let start = 4 * ((0.5 * place.y) as usize * size[0] as usize + (0.5 * place.x) as usize);
        [rgba[start], rgba[start + 1], rgba[start + 2], rgba[start + 3]]
    };
    let place = images(&svg)[0].place;
    let center = Place { x: place.left + 0.5 * place.width + 3.0, y: place.top + 0.5 * place.height + 3.0 };
    assert_eq!(pixel(center), [253, 231, 37, 255], "the brightest pixel");
    assert_eq!(pixel(Place { x: 1.0, y: 1.0 }), [255; 4], "the rim of the page");
    for text in texts(&svg) {
        let corners = text.room.corners();
        let along = (0..=200).map(|step| f64::from(step) / 200.0);
        let places = along.map(|t| Place {
            x: corners[0].x + t * (corners[2].x - corners[0].x),
            y: corners[0].y + t * (corners[2].y - corners[0].y),
        });
        assert!(places.into_iter().any(|place| pixel(place)[0] < 230), "`{}` is not seen", text.content);
    }
}
