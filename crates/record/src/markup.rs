//! Text from users' files made safe to stand in a page.

/// `text` as HTML text or attribute value: nothing in it can open a tag or end a quote.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            '\n' | '\t' => safe.push(c),
            _ if c.is_control() => safe.push('\u{fffd}'),
            _ => safe.push(c),
        }
    }
    safe
}

/// JSON that can stand in a `script` element: no `<` that could end it.
pub(crate) fn json_in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
        .replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}

/// A table in a box that scrolls sideways on narrow screens. Cells are markup already.
pub(crate) fn table(class: &str, head: &[&str], rows: &[Vec<String>]) -> String {
    let head: Vec<_> = head.iter().map(|h| format!("<th scope=\"col\">{h}</th>")).collect();
    let body: Vec<_> = rows.iter().map(|r| format!("<tr>{}</tr>", r.concat())).collect();
    format!(
        "<div class=\"scroll\"><table class=\"{class}\"><thead><tr>{}</tr></thead>\n\
         <tbody>\n{}\n</tbody></table></div>\n",
        head.concat(),
        body.join("\n")
    )
}

/// A cell of words, from a user's file or from here.
pub(crate) fn words(text: &str) -> String {
    format!("<td>{}</td>", escaped(text))
}

/// A name of parts with dots, which may break after each dot.
pub(crate) fn dotted(name: &str) -> String {
    escaped(name).replace('.', ".<wbr/>")
}

/// A cell of figures, right-aligned.
pub(crate) fn figure(text: &str) -> String {
    format!("<td class=\"n\">{}</td>", escaped(text))
}

/// The mark of a verdict: a sign, a word, and a colour for those who see it.
pub(crate) fn verdict_mark(pass: bool) -> &'static str {
    if pass {
        "<span class=\"pass\">\u{2713} pass</span>"
    } else {
        "<span class=\"fail\">\u{2717} fail</span>"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_text_opens_no_tag_and_ends_no_quote() {
        assert_eq!(
            escaped("<b title='\"'>&\u{0}\u{1b}[31m"),
            "&lt;b title=&#39;&quot;&#39;&gt;&amp;\u{fffd}\u{fffd}[31m"
        );
    }

    #[test]
    fn json_in_a_script_still_says_the_same() {
        let json = serde_json::json!({ "</script><!--": "a & b \u{2028}" }).to_string();
        let safe = json_in_script(&json);
        assert!(!safe.contains(['<', '>', '&', '\u{2028}']), "{safe}");
        let read: serde_json::Value = serde_json::from_str(&safe).unwrap();
        assert_eq!(read["</script><!--"], "a & b \u{2028}");
    }
}
