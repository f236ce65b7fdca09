#!/usr/bin/env python3
"""Enforces include_rules.txt: the table of which room may know which other one. check_includes.py ROOT [--table|--write]
--table prints the same as the table of docs/architecture.md, which has to agree with it; --write puts it there."""

import pathlib
import re
import sys

import common

THIRD_PARTY = {
    "fmt": ("fmt/",),
    "json": ("nlohmann/",),
    "cli": ("CLI/",),
    "xml": ("tinyxml2.h", "libxml/", "expat.h", "pugixml.hpp"),
    "iceoryx": ("iceoryx_hoofs/", "iceoryx_posh/", "iceoryx_binding_c/"),
    "fastdds": ("fastdds/", "fastrtps/", "fastcdr/"),
    "dds": ("dds/", "ddsc/", "dds.h", "idl/", "org/eclipse/cyclonedds/"),
    "openssl": ("openssl/",),
    "modbus": ("modbus/",),
    "curses": ("curses.h",),
    "archive": ("archive.h", "archive_entry.h"),
    "zstd": ("zstd.h",),
    "lz4": ("lz4frame.h",),
    "eigen": ("Eigen/",),
    "urdf": ("urdf_parser/", "urdf_model/", "console_bridge/"),
    "kdl": ("kdl/",),
    "fcl": ("fcl/",),
    "ompl": ("ompl/",),
    "assimp": ("assimp/",),
    "gtest": ("gtest/", "gmock/"),
    "mosquitto": ("mosquitto.h",),
    "benchmark": ("benchmark/",),
    "ros": ("ros/", "std_msgs/", "std_srvs/", "sensor_msgs/", "trajectory_msgs/", "control_msgs/", "actionlib/", "topic_tools/"),
}
POSIX_FOLDERS = ("sys/", "linux/", "net/", "netinet/", "arpa/", "asm/", "bits/", "valgrind/", "sanitizer/")
INCLUDE = re.compile(r'^\s*#\s*include(?:_next)?\s*([<"])([^">]+)[">]', re.MULTILINE)


def load_rules(file):
    rules = {}
    for line in file.read_text().splitlines():
        line = line.split("#", 1)[0].strip()
        if line:
            folder, words = line.split(":", 1)
            rules[folder.strip()] = words.split()
    return rules


TABLE_DOCUMENT = "docs/architecture.md"
TABLE_MARKS = re.compile(r"<!-- rooms -->\n(.*?)<!-- /rooms -->\n", re.DOTALL)
EVERYWHERE = {"std", "posix", "public", "own", "program"}


def table(root, file, rules):
    """The rooms with a job, in the order of the file, as Markdown."""
    lines = ["| room | job | may include, in addition to the standard library and `<indurop/...>` |", "|---|---|---|"]
    for folder, job in re.findall(r"^# ([\w/]+/): (.+)$", file.read_text(), re.MULTILINE):
        shown = f"`{folder}`"
        if (root / folder / "README.md").is_file():
            shown = f"[{shown}](../{folder}README.md)"
        known = [word for word in rules[folder] if word not in EVERYWHERE and word != folder and word[0] != "-"]
        lines.append(f"| {shown} | {job} | {' '.join(word.strip('<>') for word in known) or '-'} |")
    return "\n".join(lines) + "\n"


def check_table(root, file, rules):
    found = TABLE_MARKS.search(common.read(root, TABLE_DOCUMENT))
    if found and found.group(1) == table(root, file, rules):
        return []
    return [f"{TABLE_DOCUMENT}:1: its table between the marks `rooms` is not the one made of include_rules.txt; "
            "`tests/lint/check_includes.py . --write` makes it"]


def groups_of(root, name, quote, target):
    """The words of a rule line that would allow this include."""
    if target.startswith("indurop/idl/"):  # generated from idl/: the rules permit DDS types header by header
        return set()
    if target.startswith("indurop/"):
        return {"public"}
    for group, prefixes in THIRD_PARTY.items():
        if target.startswith(prefixes) and (quote == "<" or not (root / target).exists()):
            return {group}
    if quote == "<":
        if "/" not in target:
            return {"posix" if target.endswith(".h") else "std"}
        return {"posix"} if target.startswith(POSIX_FOLDERS) else set()
    groups = set()
    if ".." in target.split("/"):
        return groups
    # Suites share helpers and generate headers; a name without a folder cannot be a room's.
    if (root / name).parent.joinpath(target).is_file() or (name.startswith("tests/") and "/" not in target):
        groups.add("own")
    folders = target.split("/")[:-1]  # "config/check/uses.h": who may include config/ or only config/check/
    groups.update("/".join(folders[:count]) + "/" for count in range(1, len(folders) + 1))
    return groups


def inside_of_program(rules, name, target):
    """The program into which this include reaches from another room: what two programs need is a library of its own."""
    programs = [folder for folder, words in rules.items() if "program" in words]
    return next((folder for folder in programs if target.startswith(folder) and not name.startswith((folder, "tests/"))), None)


def check(root, rules):
    findings = []
    used = {folder: set() for folder in rules}
    for name in common.cxx_files(root):
        matching = [folder for folder in rules if name.startswith(folder)]
        if not matching:
            findings.append(f"{name}:1: no line in include_rules.txt covers this folder")
            continue
        folder = max(matching, key=len)
        allowed = rules[folder]
        text = common.read(root, name)
        for found in INCLUDE.finditer(text):
            quote, target = found.groups()
            shown = f"<{target}>" if quote == "<" else f'"{target}"'
            program = inside_of_program(rules, name, target)
            if program and quote == '"':
                line = text.count("\n", 0, found.start(1)) + 1
                findings.append(f"{name}:{line}: includes {shown} of the program {program}; move what both need to a library")
                continue
            forbidden = f"-<{target}>" in allowed
            words = groups_of(root, name, quote, target) | {f"<{target}>"}
            permitted = words & set(allowed)
            for each in matching:  # the line of a room is the sum of the lines inside it
                used[each] |= words & set(rules[each])
            if forbidden or not permitted:
                line = text.count("\n", 0, found.start(1)) + 1
                findings.append(f"{name}:{line}: includes {shown}; {folder} may use: {' '.join(allowed)}")
    return findings, used


def unused(rules, used):
    """Permissions that no file makes use of. What every room may have (the ground floor too) is not counted."""
    return [f"include_rules.txt: {folder} may include {word} and no file does; take the word away"
            for folder, allowed in rules.items() for word in allowed
            if word not in used[folder] and word not in EVERYWHERE | {"core/base/", folder} and word[0] != "-"]


def main():
    root = pathlib.Path(sys.argv[1])
    file = pathlib.Path(__file__).with_name("include_rules.txt")
    rules = load_rules(file)
    if sys.argv[2:] == ["--table"]:
        print(table(root, file, rules), end="")
    elif sys.argv[2:] == ["--write"]:
        text = TABLE_MARKS.sub(lambda _: f"<!-- rooms -->\n{table(root, file, rules)}<!-- /rooms -->\n",
                               common.read(root, TABLE_DOCUMENT))
        (root / TABLE_DOCUMENT).write_text(text)
    else:
        findings, used = check(root, rules)
        common.report(findings + unused(rules, used) + check_table(root, file, rules))


if __name__ == "__main__":
    main()
