//! Problems of scenes as data, and errors as texts.

use isophote::analysis::isophotes::IsophoteError;
use isophote::analysis::measuring_grid::GridError;
use isophote::analysis::section::SectionError;
use isophote::analysis::surface::SurfaceError;
use isophote::render::RenderError;
use isophote::scene::Problem;
use isophote::text::{Language, Message};
use serde::Serialize;
use wasm_bindgen::JsValue;

/// A problem as the page takes it.
#[derive(Serialize)]
pub struct ProblemAnswer {
    kind: &'static str,
    path: String,
    message: String,
    help: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
}

impl ProblemAnswer {
    /// Problems in the order found.
    pub fn all(problems: &[Problem], language: Language) -> Vec<Self> {
        problems.iter().map(|problem| Self::new(problem, language)).collect()
    }

    fn new(problem: &Problem, language: Language) -> Self {
        Self {
            kind: problem.kind.name(),
            path: problem.path.clone(),
            message: problem.message.in_language(language),
            help: problem.help.as_ref().map(|help| help.in_language(language)),
            line: problem.place.as_ref().map(|place| place.line),
            column: problem.place.as_ref().map(|place| place.column),
        }
    }
}

/// Why a question has no answer, in words.
#[derive(Debug)]
pub struct Refusal(pub Message);

/// Errors that are told in either language.
macro_rules! told {
    ($($error:ty),*) => {
        $(impl From<$error> for Refusal {
            fn from(error: $error) -> Self {
                Self(error.message())
            }
        })*
    };
}

told!(
    GridError,
    RenderError,
    SectionError,
    SurfaceError,
    IsophoteError,
    isophote::map::MapError,
    isophote_export::ExportError,
    isophote_export::figure::FigureError
);

impl From<serde_json::Error> for Refusal {
    /// A fault of the page, not of who uses it.
    fn from(error: serde_json::Error) -> Self {
        Self(Message::verbatim(error.to_string()))
    }
}

/// An answer, or why there is none in the language of the page.
pub fn told<T>(answer: Result<T, Refusal>, language: Language) -> Result<T, JsValue> {
    answer.map_err(|Refusal(message)| JsValue::from_str(&message.in_language(language)))
}

/// An answer as JSON. Numbers that are not finite become null.
pub fn json(answer: &impl Serialize) -> Result<String, Refusal> {
    Ok(serde_json::to_string(answer)?)
}
