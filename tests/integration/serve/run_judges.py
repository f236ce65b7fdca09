#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packages of npm judge a server: judge.mjs, judge_foxglove.mjs. run_judges.py PROGRAMS FAKE_NODE WORK"""

import hashlib
import pathlib
import shutil
import subprocess
import sys

import harness
from users_test import Users, user

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from npm_packages import fetch, skip  # noqa: E402

HERE = pathlib.Path(__file__).parent


def main():
    programs, fake_node, work = sys.argv[1:]
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    packages = pathlib.Path(work) / "judges"
    fetch(HERE / "judges", packages)
    setting = harness.Setting(programs, fake_node)
    try:
        setting.start_node()
        token = "sha256:" + hashlib.sha256(harness.TOKEN.encode()).hexdigest()
        users = Users(setting, ana=user("administer", f'token="{token}"'))
        server = setting.start_server("--write", "--users", users.file)
        for judge in ("judge.mjs", "judge_foxglove.mjs"):
            subprocess.run(["node", HERE / judge, packages, f"http://127.0.0.1:{server.port}", setting.node, harness.TOKEN], check=True)
    finally:
        setting.clean()


if __name__ == "__main__":
    main()
