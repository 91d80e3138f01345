//! The page: it is whole, it loads nothing, and no name from a file can break it.
#![allow(clippy::unwrap_used, reason = "a test that finds nothing to unwrap has failed")]

mod sample;

use wrasse_mission::Outcome;
use wrasse_record::{report_html, verdict_table};
use wrasse_rehearsal::{CaseOutcome, End, EventKind, Verdict};
use wrasse_spatial::Vec3;

/// The page without what browsers do not read as markup: contents of scripts and styles.
fn markup_only(page: &str) -> String {
    let mut markup = String::new();
    let mut rest = page;
    while let Some(at) = ["<script", "<style"].iter().filter_map(|tag| rest.find(tag)).min() {
        let open = at + rest[at..].find('>').unwrap() + 1;
        let close = if rest[at..].starts_with("<script") { "</script>" } else { "</style>" };
        let end = open + rest[open..].find(close).unwrap();
        markup += &rest[..open];
        rest = &rest[end..];
        markup += close;
        rest = &rest[close.len()..];
    }
    (markup + rest).replace("<!DOCTYPE html>", "")
}

/// Every tag is closed, every attribute quoted: the page reads as XML.
#[track_caller]
fn check_well_formed(outcome: &Outcome) -> String {
    let markup = markup_only(&report_html(outcome));
    if let Err(error) = roxmltree::Document::parse(&markup) {
        let line = markup.lines().nth(error.pos().row as usize - 1).unwrap();
        panic!("{error}\n{line}");
    }
    markup
}

#[test]
fn the_page_is_well_formed_for_one_case_and_for_several() {
    check_well_formed(&sample::single());
    check_well_formed(&sample::compared());
}

#[test]
fn names_that_look_like_markup_stay_text() {
    let outcome = sample::hostile();
    let markup = check_well_formed(&outcome);
    let page = roxmltree::Document::parse(&markup).unwrap();
    let scripts = page.descendants().filter(|node| node.has_tag_name("script")).count();
    assert_eq!(scripts, 3, "data, the plot library, the page's own script");
    assert!(page.descendants().all(|node| !node.has_attribute("onclick")));
    assert!(page.descendants().all(|node| !node.has_tag_name("b")));
    let title = page.descendants().find(|node| node.has_tag_name("h1")).unwrap();
    let shown: String = outcome.mission.replace('\u{1b}', "\u{fffd}");
    assert_eq!(title.text(), Some(shown.as_str()));
}

#[test]
fn nothing_in_the_page_is_loaded_from_elsewhere() {
    for outcome in [sample::single(), sample::compared()] {
        let page = report_html(&outcome);
        let licence = "/*! https://github.com/leeoniya/uPlot (v1.6.32) */";
        let rest = page.replacen(licence, "", 1);
        assert_ne!(page, rest, "the licence comment of the plot library stays in the page");
        for sign in ["http://", "https://", "@import", "url(", "src=", "fetch(", "XMLHttpRequest"] {
            assert!(!rest.contains(sign), "the page holds {sign}");
        }
        let markup = markup_only(&page);
        let document = roxmltree::Document::parse(&markup).unwrap();
        for node in document.descendants() {
            let href = node.attribute("href").unwrap_or("#");
            assert!(href.starts_with('#'), "a link leads to {href}");
        }
        assert!(markup.contains("default-src 'none'"));
    }
}

#[test]
fn every_anchor_that_is_linked_to_exists_once() {
    for outcome in [sample::single(), sample::compared(), sample::hostile()] {
        let markup = check_well_formed(&outcome);
        let page = roxmltree::Document::parse(&markup).unwrap();
        let ids: Vec<_> = page.descendants().filter_map(|node| node.attribute("id")).collect();
        for node in page.descendants() {
            if let Some(anchor) = node.attribute("href") {
                let same = ids.iter().filter(|id| **id == &anchor[1..]).count();
                assert_eq!(same, 1, "{anchor}");
            }
        }
    }
}

/// 32-bit floats, little-endian, in base64.
fn singles(text: &str) -> Vec<f32> {
    let bytes = data_encoding::BASE64.decode(text.as_bytes()).unwrap();
    bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect()
}

/// What the page's script draws.
fn plot_data(outcome: &Outcome) -> serde_json::Value {
    let page = report_html(outcome);
    let start = page.find("id=\"plot-data\">").unwrap() + "id=\"plot-data\">".len();
    let json = &page[start..start + page[start..].find("</script>").unwrap()];
    serde_json::from_str(json).unwrap()
}

