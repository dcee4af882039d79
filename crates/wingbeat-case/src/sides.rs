//! Left and right: names of wings that are mirror images of each other.

/// The name with `left` and `right` exchanged.
pub(crate) fn mirror_name(name: &str) -> Option<String> {
    if name.contains("right") {
        Some(name.replace("right", "left"))
    } else if name.contains("left") {
        Some(name.replace("left", "right"))
    } else {
        None
    }
}
