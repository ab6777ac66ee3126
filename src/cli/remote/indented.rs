//! JSON for people. What the service sends is on one line; written anew from values it would lose
//! the order of its keys, and what this version does not know.

/// A JSON text with each entry on a line of its own, as `serde_json` writes it. Keys, numbers and
/// texts stay as they are.
pub(super) fn indented(json: &str) -> String {
    let mut text = String::with_capacity(2 * json.len());
    let mut depth = 0_usize;
    let mut in_string = false;
    let mut is_escaped = false;
    let mut characters = json.chars().peekable();
    while let Some(character) = characters.next() {
        if in_string {
            text.push(character);
            in_string = is_escaped || character != '"';
            is_escaped = character == '\\' && !is_escaped;
            continue;
        }
        match character {
            '{' | '[' => {
                text.push(character);
                while characters
                    .next_if(|next| next.is_ascii_whitespace())
                    .is_some()
                {}
                match characters.next_if(|next| matches!(next, '}' | ']')) {
                    Some(end) => text.push(end),
                    None => {
                        depth += 1;
                        new_line(&mut text, depth);
                    }
                }
            }
            '}' | ']' => {
                depth = depth.saturating_sub(1);
                new_line(&mut text, depth);
                text.push(character);
            }
            ',' => {
                text.push(character);
                new_line(&mut text, depth);
            }
            ':' => text.push_str(": "),
            space if space.is_ascii_whitespace() => {}
            other => {
                text.push(other);
                in_string = other == '"';
            }
        }
    }
    text
}

fn new_line(text: &mut String, depth: usize) {
    text.push('\n');
    text.extend(std::iter::repeat_n("  ", depth));
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_document_is_indented_as_serde_json_does() {
        let document = json!({
            "a": [1, 2.5e-3, {"b": null, "c": {}, "d": []}],
            "text": "a \"quoted\" {brace}, [bracket]: \\",
            "ü": true,
        });
        let expected = serde_json::to_string_pretty(&document).unwrap();
        assert_eq!(indented(&document.to_string()), expected);
        assert_eq!(indented(&expected), expected);
        assert_eq!(indented(" { } "), "{}");
    }

    #[test]
    fn keys_keep_their_order_and_numbers_their_digits() {
        let text = r#"{"z":0.10,"a":1E400}"#;
        let indented = indented(text);
        assert_eq!(indented, "{\n  \"z\": 0.10,\n  \"a\": 1E400\n}");
    }
}
