//! Text that another machine wrote, and names of any length, for the terminal.

use ratatui::text::Span;

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

/// Shortens a name to `width` columns in its middle, because names differ at their ends.
pub fn shorten(name: &str, width: usize) -> String {
    if Span::raw(name).width() <= width {
        return name.to_string();
    }
    let mut kept: Vec<char> = name.chars().collect();
    loop {
        if kept.is_empty() {
            return String::new();
        }
        let middle = kept.len() / 2;
        kept.remove(middle);
        let (front, back) = kept.split_at(middle);
        let short: String = front.iter().chain(['…'].iter()).chain(back).collect();
        if Span::raw(&short).width() <= width {
            return short;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_names_keep_their_ends() {
        assert_eq!(shorten("actor-0", 7), "actor-0");
        assert_eq!(shorten("actor-0123456789", 9), "acto…6789");
        // Each of these takes two columns.
        assert_eq!(shorten("日本語の名前", 7), "日本…前");
        assert_eq!([shorten("abc", 1), shorten("abc", 0)], ["…", ""]);
        assert_eq!(shorten("a-very-long-name", 8), "a-ve…ame");
    }
}
