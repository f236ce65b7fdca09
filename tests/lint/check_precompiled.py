#!/usr/bin/env python3
"""The build reads common headers precompiled, so a file could do without naming them: what it uses of them must be included,
directly or by a header of ours that it includes. check_precompiled.py ROOT"""

import os
import pathlib
import re
import sys

import common

# What the build precompiles (cmake/IndurOptions.cmake), and what can be seen of its use.
PRECOMPILED = {
    "algorithm": r"std::(ranges::)?((stable_)?sort|find(_if)?|(any|all|none)_of|clamp|transform|copy|count(_if)?|reverse|"
                 r"remove_if|(lower|upper)_bound|equal|fill)\(",
    "array": r"std::array<", "charconv": r"std::(from|to)_chars\(", "chrono": r"std::chrono::", "functional": r"std::function<",
    "map": r"std::(multi)?map<", "memory": r"std::(unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared)<",
    "optional": r"std::(optional<|nullopt)", "span": r"std::span<", "string": r"std::(string\b|to_string\()",
    "string_view": r"std::string_view", "unordered_map": r"std::unordered_map<", "variant": r"std::(variant<|visit\()",
    "vector": r"std::vector<", "fmt/format.h": r"\bfmt::"}
# Standard headers that promise the one used.
ALSO = {"string_view": {"string"}, "fmt/format.h": {"fmt/core.h", "fmt/chrono.h", "fmt/ranges.h", "fmt/color.h", "fmt/ostream.h"}}


def includes_of(root, name, known):
    """All that a file includes, directly or by headers of ours."""
    if name not in known:
        known[name] = set()  # a circle ends here; circles are another lint's
        for target in common.INCLUDE.findall((root / name).read_bytes()):
            target = target.decode()
            known[name].add(target)
            for path in (root / target, root / "include" / target, root / "tests/support" / target, (root / name).parent / target):
                if path.is_file():
                    known[name] |= includes_of(root, os.path.relpath(path, root), known)
                    break
    return known[name]


def check(root):
    """Uses of precompiled headers in files that would not compile without them being precompiled."""
    root = pathlib.Path(root)
    known = {}
    findings = []
    for name in common.cxx_files(root):
        if name.startswith(("examples/", "docs/")):
            continue
        code = re.sub(r'//.*|"(?:[^"\\\n]|\\.)*"', "", common.read(root, name))
        for header, use in PRECOMPILED.items():
            found = re.search(use, code)
            if found and not ({header} | ALSO.get(header, set())) & includes_of(root, name, known):
                findings.append(f"{name}: uses {found.group(0).rstrip('<(')} but does not include <{header}>")
    return findings


if __name__ == "__main__":
    common.report(check(sys.argv[1]))
