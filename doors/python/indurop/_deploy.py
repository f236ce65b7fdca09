# SPDX-License-Identifier: Apache-2.0
"""Deployments, by the command line: it checks, packs and signs, and its exit codes say how a deployment ended."""

from __future__ import annotations

import json
import os
from typing import Any, Sequence

from indurop._command import run


def deploy(plant: str | os.PathLike[str] = "plant.xml", comment: str = "", *, keys: str | os.PathLike[str] = "",
           timeout: float | None = None, health: float | None = None, arguments: Sequence[str] = ()) -> Any:
    """Deploys a plant or a bundle on all its boards, or changes nothing; returns the report of `indurop deploy -o json`.

    `keys`: folder of the plant's keys or of a deployer. `timeout`: seconds to wait for boards, `health`: seconds for
    which the new deployment is monitored. `arguments`: further options of `indurop deploy`. Raises Invalid (the check
    found errors; its text has them), RolledBack, Unreachable (boards are missing), SystemFailure."""
    words = ["deploy", os.fspath(plant), "-o", "json"]
    for option, value in (("--comment", comment), ("--keys", os.fspath(keys)), ("--timeout", _time(timeout)),
                          ("--health", _time(health))):
        words += [option, value] if value else []
    return json.loads(run([*words, *arguments]))


def _time(seconds: float | None) -> str:
    return "" if seconds is None else f"{round(seconds * 1e9)}ns"
