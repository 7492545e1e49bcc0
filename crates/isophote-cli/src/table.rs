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
    let mut widths = vec![0; columns.len()];
    for row in std::iter::once(&header).chain(rows) {
        for (widest, cell) in widths.iter_mut().zip(row) {
            *widest = width(cell).max(*widest);
        }
    }
    let mut text = String::new();
    for row in std::iter::once(&header).chain(rows) {
        let start = text.len();
        text.push(' ');
        for ((cell, widest), (_, align)) in row.iter().zip(&widths).zip(columns) {
            let padding = std::iter::repeat_n(' ', widest - width(cell));
            text.push(' ');
            match align {
                Align::Left => {
                    text.push_str(cell);
                    text.extend(padding);
                }
                Align::Right => {
                    text.extend(padding);
                    text.push_str(cell);
                }
            }
            text.push(' ');
        }
        text.truncate(start + text[start..].trim_end().len());
        text.push('\n');
    }
    text
}

/// How many columns of a terminal a text takes.
fn width(text: &str) -> usize {
    let is_plain = text.bytes().all(|byte| matches!(byte, b' '..=b'~'));
    if is_plain { text.len() } else { text.width() }
}
