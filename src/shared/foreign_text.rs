//! Text that another machine wrote, for the terminal.

/// Returns up to `chars_max` characters of text from another machine, without those that move the cursor or change
/// direction.
pub fn printable(text: &str, chars_max: usize) -> String {
    let is_invisible = |c: char| {
        c.is_control()
            || matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
            || matches!(c, '\u{2060}'..='\u{206f}' | '\u{feff}')
    };
    text.chars().filter(|c| !is_invisible(*c)).take(chars_max).collect()
}
