//! The language of what a command says.

use clap::Args;
use isophote::text::Language;

use crate::args::parse;

/// Not taken from the environment: what a script reads must not change with the machine.
#[derive(Args, Clone, Copy, Default)]
pub struct LanguageArgument {
    /// Language of messages, tables and figures: en or ru; LANG is not heeded. JSON and what is in files stay as they are
    #[arg(long, value_name = "LANGUAGE", default_value = "en", value_parser = parse::keyword::<Language>())]
    pub lang: Language,
}