#[test]
#[allow(clippy::cast_possible_truncation, reason = "the page holds 32-bit numbers")]
fn the_plots_show_the_telemetry() {
    let outcome = sample::single();
    let data = plot_data(&outcome);
    let telemetry = &outcome.cases[0].telemetry;
    let mut lines = 0;
    for plot in data[0]["plots"].as_array().unwrap() {
        assert_eq!(plot["drawn"], telemetry.time.len());
        let time: Vec<f32> = telemetry.time.iter().map(|t| *t as f32).collect();
        assert_eq!(singles(plot["time"].as_str().unwrap()), time);
        for line in plot["lines"].as_array().unwrap() {
            let channel = telemetry.channels.iter().find(|c| line["name"] == c.name).unwrap();
            let values: Vec<f32> = channel.values.iter().map(|v| *v as f32).collect();
            assert_eq!(singles(line["values"].as_str().unwrap()), values);
            assert_eq!(
                (&line["unit"], &plot["title"]),
                (&channel.unit.as_str().into(), &channel.plot.as_str().into())
            );
            lines += 1;
        }
    }
    assert_eq!(lines, telemetry.channels.len());
}

#[test]
fn a_limit_stands_in_the_plot_of_its_quantity_while_it_binds() {
    let mut outcome = sample::single();
    let case = &mut outcome.cases[0];
    case.events.iter_mut().for_each(|e| e.text = e.text.replace(" begins", ""));
    case.events[2].kind = EventKind::Limit;
    let mut limit = |requirement: &str, limit, unit: &str| {
        let verdict = Verdict {
            requirement: requirement.into(),
            limit,
            unit: unit.into(),
            ..case.verdicts[0].clone()
        };
        case.verdicts.push(verdict);
    };
    limit("tool.error.max <= 0.3 mm", 0.3, "mm");
    limit("energy.kinetic.final <= 2 J", 2.0, "J");
    limit("joint.joint2.torque.max <= 5 Nm during reach", 5.0, "Nm");
    limit("energy.power.max <= 2 N", 2.0, "N");
    let data = plot_data(&outcome);
    let plots = data[0]["plots"].as_array().unwrap().iter();
    let limits: Vec<_> = plots.flat_map(|plot| plot["limits"].as_array().unwrap()).collect();
    let told = |text: &str, value: f64, unit: &str, from: f64, to: f64| serde_json::json!({ "text": text, "value": value, "unit": unit, "from": from, "to": to });
    // A length in the unit of its channel; both signs where the channel has both; the end alone for what
    // is judged there; one phase; nothing where the units do not measure the same.
    let wanted = [
        told("max <= 0.3 mm", 0.3 * 1e-3, "m", 0.0, 24.0),
        told("", -0.3 * 1e-3, "m", 0.0, 24.0),
        told("max <= 5 Nm during reach", 5.0, "N·m", 2.0, 22.0),
        told("", -5.0, "N·m", 2.0, 22.0),
        told("final <= 2 J", 2.0, "J", 24.0, 24.0),
    ];
    assert_eq!(limits, wanted.iter().collect::<Vec<_>>());
}

#[test]
fn verdicts_stay_in_sight_while_a_wide_table_scrolls() {
    let page = report_html(&sample::compared());
    assert!(page.contains(".kept { position: sticky; left: 0; right: 0;"));
    let markup = markup_only(&page);
    let document = roxmltree::Document::parse(&markup).unwrap();
    let mut marks = 0;
    for table in document.descendants().filter(|node| node.has_tag_name("table")) {
        let is_mark =
            |n: &roxmltree::Node<'_, '_>| matches!(n.attribute("class"), Some("pass" | "fail"));
        for mark in table.descendants().filter(is_mark) {
            assert_eq!(mark.parent().unwrap().attribute("class"), Some("kept"));
            marks += 1;
        }
    }
    // Nine cases in the table that compares them, five requirements of each.
    assert_eq!(marks, 9 + 9 * 5);
}

#[test]
fn text_is_escaped_once() {
    let mut outcome = sample::single();
    outcome.cases[0].verdicts[0].value = Some(1e-9);
    let markup = check_well_formed(&outcome);
    assert!(markup.contains("> &lt; 0.1 %</td>") && !markup.contains("&amp;lt;"));
}

