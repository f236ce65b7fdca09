#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs and libraries in Debian packages are for the architecture that the packages say.
check_architecture.py ARCHITECTURE PACKAGE.deb...: each is for it, or for all and then without such files."""

import subprocess
import sys
import tarfile

MACHINES = {"amd64": 62, "arm64": 183}  # e_machine of ELF


def machine(file):
    """What an ELF file is for; None: it is not one. All of ours have the least byte first."""
    head = file.read(20)
    return int.from_bytes(head[18:20], "little") if head.startswith(b"\x7fELF") else None


def check(package, architecture):
    """How many ELF files it has, and what is wrong."""
    said = subprocess.run(["dpkg-deb", "-f", package, "Architecture"], capture_output=True, text=True, check=True).stdout.strip()
    if said not in (architecture, "all"):
        return 0, [f"{package}: error: is for {said}, not for {architecture}"]
    count, wrong = 0, []
    with subprocess.Popen(["dpkg-deb", "--fsys-tarfile", package], stdout=subprocess.PIPE) as unpacked:
        with tarfile.open(fileobj=unpacked.stdout, mode="r|") as files:
            for entry in files:
                found = machine(files.extractfile(entry)) if entry.isfile() else None
                count += found is not None
                if found is not None and found != MACHINES.get(said):
                    wrong.append(f"{package}: error: {entry.name} is for machine {found} of ELF, and the package for {said}")
    return count, wrong


def main():
    architecture, *packages = sys.argv[1:]
    wrong, count = [], 0
    for package in packages:
        found, faults = check(package, architecture)
        count += found
        wrong += faults
    print("\n".join([*wrong, f"{architecture}: {count} programs and libraries in {len(packages)} packages"]))
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main())
