#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop-serve before a PLC program: ladder, text and chart with their values. plc_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
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
FBD = """<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201"><fileHeader companyName="" productName="logic" productVersion="1"
creationDateTime="2026-01-01T00:00:00"/><contentHeader name="logic"><coordinateInfo><fbd><scaling x="0" y="0"/></fbd><ld><scaling
x="0" y="0"/></ld><sfc><scaling x="0" y="0"/></sfc></coordinateInfo></contentHeader><types><dataTypes/><pous>
<pou name="logic" pouType="program"><interface><localVars>
<variable name="a" address="%IX0.0"><type><BOOL/></type></variable><variable name="b" address="%IX0.1"><type><BOOL/></type></variable>
<variable name="c" address="%QX0.0"><type><BOOL/></type></variable><variable name="d" address="%QX0.1"><type><BOOL/></type></variable>
</localVars></interface><body><FBD>
<inVariable localId="1" height="30" width="60" negated="false"><position x="40" y="50"/><connectionPointOut/><expression>a</expression></inVariable>
<inVariable localId="2" height="30" width="60" negated="true"><position x="40" y="90"/><connectionPointOut/><expression>b</expression></inVariable>
<block localId="3" typeName="OR" height="80" width="60"><position x="200" y="40"/><inputVariables>
<variable formalParameter="IN1" negated="true"><connectionPointIn><connection refLocalId="1"/></connectionPointIn></variable>
<variable formalParameter="IN2"><connectionPointIn><connection refLocalId="2"/></connectionPointIn></variable>
</inputVariables><inOutVariables/><outputVariables><variable formalParameter="OUT"><connectionPointOut/></variable></outputVariables></block>
<outVariable localId="4" height="30" width="60" negated="false"><position x="400" y="50"/><connectionPointIn><connection refLocalId="3" formalParameter="OUT"/></connectionPointIn><expression>c</expression></outVariable>
<outVariable localId="5" height="30" width="60" negated="true"><position x="400" y="90"/><connectionPointIn><connection refLocalId="3" formalParameter="OUT"/></connectionPointIn><expression>d</expression></outVariable>
</FBD></body></pou></pous></types><instances><configurations><configuration name="config"><resource name="resource">
<task name="fast" priority="1" interval="T#10ms"><pouInstance name="logic0" typeName="logic"/></task>
</resource></configuration></configurations></instances></project>
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


def test_describes_where_values_are(setting):
    (setting.folder / "line.st").write_text(LINE)
    built = indurop(setting, "plc", "build", setting.folder / "line.st", "-o", setting.folder / "out", "--watch")
    (setting.folder / "out" / "module.xml").write_text(f"<root>\n{built}</root>\n")
    run(setting, setting.folder / "out" / "module.xml")
    server = setting.start_server("--plc", setting.folder / "line.st")
    model = asked(server, f"{API}/boards/{setting.node}/plc/model")
    assert (model["program"], model["tasks"]) == ("line", [{"name": "", "module": "line"}]), model
    assert model["globals"] == ["line::go"], model
    main, steps = model["instances"]
    assert (main["name"], main["variable"], steps["name"]) == ("main", "line::main_watch", "steps"), model
    types = [model["types"][one["type"]] for one in (main, steps)]
    go, n = ({one["name"]: one for one in types[0]["variables"]}[name] for name in ("go", "n"))
    assert go["section"] == "external" and go["variable"] == "line::go" and "offset" not in go, go
    assert n["section"] == "local" and n["type"] == {"kind": "i16", "iec": "INT", "size": 2}, n
    assert [one["name"] for one in types[1]["variables"] if one.get("step")] == ["rest", "run"], types[1]
    indurop(setting, "set", "--node", setting.node, "go", "true")

    def data():
        return bytes(json.loads(indurop(setting, "get", "--node", setting.node, "-o", "json", main["variable"]))["values"][0]["value"])
    at = main["offset"] + n["offset"]
    wait_for(lambda: int.from_bytes(data()[at:at + 2], "little") == 7, "the value")
    assert data()[:8] == int(main["mark"], 16).to_bytes(8, "little")


def test_follows_a_program_that_is_exchanged(setting):
    file = setting.folder / "line.st"
    build = ("plc", "build", file, "-o", setting.folder / "out", "--watch")
    file.write_text(LINE)
    (setting.folder / "out").mkdir()
    (setting.folder / "out" / "module.xml").write_text(f"<root>\n{indurop(setting, *build)}</root>\n")
    run(setting, setting.folder / "out" / "module.xml")
    server = setting.start_server("--plc", file)
    base = f"{API}/boards/{setting.node}/plc"
    asked(server, base)
    wait_for(lambda: asked(server, base + "/live")["bodies"][1]["active"] == "10", "the first scan")
    file.write_text(LINE.replace("VAR n : INT;", "VAR n : INT; m : INT;").replace("n := 7;", "n := 8;\n    m := 9;"))
    indurop(setting, *build)
    indurop(setting, "reload", "line", "--node", setting.node, "--health", "0s")

    def failed():
        answer = server.get(base + "/live")
        return answer.status != 200 and b"is not the one in these files" in answer.body
    wait_for(failed, "the message that another program runs")
    assert "    m := 9;" in asked(server, base)["bodies"][0]["lines"]
    indurop(setting, "set", "--node", setting.node, "go", "true")
    wait_for(lambda: "m = 9" in asked(server, base + "/live")["bodies"][0]["values"], "the values of the new program")


def run_both(setting):
    """The text and the function blocks as two programs of one board."""
    parts = []
    for name, text in (("line.st", LINE), ("logic.xml", FBD)):
        (setting.folder / name).write_text(text)
        parts.append(indurop(setting, "plc", "build", setting.folder / name, "-o", setting.folder / "out", "--watch"))
    (setting.folder / "out" / "module.xml").write_text("<root>\n" + "".join(parts) + "</root>\n")
    run(setting, setting.folder / "out" / "module.xml")
    return [f"{setting.folder}/{name}" for name in ("line.st", "logic.xml")]


def test_shows_the_power_in_function_blocks_with_negated_pins(setting):
    _, logic = run_both(setting)
    server = setting.start_server("--plc", logic)
    base = f"{API}/boards/{setting.node}/plc"
    body, = asked(server, base)["bodies"]
    network, = body["networks"]
    assert body["language"] == "FBD" and not network["rail"] and not network["switches"], body
    # What the standard says of each wire, for all inputs: what leaves the variable a, what leaves b through its negation,
    # and the block's output, which is negated on its way into d only.
    seen = {}
    for a in (False, True):
        for b in (False, True):
            indurop(setting, "set", "--node", setting.node, f"logic::a={str(a).lower()}", f"logic::b={str(b).lower()}")
            output = (not a) or (not b)

            def settled():
                values = {one["name"]: one["value"] for one in asked(server, f"{API}/boards/{setting.node}/variables?match=logic::*")["variables"]}
                live = asked(server, base + "/live")["bodies"][0]["networks"][0]
                return (values["logic::c"], values["logic::d"]) == (output, not output) and live

            live = wait_for(settled, f"c and d for {a}, {b}")
            assert len(live["power"]) == len(network["wires"]) > 0
            seen[a, b] = wait_for(lambda: settled() and asked(server, base + "/live")["bodies"][0]["networks"][0]["power"], "power")
    tables = {tuple(seen[inputs][i] == "1" for inputs in sorted(seen)) for i in range(len(network["wires"]))}
    inputs = sorted(seen)
    assert tables == {tuple(a for a, _ in inputs), tuple(not b for _, b in inputs), tuple(not (a and b) for a, b in inputs)}, (tables, seen)


def test_shows_several_programs(setting):
    line, logic = run_both(setting)
    other = setting.folder / "other.st"
    other.write_text(LINE.replace("7", "8"))
    server = setting.start_server("--plc", f"other={other}", "--plc", line, "--plc", logic)
    base = f"{API}/boards/{setting.node}/plc"
    first = asked(server, base)
    assert (first["program"], first["programs"]) == ("line", ["other", "line", "logic"]), "the first that the board runs"
    for name, languages in (("line", ["ST", "SFC"]), ("logic", ["FBD"])):
        program, live = asked(server, f"{base}?program={name}"), asked(server, f"{base}/live?program={name}")
        assert program["program"] == live["program"] == name and program["namespace"] == name
        assert [one["language"] for one in program["bodies"]] == languages and len(live["bodies"]) == len(languages)
    assert server.get(base + "?program=other").status == 409, "the board does not run it"
    assert server.get(base + "?program=missing").status == 404


def test_refuses_programs_it_cannot_tell_apart(setting):
    for words in (["--plc", "a/main.st", "--plc", "b/main.st"], ["--plc", "cell.glb"], ["--plc", "name="]):
        refused = subprocess.run([setting.programs / "indurop-serve", "--port", "0", *words], env=setting.environment,
                                 capture_output=True, text=True, check=False, timeout=60)
        assert refused.returncode == 2 and "--plc" in refused.stderr, (words, refused)


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
