//! Messages: written once in English, read in either language.

use std::borrow::Cow;
use std::fmt;

use super::{Language, escaped, russian};

/// A text for people, made by [`message!`](crate::message): a template and the values of its placeholders. It displays in
/// English; [`in_language`](Self::in_language) gives it in another language.
///
/// Values are [escaped](escaped()), so that nothing in them can control a terminal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message(Box<Sentence>);

/// Boxed, so that errors which hold several messages stay small.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Sentence {
    template: &'static str,
    values: Vec<(&'static str, Value)>,
}

/// The value of a placeholder in a [`Message`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// The same in every language: a name, a number, a formula.
    Text(String),
    /// A part of the sentence.
    Message(Message),
}

/// What can stand for a placeholder in a [`Message`].
pub trait ToValue {
    /// The value that stands for it.
    fn to_value(&self) -> Value;
}

/// Makes a [`Message`](crate::text::Message) of a template and the values of its placeholders, each named once:
///
/// ```
/// use isophote::message;
/// use isophote::text::Language;
///
/// let path = "sphere[0].radius";
/// let message = message!("`{path}` is {value}", path, value = -1);
/// assert_eq!(message.to_string(), "`sphere[0].radius` is -1");
/// assert_eq!(message.in_language(Language::Russian), "`sphere[0].radius` равно -1");
/// ```
///
/// Every template has its translation in `text/russian.rs`; a test of the core compares the two lists.
#[macro_export]
macro_rules! message {
    ($template:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::text::Message::new(
            {
                // Placeholders and names are the same; constants cannot capture a variable of the same name.
                const _: fn() = || { let _ = ::core::format_args!($template $(, $name = "")*); };
                $template
            },
            ::std::vec![$((
                ::core::stringify!($name),
                $crate::text::ToValue::to_value(&$crate::message!(@value $name $(= $value)?)),
            )),*],
        )
    };
    (@value $name:ident) => { $name };
    (@value $name:ident = $value:expr) => { $value };
}

impl Message {
    /// What [`message!`](crate::message) makes.
    #[doc(hidden)]
    #[must_use]
    pub fn new(template: &'static str, values: Vec<(&'static str, Value)>) -> Self {
        Self(Box::new(Sentence { template, values }))
    }

    /// A text that is the same in every language: what the operating system or a library says, or a list of names.
    #[must_use]
    pub fn verbatim(text: impl ToValue) -> Self {
        Self::new(VERBATIM, vec![("text", text.to_value())])
    }

    /// An empty text, for an optional part of a sentence.
    #[must_use]
    pub fn empty() -> Self {
        Self::new("", Vec::new())
    }

    /// The text in a language.
    #[must_use]
    pub fn in_language(&self, language: Language) -> String {
        let mut text = String::with_capacity(self.0.template.len() + 16 * self.0.values.len());
        self.write(&mut text, language);
        text
    }

    fn write(&self, text: &mut String, language: Language) {
        let mut rest = self.template_in(language);
        while let Some(at) = rest.find(['{', '}']) {
            let (before, from) = rest.split_at(at);
            text.push_str(before);
            if let Some(bracket @ ("{{" | "}}")) = from.get(..2) {
                text.push_str(&bracket[..1]);
                rest = &from[2..];
                continue;
            }
            let (name, after) = from[1..].split_once('}').unwrap_or((&from[1..], ""));
            match self.0.values.iter().find(|(known, _)| *known == name) {
                Some((_, Value::Text(value))) => text.push_str(value),
                Some((_, Value::Message(message))) => message.write(text, language),
                None => debug_assert!(false, "no value for {name} in {}", self.0.template),
            }
            rest = after;
        }
        text.push_str(rest);
    }

    fn template_in(&self, language: Language) -> &'static str {
        let template = self.0.template;
        match language {
            Language::English => template,
            _ if matches!(template, "" | VERBATIM) => template,
            Language::Russian => {
                let russian = russian::template(template);
                debug_assert!(russian.is_some(), "no Russian for {template}");
                russian.unwrap_or(template)
            }
        }
    }
}

/// The template of a text without words.
const VERBATIM: &str = "{text}";

impl fmt::Display for Message {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.in_language(Language::English))
    }
}

impl ToValue for Message {
    fn to_value(&self) -> Value {
        Value::Message(self.clone())
    }
}

impl ToValue for str {
    fn to_value(&self) -> Value {
        Value::Text(escaped(self).into_owned())
    }
}

impl<T: ToValue + ?Sized> ToValue for &T {
    fn to_value(&self) -> Value {
        (**self).to_value()
    }
}

impl ToValue for Cow<'_, str> {
    fn to_value(&self) -> Value {
        (**self).to_value()
    }
}

/// Types that are the same in every language.
macro_rules! to_value {
    ($($type:ty),*) => {
        $(impl ToValue for $type {
            fn to_value(&self) -> Value {
                self.to_string().as_str().to_value()
            }
        })*
    };
}

to_value!(String, char, f32, f64, u8, u16, u32, u64, u128, usize, i32, i64, std::path::Display<'_>);
