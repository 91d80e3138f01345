//! A sweep is the same in one go or in many, by one thread or by several.

use std::fs;
use std::path::Path;
use wrasse_mission::{Mission, read_mission};
use wrasse_sweep::{OwnedFolder, PassRate, Row, Sweep, SweepError, SweepOutcome};
use wrasse_testing::{Page, larger};

/// Short, with two laws to compare, a payload that is not known, and a requirement that some fail.
const MISSION: &str = r#"
name = "quick"
vehicle = "atlas-class"
requirements = ["tool.position_error.max <= 0.026 mm", "joints.effort_use.max <= 100 %"]

[initial]
posture = "sideways_300mm"

[payload.module]
mass_kg = 200.0
uniform_box_m = [1.0, 1.0, 1.0]
held_by = "tool"

[world]
base_attitude = "controlled"
joints = "torque"

[control]
arm_law = "attitude-held"

[[phase]]
name = "reach"
move_tool = { by_m = [0.0, 0.02, 0.0], duration_s = 1.0 }

[[disperse]]
quantity = "payload.module.mass_kg"
sigma = 10.0
within = 30.0

[[disperse]]
quantity = "payload.module.centre_of_mass_m"
sigma = 0.02

[[compare]]
axis = "feedforward"

[[compare.row]]
name = "exact"

[[compare.row]]
name = "none"
set.control.feedforward = "none"
"#;

fn mission(text: &str) -> Mission {
    read_mission("quick.toml", text).unwrap_or_else(|complaints| {
        panic!("{}", wrasse_document::render(&complaints, false));
    })
}

