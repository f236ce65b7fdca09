#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before a PLC program: ladder, text and chart with their values. plc_test.py PROGRAMS FAKE_NODE [TEST...]"""

import subprocess

import harness
from harness import wait_for

API = "/api/v1"
LINE = """VAR_GLOBAL go : BOOL; END_VAR
PROGRAM main
VAR_EXTERNAL go : BOOL; END_VAR
VAR n : INT; END_VAR
  IF go THEN
    n := 7;
  END_IF;
END_PROGRAM
PROGRAM steps
VAR_EXTERNAL go : BOOL; END_VAR
INITIAL_STEP rest: END_STEP
STEP run: END_STEP
TRANSITION FROM rest TO run := go; END_TRANSITION
TRANSITION FROM run TO rest := NOT go; END_TRANSITION
END_PROGRAM
"""


def indurop(setting, *words):
    done = subprocess.run([setting.programs / "indurop", *words], env=setting.environment, capture_output=True, text=True,
                          timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def run(setting, configuration):
    setting.start(setting.programs / "indurop", "run", configuration, "-q", "--node", setting.node)
    wait_for(lambda: subprocess.run([setting.programs / "indurop", "status", "--node", setting.node, "-o", "json"],
                                    env=setting.environment, capture_output=True, check=False).returncode == 0, "the node")


def asked(server, path):
    answer = server.get(path)
    assert answer.status == 200, answer.body
    return answer.json()


def test_shows_the_power_in_a_ladder(setting):
    example = setting.programs.parent / "examples" / "plc"
    run(setting, example / "module.xml")
    server = setting.start_server("--plc", example / "conveyor.xml")
    base = f"{API}/boards/{setting.node}/plc"
    assert server.get(API + "/status").json()["plc"]
    program = asked(server, base)
    assert program["namespace"] == "conveyor" and len(program["bodies"]) == 1, program
    networks = program["bodies"][0]["networks"]
    assert program["bodies"][0]["language"] == "LD" and networks[0]["rail"] and "<path" in networks[0]["svg"]
    assert networks[0]["remarks"] == ["Start and stop the conveyor; it stays on until stopped"], networks[0]["remarks"]
    names = [one["name"] for one in networks[0]["switches"]]
    assert sorted(names) == ["belt", "belt", "fault", "start", "stop"], names

    def now(i=0):
        return asked(server, base + "/live")["bodies"][0]["networks"][i]
    assert [len(now()[what]) for what in ("power", "closed")] == [len(networks[0][what]) for what in ("wires", "switches")]
    coils = [i for i, name in enumerate(names) if name == "belt"]
    assert all(now()["closed"][i] == "0" for i in coils)
    indurop(setting, "set", "--node", setting.node, "start", "true")
    wait_for(lambda: all(now()["closed"][i] == "1" for i in coils), "the belt")
    assert "0" in now()["power"] or "1" in now()["power"]
    wait_for(lambda: "T#2s" in now(1)["values"], "the timer to end")


def test_shows_text_and_steps(setting):
    (setting.folder / "line.st").write_text(LINE)
    built = indurop(setting, "plc", "build", setting.folder / "line.st", "-o", setting.folder / "out", "--watch")
    (setting.folder / "out" / "module.xml").write_text(f"<root>\n{built}</root>\n")
    run(setting, setting.folder / "out" / "module.xml")
    server = setting.start_server("--plc", setting.folder / "line.st")
    base = f"{API}/boards/{setting.node}/plc"
    text, chart = asked(server, base)["bodies"]
    assert text["language"] == "ST" and "    n := 7;" in text["lines"], text
    assert chart["language"] == "SFC" and [one["name"] for one in chart["chart"]["steps"]] == ["rest", "run"]
    assert chart["chart"]["conditions"] == ["go", "NOT go"]
    live = lambda: asked(server, base + "/live")["bodies"]
    wait_for(lambda: live()[1]["active"] == "10", "the first step")
    indurop(setting, "set", "--node", setting.node, "go", "true")
    wait_for(lambda: live()[1]["active"] == "01", "the second step")
    values, steps = live()
    assert "n = 7" in values["values"] and steps["conditions"][0] == "go = TRUE", (values, steps)
    assert steps["times"][0] == "" and steps["times"][1].startswith("T#"), steps


def test_says_why_it_shows_nothing(setting):
    setting.start_node()
    path = f"{API}/boards/{setting.node}/plc"
    answer = setting.start_server().get(path)
    assert answer.status == 404 and "--plc" in answer.json()["message"]
    (setting.folder / "line.st").write_text(LINE)
    answer = setting.start_server("--plc", setting.folder / "line.st").get(path)
    assert answer.status == 409 and "--watch" in answer.json()["message"], answer.body
    (setting.folder / "wrong.st").write_text("PROGRAM main\n  x := 1;\nEND_PROGRAM\n")
    answer = setting.start_server("--plc", setting.folder / "wrong.st").get(path + "/live")
    assert answer.status == 500 and "wrong.st:2:3: error" in answer.json()["message"], answer.body


if __name__ == "__main__":
    harness.main(globals())
