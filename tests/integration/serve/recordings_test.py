#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before recordings: what is listed, what is inside, numbers over time. recordings_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import pathlib
import random
import subprocess
import sys

import harness

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from mcap_file import McapFile  # noqa: E402


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


def record_rambler(setting, until="3s"):
    """A module that counts its own runs (every 2 ms) in a variable that it declares to keep, and one that does not declare it."""
    folder = setting.folder / "recordings"
    folder.mkdir()
    modules = setting.programs.parent / "tests" / "modules"
    (setting.folder / "module.xml").write_text("<root>" + "".join(
        f"<module><filename>{modules}/{file}.so</filename><name>{file}</name><moduletype>thread</moduletype>"
        f"<operationtype>periodic</operationtype><period>{period}</period><priority>{priority}</priority></module>"
        for file, period, priority in (("counter", "1ms", 1), ("rambler", "2ms", 2))) + "</root>")
    subprocess.run([setting.programs / "indurop", "run", setting.folder / "module.xml", "--sim", "--until", until, "-q", "--node",
                    setting.node, "--record", folder / "run.mcap"], env=setting.environment, check=True, timeout=120,
                   capture_output=True)
    return folder


def test_steps_from_tick_to_tick(setting):
    file = record(setting) / "run.mcap"
    server = setting.start_server("--recordings", file.parent)
    runs = McapFile(file).runs()
    ticks = sorted({tick for _, _, _, tick in runs})
    path = API + "/recordings/run.mcap/tick"
    for tick in [ticks[0], ticks[-1], *random.sample(ticks, 20)]:
        answer = server.get(f"{path}?tick={tick}&number=conveyor::start").json()
        place = ticks.index(tick)
        assert answer["tick"] == tick, answer
        assert answer["previous"] == (ticks[place - 1] if place > 0 else None), (tick, answer)
        assert answer["next"] == (ticks[place + 1] if tick != ticks[-1] else None), (tick, answer)
        assert [(one["module"], one["number"]) for one in answer["runs"]] == [(module, number) for _, module, number, of in runs if of == tick]
        values = server.get(f"{API}/recordings/run.mcap/values?number=conveyor::start&to_ns={answer['end_ns']}&points=2").json()
        assert answer["numbers"] == [{"name": "conveyor::start", "value": values["lines"][0]["values"][-1]}], (answer, values)
        at = server.get(f"{path}?at_ns={answer['end_ns'] + 1000}").json()
        assert at["tick"] == tick, (tick, at)
    assert server.get(f"{path}?tick={ticks[-1] + 1000}").json()["tick"] == ticks[-1]
    assert server.get(f"{path}?at_ns=1").json()["tick"] == ticks[0]
    for wrong in ("?tick=x", "?at_ns=-1"):
        assert server.get(path + wrong).status == 400, wrong
    assert server.get(path + "?tick=1&board=none").status == 422
    assert server.get(path + "?tick=1&number=missing").status == 422


def test_shows_what_runs_wrote(setting):
    """A run has the values that were new to it and those that it wrote; not what the tape repeats for late readers."""
    folder = record_rambler(setting)
    server = setting.start_server("--recordings", folder)
    for tick in [2, 2998, *random.sample(range(1, 2999), 20)]:
        for run in server.get(f"{API}/recordings/run.mcap/tick?tick={tick}").json()["runs"]:
            found = sorted((one["name"], one["written"]) for one in run["values"])
            wanted = {"counter": [("nt::counted", True), ("nt::kept", True)],
                      "rambler": [("nt::counted", False), ("nt::pace", True), ("nt::walked", True)]}[run["module"]]
            assert found == wanted, (tick, run)


def test_shows_what_modules_kept(setting):
    """At random ticks, what the module keeps is what its source says, and what a replay from the first run on leads to."""
    folder = record_rambler(setting)
    server = setting.start_server("--recordings", folder, "--write", "--token-file", setting.tokens)
    path = API + "/recordings/run.mcap/replay"
    assert server.post(path, {"tick": 5}, token=None).status == 401
    for tick in [0, 2999, *random.sample(range(3000), 6)]:
        answer = server.post(path, {"tick": tick}).json()
        assert answer["differing"] == 0 and answer["tick"] == tick, answer
        counter, rambler = sorted(answer["modules"], key=lambda one: one["module"])
        kept = {one["name"]: one["value"] for one in rambler["kept"]}
        runs = tick // 2 + 1
        assert rambler["state"] == "known" and kept["steps"] == str(runs), (tick, rambler)
        own = sum(3 + step % 5 for step in range(1, runs + 1))
        assert kept["path"].startswith("40 bytes: " + " ".join(f"{byte:02x}" for byte in own.to_bytes(8, "little"))), (tick, own, kept)
        assert counter["kept"] == [] and counter["state"] == "unknown" and "INDUROP_STATE" in counter["reason"], (tick, counter)
        whole = setting.folder / f"whole.{tick}.json"
        subprocess.run([setting.programs / "indurop-node", "--replay", folder / "run.mcap", "--replay-to", str(tick), "--replay-kept", whole,
                        "--node", setting.node + "-w", "-q", setting.folder / "module.xml"], env=setting.environment, check=True, timeout=120, capture_output=True)
        assert json.loads(whole.read_text())["modules"][1] == rambler, (tick, rambler)
    _, rambler = sorted(server.post(path, {"tick": 99999}).json()["modules"], key=lambda one: one["module"])
    assert {"name": "steps", "type": "unsigned int", "value": "1500"} in rambler["kept"], rambler  # after its last run
    assert server.post(path, {}).status == 400
    (setting.folder / "module.xml").unlink()
    gone = server.post(path, {"tick": 5})
    assert gone.status == 409 and "module.xml" in gone.json()["message"], gone.body


if __name__ == "__main__":
    harness.main(globals())
