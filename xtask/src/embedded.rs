//! `cargo xtask embedded`: the control period on a flight processor's instruction set, in an emulator.

mod call_graph;
mod comparison;
mod stack_bound;
pub(crate) mod toolchain;

use crate::tidy::repository_root;
use call_graph::CallGraph;
use comparison::Run;
use std::path::PathBuf;
use std::process::Command;
use toolchain::Toolchain;

/// The symbol that a panic would need and nobody defines.
const PANIC_SYMBOL: &str = "PANIC_PATH_REMAINS";

/// A processor, the precision it runs the period in, and the emulator's board that has it.
struct Processor {
    name: &'static str,
    /// What the host's program calls the precision.
    precision: &'static str,
    board: &'static str,
    rust_flags: &'static str,
    features: &'static str,
}

const PROCESSORS: [Processor; 2] = [
    Processor {
        name: "Cortex-M4F, f32",
        precision: "single",
        board: "mps2-an386",
        rust_flags: "",
        features: "",
    },
    // The emulated Cortex-M7 has double-precision hardware: it runs the `f64` instructions that the
    // compiler gives it.
    Processor {
        name: "Cortex-M7, f64",
        precision: "double",
        board: "mps2-an500",
        rust_flags: " -C target-cpu=cortex-m7",
        features: "double",
    },
];

/// Build, link without a panic, run, compare with the host, print what it takes.
pub(crate) fn embedded(arguments: &[String]) -> Result<(), String> {
    let required = match arguments {
        [] => false,
        [only] if only == "--require" => true,
        _ => return Err("usage: cargo xtask embedded [--require]".to_owned()),
    };
    let toolchain = match Toolchain::find() {
        Ok(toolchain) => toolchain,
        Err(missing) if required => {
            return Err(format!("embedded proof required, but:\n{missing}"));
        }
        Err(missing) => {
            println!("SKIPPED: the embedded proof did not run.\n{missing}");
            return Ok(());
        }
    };
    println!("compiler {}; emulator {}", toolchain.compiler_version, toolchain.emulator_version);
    for processor in &PROCESSORS {
        prove(&toolchain, processor)?;
    }
    single_is_near_double()?;
    planted_panic_does_not_link(&toolchain)
}

fn prove(toolchain: &Toolchain, processor: &Processor) -> Result<(), String> {
    let expected = on_host(processor.precision)?;
    let program = firmware(toolchain, processor)?;
    let told = toolchain.emulate(processor.board, &program)?;
    let (expected, found) = (Run::read(&expected)?, Run::read(&told)?);
    expected.same_bits(&found).map_err(|why| format!("{}: {why}", processor.name))?;
    println!(
        "\n{}: no panic path, same bits as the host in {} periods",
        processor.name,
        found.len()
    );
    found.print();
    println!("{}", stack_bound::of_firmware(&program)?);
    Ok(())
}

/// Print how far `f32` is from `f64`, and refuse it where it is far off in more than a few states.
///
/// 99 of 100 states must be within 1 %; measured 0.31 % at most. The rest is printed and not judged:
/// the worst state is 89 % off, and why is not known. Round-off of 6e-8, multiplied by 1/0.02² = 2,500
/// in the damped inverse, does not explain that much.
fn single_is_near_double() -> Result<(), String> {
    println!(
        "\nf32 against f64, largest torque difference as a share of the state's largest torque"
    );
    for line in on_host("difference")?.lines() {
        let bad = || format!("on_host printed `{line}`, not `arms law worst most`");
        let words: Vec<_> = line.split(' ').collect();
        let [arms, law, worst, most] = words[..] else { return Err(bad()) };
        println!("{arms} {law}: 99 of 100 states below {most}, worst {worst}");
        let near = most.parse::<f64>().map_err(|_| bad())? < 0.01;
        if !near {
            return Err(format!("{arms} {law}: f32 is further than 1 % from f64: {most}"));
        }
    }
    Ok(())
}

/// What the host says of the same periods.
fn on_host(precision: &str) -> Result<String, String> {
    let mut command = Command::new(toolchain::cargo());
    command
        .args(["run", "--release", "--quiet", "-p", "wrasse-golden-periods", "--bin", "on_host"])
        .args(["--", precision])
        .current_dir(folder())
        .env("CARGO_TARGET_DIR", toolchain::target_folder());
    toolchain::output_of(&mut command)
}

/// Build the firmware; its file.
fn firmware(toolchain: &Toolchain, processor: &Processor) -> Result<PathBuf, String> {
    let linked = build(toolchain, processor, processor.features, "");
    linked.map_err(|why| match who_panics(toolchain, processor) {
        Ok(who) if panic_is_undefined(&why) => format!(
            "{}: a panic can be reached, so the firmware does not link. It is called by\n{who}\
             an index that the compiler cannot bound, an unwrap, or a division of integers: let the \
             code say that it cannot happen",
            processor.name
        ),
        Ok(_) => why,
        Err(also) => format!("{why}\nand who calls the panic cannot be said: {also}"),
    })
}

/// Build with these features and linker flags.
fn build(
    toolchain: &Toolchain,
    processor: &Processor,
    features: &str,
    more_flags: &str,
) -> Result<PathBuf, String> {
    let mut command = toolchain.build(&format!("{}{more_flags}", processor.rust_flags));
    command.args(["-p", "wrasse-firmware", "--features", features]).current_dir(folder());
    toolchain::output_of(&mut command)?;
    Ok(toolchain::target_folder().join(toolchain::TARGET).join("firmware").join("firmware"))
}

fn panic_is_undefined(complaint: &str) -> bool {
    complaint.contains(&format!("undefined symbol: {PANIC_SYMBOL}"))
}

/// The functions that would call a panic, one to a line.
fn who_panics(toolchain: &Toolchain, processor: &Processor) -> Result<String, String> {
    let define = format!(" -C link-arg=--defsym={PANIC_SYMBOL}=0");
    let program = build(toolchain, processor, processor.features, &define)?;
    let graph = CallGraph::read(&program)?;
    let names = graph.callers_of("panicking");
    Ok(names.iter().fold(String::new(), |text, name| text + "  " + name + "\n"))
}

/// The proof of the proof: a panic that is really there must be seen by the linker.
fn planted_panic_does_not_link(toolchain: &Toolchain) -> Result<(), String> {
    match build(toolchain, &PROCESSORS[0], "planted-panic", "") {
        Err(why) if panic_is_undefined(&why) => {
            println!("\na panic planted on purpose does not link: the proof can fail");
            Ok(())
        }
        Err(why) => Err(format!("a planted panic failed to build, but for another reason:\n{why}")),
        Ok(_) => Err("a planted panic linked: the absence of panics is not proven".to_owned()),
    }
}

fn folder() -> PathBuf {
    repository_root().join("embedded")
}
