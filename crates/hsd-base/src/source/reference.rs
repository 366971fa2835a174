//! Paths as URI references.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};

/// Characters that are not escaped: unreserved characters and the slashes between folders.
const PLAIN: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'-')
    .remove(b'.')
    .remove(b'_')
    .remove(b'~')
    .remove(b'/');

/// Converts a path, divided by `/`, to a relative reference (RFC 3986), also valid in a query.
pub fn reference(path: &str) -> String {
    utf8_percent_encode(path, PLAIN).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_but_plain_characters_are_escaped() {
        assert_eq!(reference("street/a-b_1~.hsd"), "street/a-b_1~.hsd");
        assert_eq!(reference("町 &=.hsd"), "%E7%94%BA%20%26%3D.hsd");
        assert_eq!(reference("a%b?c#d+e"), "a%25b%3Fc%23d%2Be");
    }
}
