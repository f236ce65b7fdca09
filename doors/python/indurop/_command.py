# SPDX-License-Identifier: Apache-2.0
"""The programs of InduRoP: where they are, and their exit codes as exceptions."""

from __future__ import annotations

import pathlib
import shutil
import subprocess
from typing import Sequence

from indurop._errors import Error, Invalid, NotFound, RolledBack, SystemFailure, Unreachable

# Those of docs/cli.md.
_BY_EXIT_CODE: dict[int, type[Error]] = {2: Invalid, 4: Invalid, 5: RolledBack, 6: Unreachable}


def program(name: str) -> str:
    """Returns the path of a program: of the build folder that this package is in, else of $PATH. Raises NotFound."""
    built = pathlib.Path(__file__).absolute().parents[2] / "bin" / name
    found = str(built) if built.is_file() else shutil.which(name)
    if found is None:
        raise NotFound(f"there is no program {name}: put the folder of the InduRoP programs into PATH")
    return found


def run(words: Sequence[str]) -> str:
    """Runs `indurop` with these words and returns what it prints."""
    done = subprocess.run([program("indurop"), *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise _BY_EXIT_CODE.get(done.returncode, SystemFailure)(done.stderr.strip() or f"exit code {done.returncode}")
    return done.stdout
