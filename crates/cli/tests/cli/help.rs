use crate::workplace::Workplace;

#[test]
fn help_reads_as_it_did() {
    let place = Workplace::new();
    let commands = [
        ("sunfleck", "--help"),
        ("render", "render --help"),
        ("info", "info --help"),
        ("list", "list --help"),
        ("diff", "diff --help"),
        ("completions", "completions --help"),
    ];
    for (name, args) in commands {
        let ran = place.run(args);
        assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
        insta::assert_snapshot!(format!("help_{name}"), ran.out);
    }
}

#[test]
fn every_shell_gets_a_completion_script_that_knows_the_commands() {
    let place = Workplace::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = place.run(&format!("completions {shell}"));
        assert_eq!(ran.code, Some(0));
        assert!(ran.out.contains("render") && ran.out.contains("camera-position"), "{shell}");
    }
}
