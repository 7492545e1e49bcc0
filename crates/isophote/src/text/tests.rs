use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::{Language, Message, escaped, escaped_line, russian, significant};
use crate::message;

#[test]
fn what_controls_a_terminal_is_escaped_and_nothing_else() {
    assert_eq!(escaped("\u{1b}]0;x\u{7}\u{1b}[2J\r"), "\\u001B]0;x\\u0007\\u001B[2J\\u000D");
    assert_eq!(escaped("a\u{202e}b\u{2066}c\u{9b}\u{7f}\u{200f}"), "a\\u202Eb\\u2066c\\u009B\\u007F\\u200F");
    assert_eq!(escaped("two\nlines\tand"), "two\nlines\tand");
    assert_eq!(escaped_line("two\nlines\tand"), "two\\u000Alines\\u0009and");
    assert_eq!(escaped_line("Сфера «шар» 球 é W/m²"), "Сфера «шар» 球 é W/m²");
}

#[test]
fn numbers_have_the_digits_that_were_asked_for_and_no_more() {
    assert_eq!(significant(0.316_677_297_547_092_75, 15), "0.316677297547093");
    assert_eq!(significant(0.316_677_297_547_092_75, 4), "0.3167");
    assert_eq!(significant(-100.0, 12), "-100");
    assert_eq!(significant(0.999_999_99, 4), "1");
    assert_eq!(significant(123_456.789, 3), "123457");
    assert_eq!(significant(1.5e-9, 12), "1.5e-9");
    assert_eq!(significant(-2.5e20, 12), "-2.5e20");
    assert_eq!(significant(0.0, 12), "0");
}

#[test]
fn numbers_are_rounded_once() {
    let numbers = [9.9996, 99.9995, 999.95, 0.5, 1e14, 123_456.5, 2.5, 1.005, 65_535.0, 4.1e-5, 7.0, 100.25];
    for value in numbers.into_iter().flat_map(|value| [value, -value]) {
        for digits in 1..=17 {
            let scientific = format!("{value:.*e}", digits - 1);
            let exponent: i32 = scientific.split_once('e').unwrap().1.parse().unwrap();
            let decimals = usize::try_from(i32::try_from(digits).unwrap() - 1 - exponent).unwrap_or(0);
            let fixed = format!("{value:.decimals$}");
            let shown = if fixed.contains('.') { fixed.trim_end_matches('0').trim_end_matches('.') } else { &fixed };
            assert_eq!(significant(value, digits), shown, "{value} with {digits} digits");
        }
    }
}

#[test]
fn a_message_is_the_same_sentence_in_both_languages() {
    let (path, number) = ("light[0].position", 2);
    let message = message!("`{path}` is {found}", path, found = message!("a list of {count}", count = number));
    assert_eq!(message.to_string(), "`light[0].position` is a list of 2");
    assert_eq!(message.in_language(Language::Russian), "`light[0].position` — это список длины 2");
    let message = message!("a scene is an object {{…}}, not {found}", found = Message::verbatim("null"));
    assert_eq!(message.to_string(), "a scene is an object {…}, not null");
    assert_eq!(message.in_language(Language::Russian), "сцена — это объект {…}, а здесь null");
    assert_eq!(Message::empty().in_language(Language::Russian), "");
}

#[test]
fn a_value_is_escaped_and_never_read_as_a_template() {
    let message = message!("there is no shape \"{on}\"", on = "{on}\u{1b}[2J\u{202e}\r{");
    let name = "{on}\\u001B[2J\\u202E\\u000D{";
    assert_eq!(message.to_string(), format!("there is no shape \"{name}\""));
    assert_eq!(message.in_language(Language::Russian), format!("фигуры «{name}» нет"));
    assert_eq!(Message::verbatim("a\u{7}").in_language(Language::Russian), "a\\u0007");
}

/// The Rust files of the workspace that have messages: all but tests.
fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if path.is_dir() {
            if !matches!(name, "tests" | "target" | "benches") && !name.starts_with('.') {
                sources(&path, files);
            }
        } else if path.extension().is_some_and(|suffix| suffix == "rs") && name != "tests.rs" {
            files.push(path);
        }
    }
}

/// Every template that the code makes messages of, with the file that has it. Comments and modules of tests are left out.
fn templates() -> BTreeMap<String, PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["crates", "python/src"] {
        sources(&root.join(folder), &mut files);
    }
    let mut found = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let code: String = code.split_inclusive('\n').filter(|line| !line.trim_start().starts_with("//")).collect();
        for after in code.split("message!(").skip(1) {
            if let Some(literal) = after.trim_start().strip_prefix('"') {
                found.insert(literal_text(literal), file.clone());
            }
        }
    }
    found
}

/// The text of a string literal, from after its first quote.
fn literal_text(literal: &str) -> String {
    let mut text = String::new();
    let mut rest = literal.chars();
    loop {
        match rest.next().expect("the literal ends") {
            '"' => return text,
            '\\' => match rest.next() {
                Some('n') => text.push('\n'),
                Some('\n') => rest = rest.as_str().trim_start().chars(),
                Some(character @ ('"' | '\\' | '\'')) => text.push(character),
                other => panic!("the escape {other:?} in a template: write the character itself"),
            },
            character => text.push(character),
        }
    }
}

/// The names of the placeholders, each once, in alphabetical order.
fn placeholders(template: &str) -> BTreeSet<String> {
    let template = template.replace("{{", "").replace("}}", "");
    template.split('{').skip(1).filter_map(|rest| Some(rest.split_once('}')?.0.to_owned())).collect()
}

#[test]
fn the_catalogue_has_every_template_of_the_code_and_no_other() {
    let templates = templates();
    assert!(templates.len() > 400, "only {} templates were found", templates.len());
    let missing: Vec<_> = templates.iter().filter(|(template, _)| russian::template(template).is_none()).collect();
    assert!(missing.is_empty(), "text/russian.rs lacks {missing:#?}");
    let stale: Vec<_> = russian::TEMPLATES.iter().filter(|(english, _)| !templates.contains_key(*english)).collect();
    assert!(stale.is_empty(), "text/russian.rs has templates that the code has not: {stale:#?}");
}

#[test]
fn the_catalogue_is_sorted_and_has_the_same_placeholders_in_both_languages() {
    assert!(russian::TEMPLATES.is_sorted_by(|(one, _), (next, _)| one < next), "in the order of the English");
    for (english, russian) in russian::TEMPLATES {
        assert!(!english.is_empty() && !russian.trim().is_empty(), "{english:?}: {russian:?}");
        assert_eq!(placeholders(english), placeholders(russian), "{english:?}: {russian:?}");
    }
}

/// Words of four Latin letters or more that are not words of English: formats, programs and names that Russian has too.
const NAMES: &[&str] = &["TOML", "JSON", "HTML", "Blender", "glTF", "USDZ", "NumPy", "sRGB"];

#[test]
fn no_english_word_is_left_in_the_russian() {
    for (english, russian) in russian::TEMPLATES {
        // Identifiers stand in backquotes; placeholders, options and commands are the same in both languages.
        let prose: String = russian.split('`').step_by(2).collect::<Vec<_>>().join(" ");
        let prose: String =
            prose.split('{').map(|part| part.split_once('}').map_or(part, |(_, after)| after)).collect();
        for word in prose.split(|letter: char| !letter.is_ascii_alphabetic()) {
            let is_name = NAMES.contains(&word);
            assert!(word.len() <= 3 || is_name, "the word {word:?} is left in {russian:?} ({english:?})");
        }
    }
}
