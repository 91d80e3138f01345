//! Pages that open without a network: what the reports of a run, a study and a sweep share.
//!
//! Markup is made by `maud`, which escapes whatever is put into it; only what is `PreEscaped` here
//! gets past it. A page reads as XML too, so that a test can tell whether every tag is closed.

use maud::{Markup, PreEscaped, Render, html};

use crate::wording::numbers::significant;

pub(crate) mod run;
pub(crate) mod study;
pub(crate) mod sweep;

const HEAD: &str = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
     <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
const STYLE: &str = include_str!("../../assets/report.css");
const PLOT_STYLE: &str = include_str!("../../assets/plot.css");

/// A page but for what all have.
struct Page<'a> {
    title: Markup,
    /// Styles beside those of every page.
    styles: &'a [&'a str],
    main: Markup,
    /// wrasse's version.
    version: &'a str,
    /// What stands behind the text; empty for a page without scripts.
    scripts: Markup,
}

impl Page<'_> {
    /// The page as text: everything is inside, and its content policy forbids it to load anything.
    fn text(&self) -> String {
        let scripts = if self.scripts.0.is_empty() { "" } else { "; script-src 'unsafe-inline'" };
        let body = html! {
            main { (self.main) }
            footer { "wrasse " (self.version) }
        };
        [
            HEAD,
            "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
             style-src 'unsafe-inline'",
            scripts,
            "\"/>\n",
            &shown(html! { title { (self.title) } }),
            "<style>\n",
            &self.styles.concat(),
            STYLE,
            PLOT_STYLE,
            "</style>\n</head>\n<body>\n",
            &shown(body),
            &self.scripts.0,
            "</body>\n</html>\n",
        ]
        .concat()
    }
}

/// Markup without characters that XML does not allow, and no browser shows.
fn shown(markup: Markup) -> String {
    let is_hidden = |c: char| c.is_control() && c != '\n' && c != '\t';
    if markup.0.contains(is_hidden) { markup.0.replace(is_hidden, "\u{fffd}") } else { markup.0 }
}

/// JSON that can stand in a `script` element: no `<` that could end it.
fn json_in_script(json: &str) -> PreEscaped<String> {
    let json = json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026");
    PreEscaped(json.replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029"))
}

/// A section with its heading and an anchor; nothing if there is nothing to put in it.
fn section(anchor: &str, title: &str, content: &Markup) -> Markup {
    section_of_level(2, anchor, title, content)
}

/// The same with a heading of level 2 or 3.
fn section_of_level(level: usize, anchor: &str, title: &str, content: &Markup) -> Markup {
    let link = html! { a href={ "#" (anchor) } { (title) } };
    html! {
        @if !content.0.is_empty() {
            section id=(anchor) {
                @if level == 2 { h2 { (link) } } @else { h3 { (link) } }
                (content)
            }
        }
    }
}

/// What unfolds below its summary.
fn folded(summary: &str, content: &Markup) -> Markup {
    html! { details { summary { (summary) } (content) } }
}

/// Names and what they stand for.
fn facts(rows: &[(&str, String)]) -> Markup {
    html! { dl { @for (name, text) in rows { dt { (name) } dd { (text) } } } }
}

/// Version and seed, as a fact.
fn version_and_seed(version: &str, seed: u64) -> (&'static str, String) {
    ("Version and seed", format!("wrasse {version}, seed {seed}"))
}

/// A file and what was laid over it.
fn file_flown(file: &str, settings: &[String]) -> String {
    let each = settings.iter().map(|setting| format!("--set {setting}"));
    [file.to_owned()].into_iter().chain(each).collect::<Vec<_>>().join(", ")
}

/// The text of a file, folded.
fn file_text(what: &str, text: &str) -> Markup {
    folded(&format!("Text of the {what}"), &html! { pre { (text) } })
}

/// A table in a box that scrolls sideways on narrow screens. The body has its rows.
fn table<H: Render>(class: &str, head: &[H], body: &Markup) -> Markup {
    html! {
        div.scroll {
            table class=(class) {
                thead { tr { @for cell in head { (cell) } } }
                tbody { (body) }
            }
        }
    }
}

/// The head of a column.
#[derive(Clone, Copy)]
enum Head<'a> {
    /// Its name.
    Plain(&'a str),
    /// Its name and the unit of the figures below it.
    Unit(&'a str, &'a str),
    /// Of verdicts, which stay in sight while the others scroll.
    Verdict(&'a str),
}

impl Render for Head<'_> {
    fn render(&self) -> Markup {
        match self {
            Self::Plain(name) => html! { th scope="col" { (name) } },
            Self::Unit(name, unit) => html! { th scope="col" { (name) " " small { (unit) } } },
            Self::Verdict(name) => html! { th.kept scope="col" { (name) } },
        }
    }
}

/// A table of words: a column for each head, a cell for each text.
fn words<'a, const COLUMNS: usize>(
    head: [&str; COLUMNS],
    rows: impl Iterator<Item = [&'a str; COLUMNS]>,
) -> Markup {
    let body = html! { @for row in rows { tr { @for cell in row { td { (cell) } } } } };
    table("text", &head.map(Head::Plain), &body)
}

/// A name of parts with dots, which may break after each dot.
fn dotted(name: &str) -> Markup {
    html! {
        @for (k, part) in name.split('.').enumerate() {
            @if k > 0 { "." (PreEscaped("<wbr/>")) }
            (part)
        }
    }
}

/// A cell of figures, right-aligned.
fn figure(text: &str) -> Markup {
    html! { td.n { (text) } }
}

/// A cell with a number; `none` where there is none.
fn number(value: Option<f64>, none: &str) -> Markup {
    figure(&value.map_or(none.to_owned(), significant))
}

/// The mark of a verdict: a sign, a word, and a colour for those who see it.
fn verdict_mark(pass: bool) -> Markup {
    said(pass, "pass", "fail")
}

/// A sign and words that say whether something is as it should be.
fn said(good: bool, yes: &str, no: &str) -> Markup {
    html! {
        @if good { span.pass { "\u{2713} " (yes) } } @else { span.fail { "\u{2717} " (no) } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_opens_no_tag_ends_no_attribute_and_shows_what_it_hides() {
        let text = "<b title='\"'>&\u{0}\u{1b}[31m";
        let markup = shown(html! { p title=(text) { (dotted(text)) } });
        let safe = "&lt;b title='&quot;'&gt;&amp;\u{fffd}\u{fffd}[31m";
        assert_eq!(markup, format!("<p title=\"{safe}\">{safe}</p>"));
    }

    #[test]
    fn json_in_a_script_still_says_the_same() {
        let json = serde_json::json!({ "</script><!--": "a & b \u{2028}" }).to_string();
        let safe = json_in_script(&json).0;
        assert!(!safe.contains(['<', '>', '&', '\u{2028}']), "{safe}");
        let read: serde_json::Value = serde_json::from_str(&safe).unwrap();
        assert_eq!(read["</script><!--"], "a & b \u{2028}");
    }
}
