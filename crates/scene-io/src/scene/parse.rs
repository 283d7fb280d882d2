//! RON text to [`SceneDoc`], with errors that point at the place.

use super::schema::SceneDoc;
use crate::error::Error;
use ron::extensions::Extensions;

/// Reads one scene text. Numbers are checked; names and files are not yet looked up.
pub(crate) fn parse(text: &str) -> Result<SceneDoc, Error> {
    let options = ron::Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES);
    let mut reader = ron::Deserializer::from_str_with_options(text, &options)
        .map_err(|e| located(text, e, ""))?;
    let doc = match serde_path_to_error::deserialize(&mut reader) {
        Ok(doc) => doc,
        Err(e) => {
            let path = e.path().to_string();
            return Err(located(text, reader.span_error(e.into_inner()), &path));
        }
    };
    reader
        .end()
        .map_err(|e| located(text, reader.span_error(e), ""))?;
    Ok(doc)
}

/// Our one-line form of what RON found.
fn located(text: &str, error: ron::error::SpannedError, field: &str) -> Error {
    let at = error.span.start;
    let mut message = error.code.to_string().replace('\n', " ");
    if let Some(first) = message.get(..1) {
        let lower = first.to_lowercase();
        message.replace_range(..1, &lower);
    }
    let says_both = message.contains('`') && !message.starts_with("expected");
    if !(message.contains("found") || says_both) {
        message = format!("{message}, found {}", token_at(text, at.line, at.col));
    }
    let error = Error::invalid(message).at(at.line, at.col);
    // A path of "." or "?" names nothing.
    match field.trim_matches(['.', '?']) {
        "" => error,
        named => error.in_field(named),
    }
}

/// The word or sign at a line and column, both from 1.
fn token_at(text: &str, line: usize, column: usize) -> String {
    let rest: String = text
        .lines()
        .nth(line.saturating_sub(1))
        .unwrap_or_default()
        .chars()
        .skip(column.saturating_sub(1))
        .collect();
    let rest = rest.trim_start();
    let word: String = rest
        .chars()
        .take_while(|c| !c.is_whitespace() && !",():[]{}".contains(*c))
        .take(40)
        .collect();
    match (word.is_empty(), rest.chars().next()) {
        (false, _) => format!("`{word}`"),
        (true, Some(sign)) => format!("`{sign}`"),
        (true, None) if line >= text.lines().count() => "the end of the file".into(),
        (true, None) => "the end of the line".into(),
    }
}
