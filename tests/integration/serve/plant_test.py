#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before a plant: boards are heard, die, and come back. plant_test.py PROGRAMS FAKE_NODE [TEST...]"""

import fcntl
import os
import pathlib
import signal

import harness
from harness import wait_for

API = "/api/v1"


def take_domain(setting):
    """A DDS domain that no other test of this build has: tests/support/dds_domain.h."""
    folder = pathlib.Path(setting.fake_node).parent / "domains"
    folder.mkdir(exist_ok=True)
    for i in range(200):
        domain = 1 + (os.getpid() + i) % 200
        file = open(folder / str(domain), "w", encoding="ascii")  # stays open, and with it the lock
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            file.close()
            continue
        setting.domain_file = file
        return domain
    raise AssertionError("no DDS domain is free")


def start_agent(setting, board, domain):
    return setting.start(setting.programs / "indurop-agent", "--board", board, "--domain", domain, "--one-host", "-q")


def names(answer):
    return {one["board"]: one["heard"] for one in answer["boards"]}


def test_shows_boards_and_reports_those_that_die(setting):
    domain = take_domain(setting)
    left, right = (f"{setting.node}_{side}" for side in ("left", "right"))
    start_agent(setting, left, domain)
    dying = start_agent(setting, right, domain)
    server = setting.start_server("--plant", "--domain", domain, "--one-host")
    assert server.get(API + "/status").json()["plant"]
    plant = lambda: server.get(API + "/plant").json()
    wait_for(lambda: names(plant()) == {left: True, right: True}, "both boards")
    seen = plant()
    assert seen["domain"] == domain and seen["problem"] == "" and seen["trouble"] == [], seen
    assert seen["boards"][0]["state"] == "empty" and seen["boards"][0]["deployment"] == "", seen
    assert len({board["release"] for board in seen["boards"]}) == 1 and seen["boards"][0]["release"][0].isdigit(), seen
    setting.end(dying, signal.SIGKILL)
    wait_for(lambda: names(plant()) == {left: True, right: False}, "the board to be missed")
    assert plant()["trouble"][0].startswith(f"board {right} no longer reports, last "), plant()
    assert server.get(API + "/plant/history").json() == {"deployments": []}
    start_agent(setting, right, domain)
    wait_for(lambda: names(plant()) == {left: True, right: True}, "the board to be back")
    assert plant()["trouble"] == []


def test_shows_only_its_host_without_the_option_plant(setting):
    server = setting.start_server()
    assert not server.get(API + "/status").json()["plant"]
    for path in ("/plant", "/plant/history"):
        answer = server.get(API + path)
        assert answer.status == 404 and "--plant" in answer.json()["message"], answer.body


if __name__ == "__main__":
    harness.main(globals())
