//! Writing maps and figures to files.

use std::collections::HashSet;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use isophote::map::{Map, Quantity};
use isophote::message;
use isophote::text::{Message, significant};
use isophote::units::Keyword;
use isophote_export::colormap::Colormap;
use isophote_export::figure::Figure;
use isophote_export::png::{Depth, Normalization, PictureColor, PictureOptions};
use isophote_export::{ExportError, FileMetadata, Format, atomic, csv, exr, npy, npz, png, write_atomically};

use crate::failure::Usage;
use crate::progress::Interruptible;

/// A map file to write.
pub struct MapFile {
    path: PathBuf,
    format: Format,
}

/// How pictures and tables are written.
pub struct MapStyle {
    pub quantity: Quantity,
    pub range: Option<[f64; 2]>,
    pub normalization: Normalization,
    pub gamma: f64,
    pub depth: Depth,
    pub colormap: Option<Colormap>,
    pub rows: csv::Rows,
    /// The number of compression threads, for formats that compress in blocks.
    pub threads: NonZeroUsize,
}

impl MapFile {
    /// Checks that the suffix names a format and that the file can be written, before anything is computed.
    pub fn new(path: &Path) -> Result<Self> {
        let format = Format::from_path(path).ok_or_else(|| {
            let mut allowed: Vec<String> = Format::ALL.iter().map(|format| format!(".{}", format.name())).collect();
            allowed.push(".zarr".into());
            Usage(message!(
                "cannot tell the format of {path}; allowed: {allowed}",
                path = path.display(),
                allowed = allowed.join(", ")
            ))
        })?;
        atomic::check_target(path)?;
        Ok(Self { path: path.into(), format })
    }

    /// Whether the file is a picture of one channel.
    pub fn is_picture(&self) -> bool {
        self.format == Format::Png
    }

    /// Whether the file is a table with one row per pixel.
    pub fn is_table(&self) -> bool {
        self.format == Format::Csv
    }

    /// Whether the format can hold more than one channel.
    pub fn holds_many_channels(&self) -> bool {
        matches!(self.format, Format::Exr | Format::Npz | Format::Csv)
    }

    /// Writes the map, and adds notes on what a reader of the file should know.
    pub fn write(&self, map: &Map, style: &MapStyle, notes: &mut Vec<Message>) -> Result<()> {
        let path = &self.path;
        let note = write_atomically(path, |file| {
            let mut file = Interruptible(file);
            match self.format {
                Format::Png => return write_picture(map, style, &mut file).map(Some),
                Format::Exr => exr::write(map, style.threads, &mut file)?,
                Format::Npy => npy::write(map, &style.quantity, &mut file)?,
                Format::Npz => npz::write(map, &mut file)?,
                Format::Csv => {
                    csv::write(map, style.rows, &mut file)?;
                }
            }
            Ok(None)
        });
        crate::progress::check()?;
        let path = path.display();
        notes.push(match note? {
            Some(note) => message!("wrote {path}: {note}", path, note),
            None => message!("wrote {path}", path),
        });
        Ok(())
    }
}

fn write_picture(map: &Map, style: &MapStyle, file: &mut impl Write) -> Result<Message, ExportError> {
    let color = style.colormap.map(|colormap| move |fraction| colormap.color(fraction));
    let name = style.colormap.map_or("", Colormap::name);
    let options = PictureOptions {
        quantity: style.quantity.clone(),
        range: style.range,
        normalization: style.normalization,
        gamma: style.gamma,
        depth: style.depth,
        color: color.as_ref().map(|color| PictureColor { name, color }),
    };
    let report = png::write(map, &options, file)?;
    let unit = map.channel(&style.quantity).map_or("", |channel| &channel.unit);
    let [black, white] = report.range.map(|value| significant(value, 6));
    let mut note = match style.normalization {
        Normalization::Log => {
            message!("{black} to {white} {unit} from black to white, by the logarithm", black, white, unit)
        }
        _ => message!("{black} to {white} {unit} from black to white", black, white, unit),
    };
    if report.clamped_below > 0 {
        note = message!("{note}; {count} pixels below are clipped", note, count = report.clamped_below);
    }
    if report.clamped_above > 0 {
        note = message!("{note}; {count} pixels above are clipped", note, count = report.clamped_above);
    }
    Ok(note)
}

/// Colour channels are shown in their own colours, without a colour map.
pub fn refuse_colormap(quantity: &Quantity, colormap: Option<Colormap>) -> Result<(), Usage> {
    if *quantity == Quantity::Color && colormap.is_some() {
        let message = message!(
            "--colormap does not go with the channel `color`, which is shown as it is; put -c brightness first"
        );
        return Err(Usage(message));
    }
    Ok(())
}

/// The map's convention and, in a scene with colours, the luminance that a single number stands for.
pub fn formula_label(map: &Map) -> Message {
    let convention = &map.provenance.convention;
    match &map.provenance.color_space {
        Some(space) => message!("{convention}, luminance in {space}", convention, space),
        None => Message::verbatim(convention),
    }
}

/// Refuses a path given twice: only the last output would survive, without a warning.
pub fn refuse_twice<'p>(paths: impl IntoIterator<Item = &'p PathBuf>) -> Result<(), Usage> {
    let mut seen = HashSet::new();
    match paths.into_iter().find(|path| !seen.insert(place(path))) {
        Some(path) => Err(Usage(message!("{path} would be written twice", path = path.display()))),
        None => Ok(()),
    }
}

/// Where a path leads, however it is written. A file that does not exist yet is in a folder that does.
fn place(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let in_folder = || Some(folder.canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(in_folder).unwrap_or_else(|| path.into())
}

/// The format of a figure.
#[derive(Clone, Copy)]
pub enum FigureFormat {
    Svg,
    Png,
}

/// The format of a figure by its suffix; also checks that the file can be written.
pub fn figure_format(path: &Path) -> Result<FigureFormat> {
    let suffix = path.extension().and_then(|suffix| suffix.to_str()).map(str::to_ascii_lowercase);
    let format = match suffix.as_deref() {
        Some("svg") => FigureFormat::Svg,
        Some("png") => FigureFormat::Png,
        _ => {
            let path = path.display();
            let message = message!("cannot tell the format of {path}; allowed for figures: .svg, .png", path);
            return Err(Usage(message).into());
        }
    };
    atomic::check_target(path)?;
    Ok(format)
}

/// Writes a figure.
///
/// A PNG carries the metadata, if any; an SVG has no place for them that other programs would preserve.
pub fn write_figure(
    figure: &Figure,
    metadata: Option<&FileMetadata>,
    path: &Path,
    format: FigureFormat,
    notes: &mut Vec<Message>,
) -> Result<()> {
    /// Dots per unit of the drawing: sharp on paper and on high-density screens.
    const SCALE: f64 = 2.0;
    let bytes = match format {
        FigureFormat::Svg => figure.to_svg().map(String::into_bytes),
        FigureFormat::Png => figure.to_png(SCALE, metadata.map(FileMetadata::to_json).as_deref()),
    };
    write_bytes(&bytes.map_err(|error| anyhow!("cannot draw the figure: {error}"))?, path, notes)
}

/// Writes a file from bytes already in memory.
pub fn write_bytes(bytes: &[u8], path: &Path, notes: &mut Vec<Message>) -> Result<()> {
    let written = write_atomically(path, |file| Ok(Interruptible(file).write_all(bytes)?));
    crate::progress::check()?;
    written?;
    notes.push(message!("wrote {path}", path = path.display()));
    Ok(())
}
