#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before recordings: what is listed, what is inside, numbers over time. recordings_test.py PROGRAMS FAKE_NODE [TEST...]"""

import subprocess

import harness


API = "/api/v1"


def record(setting):
    """A simulated second of the conveyor, recorded from its first run on."""
    example = setting.programs.parent / "examples" / "plc"
    folder = setting.folder / "recordings"
    folder.mkdir()
    subprocess.run([setting.programs / "indurop", "run", example / "module.xml", "--sim", "--until", "1s", "-q", "--node",
                    setting.node, "--record", folder / "run.mcap"], env=setting.environment, check=True, timeout=120,
                   capture_output=True)
    return folder


def test_shows_what_is_in_a_recording(setting):
    folder = record(setting)
    (folder / "broken.mcap").write_bytes(b"no recording")
    (folder / "notes.txt").write_text("not listed")
    server = setting.start_server("--recordings", folder)
    listed = {one["name"]: one for one in server.get(API + "/recordings").json()["recordings"]}
    assert set(listed) == {"run.mcap", "broken.mcap"} and listed["run.mcap"]["bytes"] > 1000 and not listed["run.mcap"]["black_box"]
    inside = server.get(API + "/recordings/run.mcap").json()
    assert inside["complete"] and 0.9e9 < inside["end_ns"] - inside["begin_ns"] < 1.1e9, inside
    channels = {one["name"]: one for one in inside["channels"]}
    assert channels["conveyor::start"]["numbers"] == ["conveyor::start"]
    watch = channels["conveyor::instance_watch"]["numbers"]
    assert watch[0] == "conveyor::instance_watch[0]" and len(watch) > 50
    path = API + "/recordings/run.mcap/values?number=conveyor::start&number=conveyor::instance_watch%5B0%5D&points=11"
    values = server.get(path).json()
    assert [one["name"] for one in values["lines"]] == ["conveyor::start", "conveyor::instance_watch[0]"]
    assert values["lines"][0]["values"][-1] == 0 and all(len(one["values"]) == 11 for one in values["lines"]), values
    middle = (inside["begin_ns"] + inside["end_ns"]) // 2
    part = server.get(f"{path}&from_ns={middle}").json()
    assert part["begin_ns"] == middle and part["end_ns"] == inside["end_ns"]
    assert server.get(API + "/recordings/broken.mcap").status == 422


def test_opens_only_what_is_listed(setting):
    folder = record(setting)
    (setting.folder / "secret.mcap").write_bytes((folder / "run.mcap").read_bytes())
    server = setting.start_server("--recordings", folder)
    for name in ("..%2Fsecret.mcap", "none.mcap", "%2Fetc%2Fpasswd", "notes.txt", "x~y.mcap"):
        assert server.get(API + "/recordings/" + name).status == 404, name
    path = API + "/recordings/run.mcap/values"
    for wrong in ("", "?number=conveyor::start&points=1", "?number=conveyor::start&from_ns=x"):
        assert server.get(path + wrong).status == 400, wrong
    assert server.get(path + "?number=missing").status == 422


if __name__ == "__main__":
    harness.main(globals())