#[test]
fn drawings_hold_finite_numbers_only() {
    let mut outcome = sample::single();
    let snapshots = &mut outcome.cases[0].snapshots;
    snapshots[3].tool[1] = f64::NAN;
    snapshots[7].boxes[0].corners[2][0] = f64::INFINITY;
    snapshots[9].arms[0][1][2] = 1e300;
    let markup = check_well_formed(&outcome);
    let page = roxmltree::Document::parse(&markup).unwrap();
    let drawings = page.descendants().filter(|node| node.has_tag_name("svg"));
    let mut numbers = 0;
    for node in drawings.flat_map(|svg| svg.descendants()) {
        let names = ["points", "d", "x", "y", "cx", "cy", "width", "height", "viewBox", "opacity"];
        for value in names.iter().filter_map(|name| node.attribute(*name)) {
            let figures = value.split(|c: char| " ,MLHV".contains(c)).filter(|f| !f.is_empty());
            for figure in figures {
                let number: f64 = figure.parse().unwrap();
                assert!((-1e4..1e4).contains(&number), "{value}");
                numbers += 1;
            }
        }
    }
    assert!(numbers > 1000, "{numbers} numbers were looked at");
}

#[test]
fn what_cannot_be_drawn_or_plotted_leaves_a_page_all_the_same() {
    let mut outcome = sample::single();
    let case = &mut outcome.cases[0];
    case.snapshots.clear();
    case.telemetry.channels.clear();
    (case.verdicts, case.events, case.plan) = (vec![], vec![], vec![]);
    let markup = check_well_formed(&outcome);
    assert!(!markup.contains("<svg"));
    outcome.cases.clear();
    assert!(check_well_formed(&outcome).contains("no case was run"));
    assert_eq!(verdict_table(&outcome), "the mission has no cases\n");
}

#[test]
fn of_very_many_events_the_first_are_shown_and_the_rest_is_counted() {
    let mut outcome = sample::single();
    let event = outcome.cases[0].events[0].clone();
    outcome.cases[0].events = vec![event; 5000];
    let markup = check_well_formed(&outcome);
    assert!(markup.contains("the first 400 of 5000"));
    assert_eq!(markup.matches("phase settle begins").count(), 400);
}

#[test]
fn a_run_that_broke_down_leaves_a_page_and_a_table() {
    let mut outcome = sample::single();
    let case = &mut outcome.cases[0];
    case.end = End::Breakdown { time_s: 3.0, reason: "rate of body link2 is NaN".into() };
    case.ledger.residual[2] = f64::NAN;
    case.ledger.end.angular = Vec3::from_array([f64::NAN; 3]);
    case.ledger.closes = false;
    case.verdicts[0].value = Some(f64::INFINITY);
    for channel in &mut case.telemetry.channels {
        channel.values[300..].fill(f64::NAN);
    }
    case.snapshots.iter_mut().skip(3).for_each(|s| s.arms[0][2] = [f64::NAN; 3]);
    let markup = check_well_formed(&outcome);
    assert!(markup.contains("breakdown at 3 s: rate of body link2 is NaN"));
    // Of numbers that broke down there are no books: neither closed nor open.
    assert!(markup.contains("Numbers broke down: there is no ledger"));
    assert!(!markup.contains("stays open"));
    let table = verdict_table(&outcome);
    assert!(table.contains("breakdown at 3 s") && table.contains("there is no ledger"), "{table}");
    assert!(!table.contains("LEDGER OPEN") && !table.contains("ledger closes"), "{table}");
}

#[test]
fn a_page_of_many_long_cases_stays_within_six_megabytes_and_says_what_it_leaves_out() {
    let mut outcome = sample::single();
    let first = outcome.cases.remove(0);
    let numbered =
        |k: usize| CaseOutcome { labels: vec![("row".into(), k.to_string())], ..first.clone() };
    outcome.cases = (0..200).map(numbered).collect();
    let page = report_html(&outcome);
    // Measured 4.87e6 bytes.
    assert!(page.len() < 6_000_000, "{} bytes", page.len());
    assert!(page.contains("of 200 cases are shown closely"), "the page says what it leaves out");
}

#[test]
fn the_same_outcome_gives_the_same_page() {
    assert_eq!(report_html(&sample::compared()), report_html(&sample::compared()));
}
