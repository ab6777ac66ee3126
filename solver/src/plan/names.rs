//! Names of bodies in sentences.

/// Largest number of bodies named in a sentence.
const NAMED_BODIES: usize = 3;

/// "body 0", "bodies 0 and 2", "bodies 0, 1, 2 and 5 more".
pub(crate) fn names(bodies: &[usize]) -> String {
    let named = bodies.iter().take(NAMED_BODIES).map(usize::to_string);
    let mut named: Vec<String> = named.collect();
    let last = match bodies.len().checked_sub(NAMED_BODIES) {
        Some(more) if more > 0 => Some(format!("{more} more")),
        _ => named.pop(),
    };
    let last = last.unwrap_or_default();
    if named.is_empty() {
        format!("body {last}")
    } else {
        format!("bodies {} and {last}", named.join(", "))
    }
}
