//! Problems of scenes as data, and errors as texts.

use isophote::scene::Problem;
use serde::Serialize;

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
    pub fn all(problems: &[Problem]) -> Vec<Self> {
        problems.iter().map(Self::new).collect()
    }

    fn new(problem: &Problem) -> Self {
        Self {
            kind: problem.kind.name(),
            path: problem.path.clone(),
            message: problem.message.clone(),
            help: problem.help.clone(),
            line: problem.place.as_ref().map(|place| place.line),
            column: problem.place.as_ref().map(|place| place.column),
        }
    }
}

/// Why a question has no answer, in words.
#[derive(Debug)]
pub struct Refusal(pub String);

impl<E: std::error::Error> From<E> for Refusal {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

impl From<Refusal> for wasm_bindgen::JsValue {
    fn from(refusal: Refusal) -> Self {
        Self::from_str(&refusal.0)
    }
}

/// An answer as JSON. Numbers that are not finite become null.
pub fn json(answer: &impl Serialize) -> Result<String, Refusal> {
    Ok(serde_json::to_string(answer)?)
}
