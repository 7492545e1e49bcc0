//! From text, or from its parts, to a scene.

use super::document::Document;
use super::error::{Lines, Target};
use super::problems::Problems;
use super::{FileResolver, Problem, ProblemKind, Scene, SceneError, SceneSource, Syntax, validate};
use crate::import::{NoFiles, Origin, Resolver};
use crate::message;

impl Scene {
    /// Reads a scene from text; `name` identifies it in error messages. The files it names are looked up in `files`; those
    /// that an earlier scene of the same [origin](Origin) also names are not read again.
    ///
    /// # Errors
    /// Every problem of the text and of the scene in it, with its place.
    pub fn from_text_with(
        files: &dyn Resolver,
        earlier: Option<&Self>,
        name: &str,
        text: &str,
        syntax: Syntax,
    ) -> Result<Self, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            let help = message!("`isophote new lab` writes a scene to start from");
            return Err(SceneError::unreadable(name, message!("the scene is empty"), Some(help)));
        }
        let mut document = Document::parse(text, syntax);
        let mut problems = Problems::default();
        let mut syntax_problems = std::mem::take(&mut document.syntax_problems);
        let is_broken = !syntax_problems.is_empty();
        let is_unreadable = document.ends_at_problem || syntax_problems.len() > FOLLOWED_SYNTAX_PROBLEMS;
        if is_unreadable {
            syntax_problems.truncate(1);
            let help = message!("what follows could not be read because of this; mend it and check again");
            // Advice on the problem itself is better.
            syntax_problems[0].help.get_or_insert(help);
        }
        problems.extend(syntax_problems);
        let source = SceneSource { origin: files.origin(), ..SceneSource::read(&document, &mut problems) };
        let lines = Lines::new(text);
        let locate = |mut problem: Problem| {
            problem.locate(&lines, &document);
            problem
        };
        match validate::validate(source, files, problems, earlier) {
            Ok(mut scene) => {
                scene.warnings = scene.warnings.into_iter().map(locate).collect();
                Ok(scene)
            }
            Err(mut problems) => {
                if is_unreadable {
                    problems.retain(|problem| problem.kind == ProblemKind::Syntax);
                } else if is_broken {
                    // Keys that seem missing from a broken text may be in the part that could not be read.
                    problems.retain(|problem| problem.kind != ProblemKind::MissingKey);
                }
                let mut problems: Vec<Problem> = problems.into_iter().map(locate).collect();
                problems.sort_by_key(|problem| match &problem.place {
                    _ if matches!(problem.target, Target::Rest(_)) => usize::MAX,
                    place => place.as_ref().map_or(0, |place| place.line),
                });
                Err(SceneError { name: name.into(), problems })
            }
        }
    }

    /// Checks a scene and converts it to metres. The files it names are looked up in `files`, whatever its own origin.
    ///
    /// # Errors
    /// Every problem of the scene.
    pub fn from_source_with(files: &dyn Resolver, source: SceneSource) -> Result<Self, SceneError> {
        let source = SceneSource { origin: files.origin(), ..source };
        validate::validate(source, files, Problems::default(), None)
            .map_err(|problems| SceneError { name: "the scene".into(), problems })
    }
}

impl TryFrom<SceneSource> for Scene {
    type Error = SceneError;

    /// Checks a scene and converts it to metres. Files are looked up in its own directory, if its origin is one.
    fn try_from(source: SceneSource) -> Result<Self, SceneError> {
        match &source.origin {
            Origin::Directory(directory) => Self::from_source_with(&FileResolver::new(directory), source),
            Origin::Named(_) => Self::from_source_with(&NoFiles, source),
        }
    }
}

/// If a text has more syntax problems than this, one of them (such as a bracket that never closes) has caused the others.
const FOLLOWED_SYNTAX_PROBLEMS: usize = 3;
