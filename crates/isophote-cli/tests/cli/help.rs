//! Help, the manual pages and the completions name everything.

use crate::common::Folder;

const COMMANDS: [&str; 12] =
    ["render", "probe", "section", "surface", "grid", "merge", "check", "new", "show", "schema", "completions", "man"];

/// The long options that the help of a command lists.
fn options(folder: &Folder, command: &str) -> Vec<String> {
    let help = folder.ok(&format!("{command} --help")).stdout;
    let is_option = |character: char| character.is_ascii_alphanumeric() || character == '-';
    let lines = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    let names = lines.filter_map(|line| Some(line.split_once("--")?.1.split(|c| !is_option(c)).next()?.to_owned()));
    names.collect()
}

#[test]
fn the_help_lists_every_command_and_the_exit_codes() {
    let folder = Folder::new();
    let help = folder.ok("--help").stdout;
    for command in COMMANDS {
        assert!(help.lines().any(|line| line.trim_start().starts_with(command)), "{command}");
    }
    assert!(help.contains("Exit codes: 0 fine, 1 failed, 2 wrong arguments, 3 invalid scene, 130 interrupted."));
    let expected = "output figure channel lights size samples tolerance filter region colormap range normalize gamma bits isophotes visible-only precision threads resume shard memory lang json quiet help";
    assert_eq!(options(&folder, "render").join(" "), expected);
    assert_eq!(options(&folder, "probe").join(" "), "at pixel angles shape snap explain lang json quiet help");
    assert!(folder.names().is_empty());
}

#[test]
fn the_version_is_the_packages() {
    assert_eq!(Folder::new().ok("--version").stdout, format!("isophote {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn completions_know_every_command_and_option_in_every_shell() {
    let folder = Folder::new();
    let all: Vec<String> = COMMANDS.iter().flat_map(|command| options(&folder, command)).collect();
    assert!(all.len() > 40, "{all:?}");
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.ok(&format!("completions {shell}")).stdout;
        for option in &all {
            let written = if shell == "fish" { format!("-l {option}") } else { format!("--{option}") };
            assert!(script.contains(&written), "{shell}: {option}");
        }
        for word in COMMANDS.iter().chain(&["viridis", "cividis"]) {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    folder.run("completions tcsh").failed(2, &["tcsh", "bash", "zsh", "fish"]);
}

#[test]
fn the_completions_of_bash_are_a_valid_script() {
    let folder = Folder::new();
    folder.write("isophote.bash", folder.ok("completions bash").stdout);
    let bash = std::process::Command::new("bash").arg("-n").arg(folder.path("isophote.bash")).output();
    if let Ok(output) = bash {
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn the_manual_has_a_page_for_the_program_and_for_every_command() {
    let folder = Folder::new();
    let page = folder.ok("man").stdout;
    assert!(page.contains(".TH isophote 1"), "{page}");
    for command in COMMANDS {
        assert!(page.contains(&format!("isophote\\-{command}(1)")), "{command} in\n{page}");
        let page = folder.ok(&format!("man {command}")).stdout;
        for option in options(&folder, command) {
            let written = format!("\\-\\-{}", option.replace('-', "\\-"));
            assert!(page.contains(&written), "{command}: {option}");
        }
    }
    folder.run("man dance").failed(2, &["there is no command `dance`"]);
}