/// A sweep in a folder that is taken for it.
fn sweep(
    asked: &Sweep<'_>,
    folder: &Path,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<SweepOutcome, SweepError> {
    wrasse_sweep::sweep(asked, &OwnedFolder::take(folder)?, progress)
}

/// All rows of a sweep of this many samples.
#[track_caller]
fn rows(mission: &Mission, samples: u64, threads: usize, folder: &Path) -> Vec<Vec<Row>> {
    let asked = Sweep { mission, samples, seed: 11, threads };
    let outcome = sweep(&asked, folder, &mut |_, _| {}).expect("it is flown");
    outcome.cases.into_iter().map(|case| case.rows).collect()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder for the samples")
}

fn parts(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut parts: Vec<_> = entries.map(|e| e.expect("an entry").path()).collect();
    parts.retain(|path| path.extension().is_some_and(|ending| ending == "jsonl"));
    parts.sort();
    parts
}

#[test]
fn threads_and_interruptions_change_no_bit() {
    let mission = mission(MISSION);
    let whole = rows(&mission, 20, 1, folder().path());
    assert_eq!(whole.iter().map(Vec::len).collect::<Vec<_>>(), [20, 20]);
    assert!(whole[0].iter().enumerate().all(|(k, row)| row.sample == k as u64));

    let place = folder();
    assert_eq!(rows(&mission, 20, 3, place.path()), whole);

    // What an interruption leaves: some parts, and one that was not finished.
    let all = parts(place.path());
    assert_eq!(all.len(), 6, "{all:?}");
    let kept = fs::read(&all[0]).expect("a part");
    for part in all.iter().skip(1).step_by(2) {
        fs::remove_file(part).expect("it was there");
    }
    let torn = all[1].file_name().expect("it has a name").to_string_lossy().into_owned();
    fs::write(place.path().join(format!(".{torn}.1")), &kept[..kept.len() / 2]).expect("room");
    let mut flown = vec![];
    let asked = Sweep { mission: &mission, samples: 20, seed: 11, threads: 2 };
    let outcome = sweep(&asked, place.path(), &mut |done, of| flown.push((done, of)));
    let again: Vec<_> =
        outcome.expect("it goes on").cases.into_iter().map(|case| case.rows).collect();
    assert_eq!(again, whole);
    assert!(flown[0].0 >= 16 && flown[0].0 < 40, "it began with what was there: {flown:?}");
    assert_eq!(flown.last(), Some(&(40, 40)));
}

#[test]
fn a_larger_sweep_begins_with_the_samples_of_a_smaller_one() {
    let (mission, place) = (mission(MISSION), folder());
    let few = rows(&mission, 3, 1, place.path());
    let many = rows(&mission, 12, 2, place.path());
    assert_eq!(many[0].len(), 12);
    assert_eq!(many[1][..3], few[1]);
    assert_eq!(rows(&mission, 3, 1, place.path()), few, "and the smaller one is still there");
}

#[test]
fn cases_fly_the_same_draws_and_the_findings_are_those_of_the_rows() {
    let mission = mission(MISSION);
    let asked = Sweep { mission: &mission, samples: 16, seed: 11, threads: 2 };
    let outcome = sweep(&asked, folder().path(), &mut |_, _| {}).expect("it is flown");
    let [exact, none] = &outcome.cases[..] else { panic!("two cases") };
    for (a, b) in exact.rows.iter().zip(&none.rows) {
        assert_eq!(a.deviations, b.deviations);
        assert_ne!(a.values, b.values);
    }
    let error = &exact.requirements[0];
    let values: Vec<f64> = exact.rows.iter().filter_map(|row| row.values[0]).collect();
    let most = values.iter().copied().reduce(larger);
    assert_eq!(error.values.map(|values| values.max), most);
    assert_eq!(error.worst[0].value, most);
    assert_eq!(error.worst.len(), 5);
    let worst = error.worst[0].sample;
    assert_eq!(error.worst[0].command, format!("wrasse run quick.toml --sample {worst} --seed 11"));
    assert_eq!(error.holds.passed, values.iter().filter(|x| **x <= 0.026).count());
    assert!(
        error.holds.passed > 0 && error.holds.passed < 16,
        "some fail: {:?} {:?}",
        error.holds,
        error.values
    );
    let ([low, high], share) = (error.holds.interval.expect("it varies"), error.holds.share());
    assert!(low < share && share < high);
    assert_eq!(exact.ends.len(), 1);
    assert_eq!((exact.ends[0].end.as_str(), exact.ends[0].count), ("completed", 16));
    assert!(error.influences.iter().all(|i| i.rank_correlation.abs() > 3.0 / 15.0_f64.sqrt()));
}

#[test]
fn samples_of_another_seed_or_mission_are_not_mixed_in() {
    let (first, place) = (mission(MISSION), folder());
    rows(&first, 2, 1, place.path());
    let refused = |mission: &Mission, seed: u64| {
        let asked = Sweep { mission, samples: 2, seed, threads: 1 };
        let error = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("it is another sweep");
        assert!(matches!(error, SweepError::OtherSweep { .. }));
        error.to_string()
    };
    assert!(refused(&first, 12).contains("its seed is 11, here it is 12"));
    let heavier = mission(&MISSION.replace("sigma = 10.0", "sigma = 10.1"));
    assert!(refused(&heavier, 11).contains("its fingerprint is"));
    // Words change nothing of what is flown.
    let retold = mission(&MISSION.replace("name = \"quick\"", "# told anew\nname = \"quick\""));
    rows(&retold, 2, 1, place.path());
}

#[test]
fn a_damaged_part_is_told_with_its_name() {
    let (mission, place) = (mission(MISSION), folder());
    rows(&mission, 2, 1, place.path());
    let part = &parts(place.path())[0];
    let whole = fs::read_to_string(part).expect("a part");
    let torn = whole[..whole.len() / 2].to_owned();
    let short = whole.replacen("\"holds\":[true,", "\"holds\":[", 1);
    let short = short.replacen("\"holds\":[false,", "\"holds\":[", 1);
    assert_ne!(short, whole);
    for text in [torn, short] {
        fs::write(part, text).expect("room");
        let asked = Sweep { mission: &mission, samples: 2, seed: 11, threads: 1 };
        let told = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("damaged").to_string();
        assert!(told.contains(&part.display().to_string()) && told.contains("remove it"), "{told}");
    }
}

#[test]
fn a_folder_has_one_owner_at_a_time_and_what_a_killed_one_leaves_holds_nobody_up() {
    let (mission, place) = (mission(MISSION), folder());
    let owned = OwnedFolder::take(place.path()).expect("it is free");
    let told = OwnedFolder::take(place.path()).expect_err("it is taken");
    assert!(matches!(told, SweepError::InUse { .. }));
    assert!(told.to_string().contains("another sweep is being flown in"), "{told}");
    drop(owned);
    // The file of the lock is still there, and so is what was half written.
    let half = place.path().join(".case-0-000000000-000000007.jsonl.4711");
    fs::write(&half, "{").expect("room");
    assert_eq!(rows(&mission, 2, 1, place.path())[0].len(), 2);
    assert!(place.path().join(".lock").exists() && !half.exists());
}

#[test]
fn a_part_of_another_sweep_is_told_with_its_name_whatever_the_manifest_says() {
    let (first, place, elsewhere) = (mission(MISSION), folder(), folder());
    rows(&first, 2, 1, place.path());
    let heavier = mission(&MISSION.replace("sigma = 10.0", "sigma = 10.1"));
    rows(&heavier, 2, 1, elsewhere.path());
    let stranger = place.path().join("case-0-000000004-000000005.jsonl");
    fs::copy(&parts(elsewhere.path())[0], &stranger).expect("room");
    let asked = |mission, seed| {
        let asked = Sweep { mission, samples: 2, seed, threads: 1 };
        sweep(&asked, place.path(), &mut |_, _| {}).expect_err("it is another sweep").to_string()
    };
    let told = asked(&first, 11);
    assert!(told.contains(&stranger.display().to_string()), "{told}");
    assert!(told.contains("its fingerprint is"), "{told}");
    fs::remove_file(&stranger).expect("it is there");
    // Without a manifest each part still says what it is of.
    fs::remove_file(place.path().join("manifest.json")).expect("it is there");
    let told = asked(&first, 12);
    assert!(told.contains("case-0") && told.contains("its seed is 11, here it is 12"), "{told}");
}

#[test]
fn a_manifest_that_is_damaged_may_be_removed_and_the_parts_are_judged_by_themselves() {
    let (first, place) = (mission(MISSION), folder());
    let whole = rows(&first, 2, 1, place.path());
    let manifest = place.path().join("manifest.json");
    fs::write(&manifest, "{").expect("room");
    let asked = Sweep { mission: &first, samples: 2, seed: 11, threads: 1 };
    let told = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("damaged").to_string();
    assert!(told.contains("each part says itself which sweep it is of"), "{told}");
    fs::remove_file(&manifest).expect("it is there");
    assert_eq!(rows(&first, 2, 1, place.path()), whole);
}

/// Each in a way of its own: one sign, a line less, a tail cut off, something that is no text.
#[test]
fn every_change_of_a_part_is_noticed_and_removing_it_flies_it_again() {
    let (mission, place) = (mission(MISSION), folder());
    let whole = rows(&mission, 2, 1, place.path());
    let part = &parts(place.path())[0];
    let kept = fs::read(part).expect("a part");
    let text = String::from_utf8(kept.clone()).expect("it is text");
    let lines: Vec<&str> = text.lines().collect();
    let altered = text.replacen("\"deviations\":[", "\"deviations\":[0", 1);
    let mut noise = kept.clone();
    let middle = noise.len() / 2;
    noise[middle] = 0xff;
    let less = lines[..lines.len() - 1].join("\n") + "\n";
    for changed in [altered.into_bytes(), less.into_bytes(), kept[..40].to_vec(), noise, vec![]] {
        assert_ne!(changed, kept);
        fs::write(part, &changed).expect("room");
        let asked = Sweep { mission: &mission, samples: 2, seed: 11, threads: 1 };
        let told = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("damaged").to_string();
        assert!(told.contains(&part.display().to_string()) && told.contains("remove it"), "{told}");
    }
    fs::remove_file(part).expect("it is there");
    assert_eq!(rows(&mission, 2, 1, place.path()), whole);
}

/// A pipe would be waited for without an end.
#[cfg(unix)]
#[test]
fn a_part_that_is_no_file_is_told_and_not_waited_for() {
    let (mission, place) = (mission(MISSION), folder());
    let pipe = place.path().join("case-0-000000000-000000007.jsonl");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is there");
    assert!(made.success());
    let asked = Sweep { mission: &mission, samples: 2, seed: 11, threads: 1 };
    let told = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("no file").to_string();
    assert!(told.contains(&pipe.display().to_string()), "{told}");
}

/// Nothing drawn; a draw of a sensor that is not used; one too small to make another number.
#[test]
fn a_sweep_that_draws_nothing_is_refused() {
    let nothing = &MISSION[..MISSION.find("[[disperse]]").expect("it disperses")];
    let sensors = "[sensors]\nencoder_step_deg = 0.001\nsource.assumed = \"some\"\n\n";
    let perfect = nothing.replace("arm_law", "sensing = \"perfect\"\narm_law");
    let disperse = |quantity: &str, sigma: &str| {
        format!("[[disperse]]\nquantity = \"{quantity}\"\nsigma = {sigma}\nwithin = {sigma}\n")
    };
    let unused = format!("{perfect}{sensors}{}", disperse("sensors.encoder_step_percent", "10.0"));
    let tiny = format!("{nothing}{}", disperse("payload.module.mass_kg", "1e-30"));
    for text in [nothing, &unused, &tiny] {
        let (mission, place) = (mission(text), folder());
        let asked = Sweep { mission: &mission, samples: 300, seed: 11, threads: 1 };
        let told = sweep(&asked, place.path(), &mut |_, _| {}).expect_err("nothing is drawn");
        assert!(matches!(told, SweepError::NothingDrawn { .. }), "{told}");
        assert!(told.to_string().contains("[[disperse]]"), "{told}");
        assert!(parts(place.path()).is_empty());
    }
}

/// One case flies with the encoder that is drawn, the other with perfect sensors.
#[test]
fn a_case_in_which_nothing_varies_has_no_interval_beside_one_in_which_it_does() {
    let start = MISSION.find("[[disperse]]").expect("it disperses");
    let text = format!(
        "{}[sensors]\nencoder_step_deg = 0.001\nsource.assumed = \"some\"\n\n[[disperse]]\nquantity = \
         \"sensors.encoder_step_percent\"\nsigma = 10.0\nwithin = 30.0\n\n[[compare]]\naxis = \
         \"sensing\"\n\n[[compare.row]]\nname = \"as fitted\"\n\n[[compare.row]]\nname = \
         \"perfect\"\nset.control.sensing = \"perfect\"\n",
        &MISSION[..start]
    );
    let (mission, place) = (mission(&text), folder());
    let asked = Sweep { mission: &mission, samples: 8, seed: 11, threads: 2 };
    let outcome = sweep(&asked, place.path(), &mut |_, _| {}).expect("it is flown");
    let [fitted, perfect] = &outcome.cases[..] else { panic!("two cases") };
    assert!(fitted.varies && fitted.passed.interval.is_some());
    assert!(!perfect.varies && perfect.passed.interval.is_none());
    assert!(perfect.requirements.iter().all(|r| r.holds.interval.is_none()));
    assert_eq!(perfect.passed.sure, perfect.passed.share());
}

#[test]
fn the_values_flown_stand_beside_their_deviations() {
    let mission = mission(MISSION);
    let asked = Sweep { mission: &mission, samples: 8, seed: 11, threads: 1 };
    let outcome = sweep(&asked, folder().path(), &mut |_, _| {}).expect("it is flown");
    let case = &outcome.cases[0];
    let mass = &case.drawn[0];
    assert_eq!((mass.quantity.as_str(), mass.unit.as_str()), ("payload.module.mass_kg", "kg"));
    assert_eq!(mass.nominal, 200.0);
    let flown = case.rows.iter().map(|row| 200.0 + row.deviations[0]);
    assert_eq!(mass.largest, flown.reduce(larger));
    let worst = &case.requirements[0].worst[0];
    let row = case.rows.iter().find(|row| row.sample == worst.sample).expect("it was flown");
    assert_eq!(worst.drawn[0].flown, 200.0 + row.deviations[0]);
    assert_eq!(worst.drawn[0].deviation, row.deviations[0]);
}

#[test]
fn the_guide_says_how_many_samples_show_a_pass_rate() {
    let sure = |of: usize| PassRate::of(of, of).sure;
    // The fewest that reach it.
    assert!(sure(367) < 0.99 && sure(368) >= 0.99);
    let mut page = Page::open("book/src/guide/sweeps.md");
    page.says("All of 300 samples passing shows {}; all of 368 shows {}.", &[sure(300), sure(368)]);
    page.holds();
}
