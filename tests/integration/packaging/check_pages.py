#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# check_pages.py SOURCE PROGRAMS PAGES [--fix] NAME...: every verb and option that --help names is in the man page, in
# the completion of each shell and in docs/options.md; troff finds nothing wrong; bash completes. --fix writes the docs.
import pathlib
import re
import shutil
import subprocess
import sys

HEADING = """# All verbs and options

Made by the programs from what they accept (`--help-format markdown`); a test compares. What the verbs are for and
what they print: [cli.md](cli.md).

"""
problems = []


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout


def options_in(help_text):
    found = set()
    for line in help_text.splitlines():
        match = re.match(r"  (-\w,)?(--[a-z0-9-]+)", line)
        if match:
            found.add(match.group(2))
    return found


def expect(known, what):
    if not known:
        problems.append(what)


def verbs_of(program):
    return re.findall(r"^  ([a-z]+) +[A-Z]", output(program, "help"), re.MULTILINE)


def sub_verbs(help_text):
    below = help_text.partition("Subcommands:")[2]
    return re.findall(r"^  ([a-z]+) +[A-Z]", below, re.MULTILINE)


def check_texts(name, helps, texts):
    for words, help_text in helps.items():
        for option in options_in(help_text):
            for where, text in texts.items():
                plain = option[2:] if where == "fish" else option
                expect(plain in text, f"{name} {words}: {option} is not in {where}")
        for word in words.split():
            for where, text in texts.items():
                expect(word in text, f"{name}: the verb {word} is not in {where}")


def check_troff(page):
    if shutil.which("groff"):
        run = subprocess.run(["groff", "-man", "-Tutf8", "-ww", page], capture_output=True, text=True, check=False)
        expect(run.returncode == 0 and not run.stderr, f"{page}: {run.stderr}")


def completed(pages, programs, line):
    words = line.split(" ")
    script = (f"PATH={programs}:$PATH; source {pages}/bash/{words[0]}; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); "
              f"_{words[0].replace('-', '_')}; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
    return output("bash", "-c", script, "bash", *words).split()


def check_bash(pages, programs):
    for line, wanted in {
        "indurop ge": ["get"],
        "indurop get --no": ["--node"],
        "indurop jitter --quantity l": ["latency"],
        "indurop get -o ": ["table", "json", "csv"],
        "indurop plc w": ["watch"],
        "indurop plc build --only": ["--only-sources"],
        "indurop keys re": ["renew", "revoke"],
        "indurop help ty": ["typeof"],
        "indurop-node --adj": ["--adjust"],
        "glb2idl --dep": ["--depfile"],
    }.items():
        got = completed(pages, programs, line)
        expect(got == wanted, f"bash completes '{line}' with {got}, not {wanted}")


def main():
    fix = "--fix" in sys.argv
    source, programs, pages, *others = [word for word in sys.argv[1:] if word != "--fix"]
    programs = pathlib.Path(programs)
    pages = pathlib.Path(pages)
    docs = pathlib.Path(source, "docs/options.md")
    made = HEADING
    guide = pathlib.Path(source, "docs/cli.md").read_text(encoding="utf-8")
    for name in ["indurop", *others]:
        program = str(programs / name)
        reference = output(program, "--help-format", "markdown")
        made += reference
        texts = {form: (pages / file).read_text(encoding="utf-8").replace("\\-", "-") for form, file in {
            "man": f"man1/{name}.1", "bash": f"bash/{name}", "zsh": f"zsh/_{name}", "fish": f"fish/{name}.fish"}.items()}
        texts["docs/options.md"] = reference
        helps = {"": output(program, "--help")}
        if name == "indurop":
            helps = {}
            for verb in verbs_of(program):
                helps[verb] = output(program, verb, "--help")
                expect(f"`{verb}`" in guide, f"docs/cli.md does not name the verb {verb}")
                for sub in sub_verbs(helps[verb]):
                    helps[f"{verb} {sub}"] = output(program, verb, sub, "--help")
            expect(len(helps) > 35, f"only {len(helps)} verbs were found")
        check_texts(name, helps, texts)
        check_troff(str(pages / f"man1/{name}.1"))
    check_troff(str(pages / "man1/indurop-lab.1"))
    made = made.rstrip("\n") + "\n"
    if fix:
        docs.write_text(made, encoding="utf-8")
    expect(docs.exists() and docs.read_text(encoding="utf-8") == made,
           "docs/options.md is not what the programs say; run this with --fix")
    check_bash(pages, programs)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


sys.exit(main())
