//! Files of maps whose cells are not pixels: maps of surfaces and grids.

use std::path::PathBuf;

use anyhow::Result;
use isophote::map::{CoordinateAxis, Map, Quantity};
use isophote::message;
use isophote::scene::Scene;
use isophote::text::{Language, significant};
use isophote_export::FileMetadata;
use isophote_export::csv::Rows;
use isophote_export::figure::{Figure, FigureOptions, map_figure};
use isophote_export::png::{Depth, Normalization};

use super::output::{
    FigureFormat, MapFile, MapStyle, figure_format, formula_label, refuse_colormap, refuse_twice, write_figure,
};
use crate::args::CellStyleArguments;
use crate::failure::{self, Usage};
use crate::threads;

/// Files to write, all checked to be writable.
pub struct CellFiles<'a> {
    files: Vec<MapFile>,
    figures: Vec<(PathBuf, FigureFormat)>,
    style: &'a CellStyleArguments,
}

impl<'a> CellFiles<'a> {
    pub fn new(outputs: &[PathBuf], figures: &[PathBuf], style: &'a CellStyleArguments) -> Result<Self> {
        refuse_twice(outputs.iter().chain(figures))?;
        let files = outputs.iter().map(|path| MapFile::new(path)).collect::<Result<_>>()?;
        let figures = figures.iter().map(|path| Ok((path.clone(), figure_format(path)?)));
        Ok(Self { files, figures: figures.collect::<Result<_>>()?, style })
    }

    pub fn is_empty(&self) -> bool {
        self.files.is_empty() && self.figures.is_empty()
    }

    /// Runs before anything is computed.
    pub fn refuse_impossible_pictures(&self, main: &Quantity) -> Result<(), Usage> {
        let is_picture = !self.figures.is_empty() || self.files.iter().any(MapFile::is_picture);
        refuse_colormap(main, self.style.colormap)?;
        if is_picture && !main.can_be_picture() {
            return Err(Usage(message!(
                "the channel `{channel}` cannot be a picture: it is not one quantity a cell; put another --channel first",
                channel = main.name()
            )));
        }
        Ok(())
    }

    /// Writes everything; the channel in the options is the one pictured.
    pub fn write(&self, map: &Map, options: FigureOptions, scene: &Scene, quiet: bool) -> Result<()> {
        let (main, language) = (options.quantity.clone(), options.language);
        let figure = (!self.figures.is_empty()).then(|| self.draw(map, options, scene)).transpose()?;
        let style = MapStyle {
            quantity: main.clone(),
            range: self.style.range,
            normalization: Normalization::Max,
            gamma: 1.0,
            depth: Depth::Eight,
            colormap: self.style.colormap,
            rows: Rows::All,
            threads: threads::all(),
        };
        crate::progress::end_in_order();
        let mut notes = Vec::new();
        for file in &self.files {
            file.write(map, &style, &mut notes)?;
        }
        let metadata = map.channel(&main).map(|channel| FileMetadata::of_channel(map, channel));
        if let Some(figure) = &figure {
            for (path, format) in &self.figures {
                write_figure(figure, metadata.as_ref(), path, *format, &mut notes)?;
            }
        }
        if !quiet {
            for note in &notes {
                failure::note(&note.in_language(language));
            }
        }
        Ok(())
    }

    fn draw(&self, map: &Map, options: FigureOptions, scene: &Scene) -> Result<Figure> {
        /// A longer, thinner map would leave no room for its numbers.
        const MOST: f64 = 6.0;
        let title = if options.title.is_empty() { scene.title().to_owned() } else { options.title };
        let label = match options.quantity {
            Quantity::Brightness => format!("{}, {}", options.label, formula_label(map).in_language(options.language)),
            _ => options.label,
        };
        let [width, height] =
            options.proportions.unwrap_or([map.window.x, map.window.y].map(|[first, last]| last - first));
        let options = FigureOptions {
            title,
            label,
            colormap: self.style.colormap.unwrap_or_default(),
            range: self.style.range,
            isophotes: self.style.isophotes.into(),
            proportions: Some([(width / height).clamp(1.0 / MOST, MOST), 1.0]),
            ..options
        };
        Ok(map_figure(map, &options)?)
    }
}

/// `longitude 12.5°, latitude −3°`.
pub fn place_text(axes: [CoordinateAxis; 2], place: [f64; 2], language: Language) -> String {
    let one = |(axis, value): (CoordinateAxis, f64)| {
        let unit = match axis.unit {
            "1" => String::new(),
            "°" => "°".into(),
            unit => format!(" {unit}"),
        };
        format!("{} {}{unit}", axis.label(language), significant(value, 6))
    };
    axes.into_iter().zip(place).map(one).collect::<Vec<_>>().join(", ")
}
