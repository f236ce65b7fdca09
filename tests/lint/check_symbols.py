#!/usr/bin/env python3
"""libindurop.so exports exactly what exported_symbols.txt lists: what it exports is what users' modules can depend on.
A module that comes with the platform installs no signal handler: it would stay when the module is unloaded.
check_symbols.py LIBRARY LIST [--update] | check_symbols.py --module LIBRARY"""

import pathlib
import subprocess
import sys

import common

HEAD = "# Functions and objects that libindurop.so exports. Written by: tests/lint/check_symbols.py LIBRARY LIST --update\n"


def exported(library):
    lines = subprocess.run(["nm", "-D", "-C", "--defined-only", library], capture_output=True, text=True,
                           check=True).stdout.splitlines()
    # Type information and tables of our exception classes come with the classes; std:: instantiations are not ours.
    names = {line.split(" ", 2)[2] for line in lines if line.split(" ", 2)[1] in "TDBRVWu"}
    return {name for name in names if "std::" not in name.split("(")[0] and not name.startswith("__")}


def check(library, listing):
    wanted = {line for line in pathlib.Path(listing).read_text().splitlines() if line and not line.startswith("#")}
    found = exported(library)
    return ([f"{listing}: exported but not listed: {name}" for name in sorted(found - wanted)]
            + [f"{listing}: listed but no longer exported: {name}" for name in sorted(wanted - found)])


def handlers(module):
    lines = subprocess.run(["nm", "-D", "--undefined-only", module], capture_output=True, text=True, check=True).stdout.splitlines()
    names = {line.split()[-1].split("@")[0] for line in lines}
    return [f"{module}: imports {name}: its handler would outlive the module" for name in sorted(names & {"sigaction", "signal"})]


if __name__ == "__main__":
    if sys.argv[1] == "--module":
        common.report(handlers(sys.argv[2]))
    if "--update" in sys.argv:
        pathlib.Path(sys.argv[2]).write_text(HEAD + "".join(name + "\n" for name in sorted(exported(sys.argv[1]))))
    common.report(check(sys.argv[1], sys.argv[2]))
