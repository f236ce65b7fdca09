#!/usr/bin/env python3
"""Enforces include_rules.txt: the table of which room may know which other one. check_includes.py ROOT"""

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
    "eigen": ("Eigen/",),
    "urdf": ("urdf_parser/", "urdf_model/", "console_bridge/"),
    "kdl": ("kdl/",),
    "gtest": ("gtest/", "gmock/"),
    "benchmark": ("benchmark/",),
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


def groups_of(root, name, quote, target):
    """The words of a rule line that would allow this include."""
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
    if (root / name).parent.joinpath(target).is_file() or (name.startswith(("tests/", "bench/")) and "/" not in target):
        groups.add("own")
    if "/" in target:
        groups.add(target.split("/", 1)[0] + "/")
    return groups


def check(root, rules):
    findings = []
    for name in common.cxx_files(root):
        matching = [folder for folder in rules if name.startswith(folder)]
        if not matching:
            findings.append(f"{name}:1: no line in include_rules.txt covers this folder")
            continue
        allowed = rules[max(matching, key=len)]
        text = common.read(root, name)
        for found in INCLUDE.finditer(text):
            quote, target = found.groups()
            shown = f"<{target}>" if quote == "<" else f'"{target}"'
            forbidden = f"-<{target}>" in allowed
            permitted = f"<{target}>" in allowed or groups_of(root, name, quote, target) & set(allowed)
            if forbidden or not permitted:
                line = text.count("\n", 0, found.start(1)) + 1
                findings.append(f"{name}:{line}: includes {shown}; {max(matching, key=len)} may use: {' '.join(allowed)}")
    return findings


if __name__ == "__main__":
    common.report(check(pathlib.Path(sys.argv[1]), load_rules(pathlib.Path(__file__).with_name("include_rules.txt"))))
