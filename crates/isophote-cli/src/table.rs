//! Tables for people: each column is as wide as its widest cell.

use unicode_width::UnicodeWidthStr;

/// Text columns are left-aligned, numbers right-aligned.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Align {
    Left,
    Right,
}

/// Lays out rows under a header; every row has one cell per column.
pub fn table(columns: &[(&str, Align)], rows: &[Vec<String>]) -> String {
    let header: Vec<String> = columns.iter().map(|(title, _)| (*title).to_owned()).collect();
    let width = |index: usize| rows.iter().chain([&header]).map(|row| row[index].width()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let mut text = String::new();
    for row in std::iter::once(&header).chain(rows) {
        let mut line = String::from(" ");
        for ((cell, width), (_, align)) in row.iter().zip(&widths).zip(columns) {
            let padding = " ".repeat(width - cell.width());
            match align {
                Align::Left => line.extend([" ", cell, &padding, " "]),
                Align::Right => line.extend([" ", &padding, cell, " "]),
            }
        }
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
