#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The binary interface of libindurop-c.so against the description kept in doors/c/abi: functions may be added, nothing
else may change. `--update` writes the description again, after an addition."""

import argparse
import subprocess
import sys
import tempfile

def describe(options, to):
    """What programs can see: private types are left out, and what differs between two builds."""
    subprocess.run([options.abidw, "--exported-interfaces-only", "--headers-dir", options.headers,
                    "--drop-private-types", "--no-show-locs", "--no-corpus-path", "--no-comp-dir-path", "--short-locs",
                    "--no-elf-needed", "--out-file", to,
                    options.library], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ("abidw", "abidiff", "kept", "headers", "library"):
        parser.add_argument("--" + option, required=True)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    if options.update:
        describe(options, options.kept)
        return
    with tempfile.TemporaryDirectory() as folder:
        now = f"{folder}/now.abi"
        describe(options, now)
        # Of a C interface no change is harmless.
        sys.exit(subprocess.run([options.abidiff, "--harmless", "--no-added-syms", options.kept, now],
                                check=False).returncode)


if __name__ == "__main__":
    main()
