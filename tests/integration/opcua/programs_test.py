#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""PLC programs by the model of OPC 30000 (PLCopen). The judge of types is what the standard demands, as it is stated here, and
the NodeSet file of the OPC Foundation if OPCUA_PLC_NODESET names it (no package of npm has it); of values what plant.st
computes, and `indurop get`. programs_test.py PROGRAMS FAKE_NODE [TEST...]"""

import os
import pathlib
import shutil
import subprocess

from opcua_harness import main, wait_for  # first: it says where the others are
from nodesets import MANDATORY, NodeSets, TYPE, UA

DI, PLC = "http://opcfoundation.org/UA/DI/", "http://PLCopen.org/OpcUa/IEC61131-3/"
CONFIGURATION, RESOURCE, PROGRAM, BLOCK, TASK, CHART, CONTAINER = 1001, 1002, 1004, 1005, 1006, 1007, 1004
REFERENCES = {"input": 4001, "output": 4002, "in_out": 4003, "local": 4004, "external": 4005, "with": 4006}
# Properties that DI demands of each device.
DEVICE = {"SerialNumber": "String", "RevisionCounter": "Int32", "Manufacturer": "LocalizedText", "Model": "LocalizedText",
          "DeviceManual": "String", "DeviceRevision": "String", "SoftwareRevision": "String", "HardwareRevision": "String"}
VARIABLES = {"start", "stop", "motor"}  # of conveyor.xml, at addresses
MODULE = """<module><filename>./opcua_plant_{name}.so</filename><moduletype>thread</moduletype><operationtype>{kind}</operationtype>
<{time}>{value}</{time}><priority>{priority}</priority></module>
"""
TASKS = (("fast", "periodic", "period", "5ms"), ("slow", "periodic", "period", "50ms"), ("rare", "sporadic", "deadline", "50ms"))
# The members of `main` in plant.st, by section; types are those of OPC UA, or names of OPC 30000 and of the program.
MAIN = {
    "input": {"offset": "Int16"}, "output": {"done": "Boolean"},
    "local": {"kept": "Int16", "scans": "Int64", "big": "UInt64", "mask": "WORD", "share": "Int16", "color": "opcua_plant::Color", "text": "STRING",
              "wide": "String", "list": "Int16", "grid": "Int32", "track": "opcua_plant::Point", "day": "LDATE", "letter": "CHAR", "line": "Line",
              "sensor": "Boolean"},
    "external": {"go": "Boolean", "limit": "Int16"},
}
MOTOR = {"input": {"enable", "number"}, "output": {"speed"}, "in_out": {"total"}, "local": {"runs", "delay", "place"}, "external": {"go"}}


class Space:
    def __init__(self, client):
        self.client = client
        self.uris = client.read("i=2255")["value"]

    def id(self, uri, number):
        return f"ns={self.uris.index(uri)};i={number}"

    def children(self, node):
        return {(self.uris[one["namespace"]], one["name"]): one for one in self.client.do("browse", node=node)}

    def of_type(self, node, type_id):
        return [one["node"] for one in self.client.do("browse", node=node) if one["type"] == type_id]

    def only(self, node, type_id):
        found = self.of_type(node, type_id)
        assert len(found) == 1, (node, found)
        return found[0]

    def folder(self, node, name):
        one = self.children(node)[(PLC, name)]
        assert one["type"] == self.id(DI, CONTAINER), one
        assert self.children(one["node"])[(DI, "SupportedTypes")]["type"] == "ns=0;i=61", one
        return one["node"]

    def members(self, node):
        """Names below a program or function block by section."""
        found = {}
        for section, number in REFERENCES.items():
            for one in self.client.do("browse", node=node, all=True):
                if one["forward"] and one["reference"] == self.id(PLC, number):
                    found.setdefault(section, {})[one["name"]] = one
        return found

    def supertype(self, node):
        return next(one["node"] for one in self.client.do("browse", node=node, all=True) if one["reference"] == "ns=0;i=45" and not one["forward"])

    def type_name(self, node):
        """The name of a variable's data type, or of an object's type."""
        types = {"ns=0;i=1": "Boolean", "ns=0;i=4": "Int16", "ns=0;i=6": "Int32", "ns=0;i=8": "Int64", "ns=0;i=9": "UInt64", "ns=0;i=12": "String",
                 "ns=0;i=7": "UInt32", "ns=0;i=10": "Float"}
        one = self.client.read(node, attribute="DataType")
        found = one["value"] if one["code"] == "Good" else next(
            each["node"] for each in self.client.do("browse", node=node, all=True) if each["reference"] == "ns=0;i=40")
        return types.get(found) or self.client.read(found, attribute="DisplayName")["value"]


def run(setting, configuration):
    child = setting.start(setting.programs / "indurop", "run", configuration, "-q", "--node", setting.node)
    wait_for(lambda: setting.indurop("status", "-o", "json").returncode == 0, "the node")
    return child


def start(setting, *options):
    example = setting.programs.parent / "examples" / "plc"
    run(setting, example / "module.xml")
    server = setting.start_server(*(["--plc", example / "conveyor.xml"] if "plc" in options else []))
    return setting.client(setting.start_opcua(server, "--anonymous"))


def start_plant(setting):
    """The tasks of plant.st."""
    modules = ""
    for priority, (name, kind, time, value) in enumerate(TASKS, 1):
        shutil.copy(pathlib.Path(os.environ["OPCUA_PLANT"]) / f"opcua_plant_{name}.so", setting.folder)
        modules += MODULE.format(name=name, kind=kind, time=time, value=value, priority=priority)
    (setting.folder / "plant.xml").write_text(f"<root>{modules}</root>\n")
    child = run(setting, setting.folder / "plant.xml")
    source = pathlib.Path(__file__).parent / "plant.st"
    server = setting.start_server("--plc", f"opcua_plant={source}", "--write")
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    return child, client, Space(client)


def wide(value):
    """A number of 64 bits, which the client has in two halves."""
    return (value[0] << 32) + value[1] if value else 0


def local(setting, name):
    return f"ns=2;s={setting.node}/plc/opcua_plant/{name}"


def test_shows_what_the_standard_demands(setting):
    client = start(setting, "plc")
    space = Space(client)
    device_set = space.children("i=85")[(DI, "DeviceSet")]["node"]
    configuration = space.only(device_set, space.id(PLC, CONFIGURATION))
    resource = space.only(space.folder(configuration, "Resources"), space.id(PLC, RESOURCE))
    properties = space.children(resource)
    for name, kind in DEVICE.items():
        value = client.read(properties[(DI, name)]["node"])
        assert value["code"] == "Good" and value["type"] == kind, (name, value)
    task = space.only(space.folder(resource, "Tasks"), space.id(PLC, TASK))
    members = space.children(task)
    priority, interval = (client.read(members[(PLC, name)]["node"]) for name in ("Priority", "Interval"))
    assert priority["type"] == "UInt32" and priority["code"] == "Good", priority
    assert interval["type"] == "String" and interval["value"] == "T#10000us", interval
    (program,) = [one for one in client.do("browse", node=space.folder(resource, "Programs")) if one["name"] != "SupportedTypes"]
    assert program["name"] == "instance" and program["kind"] == "Object", program
    assert program["type"].startswith("ns=2;"), "CtrlProgramType is abstract"
    assert space.supertype(program["type"]) == space.id(PLC, PROGRAM), program
    assert [one["node"] for one in space.members(program["node"])["with"].values()] == [task]
    catalogue = space.children("i=88")[(PLC, "CtrlTypes")]
    assert catalogue["type"] == "ns=0;i=61" and program["type"] in [one["node"] for one in client.do("browse", node=catalogue["node"])]


def test_shows_the_variables_of_the_board(setting):
    client = start(setting, "plc")
    space = Space(client)
    located = space.members(f"ns=2;s={setting.node}/plc/conveyor/instance")["local"]
    board = client.walk(f"ns=2;s={setting.node}")
    assert located.keys() >= VARIABLES and all(located[name]["node"] in board for name in VARIABLES), located
    start_node = located["start"]["node"]
    client.do("monitor", nodes=[start_node])
    setting.set(start_node.partition(f"{setting.node}/")[2], 1)
    client.becomes(start_node, lambda one: one["value"] is True, "start to be set")


def test_tasks_execute_their_programs(setting):
    _, client, space = start_plant(setting)
    resource = f"ns=2;s={setting.node}/plc/opcua_plant"
    tasks = {client.read(node, attribute="DisplayName")["value"]: node for node in space.of_type(space.folder(resource, "Tasks"), space.id(PLC, TASK))}
    values = {name: {one["name"]: client.read(one["node"])["value"] for one in client.do("browse", node=node)} for name, node in tasks.items()}
    assert values == {"fast": {"Priority": 1, "Interval": "T#5000us"}, "slow": {"Priority": 2, "Interval": "T#50000us"},
                      "rare": {"Priority": 3, "Single": "opcua_plant::go"}}, values
    programs = {one["name"]: one for one in client.do("browse", node=space.folder(resource, "Programs")) if one["name"] != "SupportedTypes"}
    assert programs.keys() == {"one", "two", "chart", "event"}, programs
    executed = {name: [one["node"] for one in space.members(program["node"])["with"].values()] for name, program in programs.items()}
    assert executed == {"one": [tasks["fast"]], "two": [tasks["slow"]], "chart": [tasks["slow"]], "event": [tasks["rare"]]}, executed
    assert programs["one"]["type"] == programs["two"]["type"] != programs["chart"]["type"] == programs["event"]["type"], programs
    assert client.read(local(setting, "event.rest"))["code"] == "BadWaitingForInitialData", "it has not run"
    setting.set("opcua_plant::go", 1)
    wait_for(lambda: client.read(local(setting, "event.rest.X"))["value"] is True, "its first scan")
    declared = {one["name"]: one["node"] for one in client.do("browse", node=space.children(resource)[(PLC, "GlobalVars")]["node"])}
    assert {name: declared.get(name) for name in ("go", "limit")} == {name: setting.id(f"opcua_plant::{name}") for name in ("go", "limit")}, declared


def test_variables_have_their_sections_and_types(setting):
    _, client, space = start_plant(setting)
    members = space.members(local(setting, "one"))
    del members["with"]
    found = {section: {name: space.type_name(one["node"]) for name, one in ones.items()} for section, ones in members.items()}
    assert found == MAIN, found
    first = local(setting, "one.line.motors[1,0]")
    blocks = space.members(local(setting, "one.line"))["local"]
    assert blocks.keys() == {"motors[1,0]", "motors[1,1]", "motors[2,0]", "motors[2,1]", "spare", "sum", "i", "k"}, blocks.keys()
    assert blocks["motors[1,0]"]["node"] == first
    assert (found := {section: set(ones) for section, ones in space.members(first).items()}) == MOTOR, found
    assert space.type_name(f"{first}.place.since") == "LTIME"
    motor = blocks["motors[1,0]"]["type"]
    assert client.read(motor, attribute="DisplayName")["value"] == "Motor" and blocks["spare"]["type"] == motor
    base = space.supertype(motor)
    assert client.read(base, attribute="DisplayName")["value"] == "Base" and space.supertype(base) == space.id(PLC, BLOCK)
    delay = space.members(first)["local"]["delay"]
    assert {section: set(ones) for section, ones in space.members(delay["node"]).items()} == {"input": {"IN", "PT"}, "output": {"Q", "ET"}}
    assert space.supertype(delay["type"]) == space.id(PLC, BLOCK) and client.read(delay["type"], attribute="DisplayName")["value"] == "TON"


def test_instances_are_as_their_types_declare(setting):
    """Each variable and instance of a type is in its instances, with the same section and type."""
    _, client, space = start_plant(setting)
    below = lambda node: {one["name"]: (one["reference"], one["type"], client.read(one["node"], attribute="DataType")["value"])
                          for one in client.do("browse", node=node) if one["kind"] in ("Object", "Variable")}
    checked = 0
    for name in ("one", "one.line", "one.line.motors[2,1]", "one.line.spare.delay", "chart"):
        node = local(setting, name)
        at = next(one["node"] for one in client.do("browse", node=node, all=True) if one["reference"] == "ns=0;i=40")
        has = below(node)
        while at.startswith("ns=2;"):
            for member, wanted in below(at).items():
                assert has.get(member) == wanted, (name, member, wanted, has.get(member))
                checked += 1
            at = space.supertype(at)
    assert checked > 30, checked


def test_values_are_those_of_the_program(setting):
    _, client, _ = start_plant(setting)
    wait_for(lambda: wide(client.read(local(setting, "two.scans"))["value"]) > 3, "the program to run")
    read = lambda name: client.read(local(setting, name))
    wanted = {"big": [2**32 - 1, 2**32 - 1], "mask": 0xBEEF, "share": 50, "color": 6, "text": "belt", "wide": "é€", "list": [7, 8, 9],
              "grid": [11, 12, 13, 21, 22, 23], "kept": 40, "done": False, "letter": 65, "day": list(divmod(1_795_910_400 * 10**9, 2**32))}
    for name, value in wanted.items():
        one = read(f"one.{name}")
        assert (one["code"], one["value"]) == ("Good", value), (name, one)
    assert read("one.grid")["dims"] == [2, 3]
    assert [read(f"{program}.track[2].x")["value"] for program in ("one", "two")] == [3, 7], "two instances of a program"
    for i, k in ((1, 0), (1, 1), (2, 0), (2, 1)):
        number, motor = 10 * i + k, f"one.line.motors[{i},{k}]"
        assert (read(f"{motor}.number")["value"], read(f"{motor}.speed")["value"]) == (number, number * 1.5)
        place = read(f"{motor}.place")["value"]
        assert place == {"x": number, "y": number * 0.5, "since": [0, 1_500_000_000]}, place
        assert read(f"{motor}.place.y")["value"] == number * 0.5 and wide(read(f"{motor}.delay.PT")["value"]) == 3600 * 10**9
    assert read("one.line.spare.speed")["value"] == 0, "it is never called"
    assert read("one.line.motors[1,0].total")["code"] == "BadNotReadable", "by reference: its value is elsewhere"
    bounds = {name: client.read(f"{local(setting, 'one.grid')}/{name}")["value"] for name in ("Dimensions", "IndexMin", "IndexMax")}
    assert bounds == {"Dimensions": 2, "IndexMin": [1, 1], "IndexMax": [2, 3]}, bounds
    assert client.read(f"{local(setting, 'one.list')}/IndexMin")["value"] == [-1]
    assert [client.read(f"{local(setting, 'one.share')}/Subrange{end}")["value"] for end in ("Min", "Max")] == [0, 100]
    assert client.read(f"{local(setting, 'one.kept')}/RETAIN")["value"] is True
    assert client.do("write", node=local(setting, "one.kept"), type="Int16", value=1) in ("BadNotWritable", "BadUserAccessDenied")


def test_follows_values_and_steps(setting):
    child, client, space = start_plant(setting)
    running, elapsed, run_x, rest_x = (local(setting, name) for name in (
        "one.line.motors[2,0].runs", "one.line.motors[2,0].delay.ET", "chart.run.X", "chart.rest.X"))
    client.do("monitor", nodes=[running, elapsed, run_x, rest_x])
    client.becomes(running, lambda one: (one["value"] or 0) > 100 and one["count"] > 3, "the function block to run")
    client.becomes(rest_x, lambda one: one["value"] is True, "the first step")
    chart = space.only(local(setting, "chart"), space.id(PLC, CHART))
    steps = {one["name"]: one["node"] for one in client.do("browse", node=chart) if one["name"] != "Priority"}
    assert steps == {name: local(setting, f"chart.{name}") for name in ("rest", "run")}, steps
    assert client.read(space.children(chart)[(PLC, "Priority")]["node"])["value"] == 2
    setting.set("opcua_plant::go", 1)
    client.becomes(run_x, lambda one: one["value"] is True, "the second step")
    client.becomes(elapsed, lambda one: wide(one["value"]) > 0, "the timer")
    setting.end(child)
    client.becomes(running, lambda one: one["code"] == "BadOutOfService", "the node to be stopped")
    run(setting, setting.folder / "plant.xml")
    client.becomes(running, lambda one: one["code"] == "Good" and one["value"] > 0, "the node to be back")


def test_follows_a_program_that_is_exchanged(setting):
    """Without a change of the board's variables: its data has reserves."""
    text = ("FUNCTION_BLOCK Motor VAR_INPUT on : BOOL; END_VAR VAR {more} n : INT; END_VAR n := {value}; END_FUNCTION_BLOCK\n"
            "PROGRAM main VAR m : Motor; {again} END_VAR m(on := TRUE); END_PROGRAM\n")
    file = setting.folder / "line.st"
    build = ("plc", "build", file, "-o", setting.folder / "out", "--watch")
    indurop = lambda *words: subprocess.run([setting.programs / "indurop", *words], env=setting.environment, capture_output=True, text=True,
                                            timeout=300, check=True).stdout
    file.write_text(text.format(more="", value=5, again=""))
    (setting.folder / "out").mkdir()
    (setting.folder / "out" / "module.xml").write_text(f"<root>\n{indurop(*build)}</root>\n")
    run(setting, setting.folder / "out" / "module.xml")
    client = setting.client(setting.start_opcua(setting.start_server("--plc", file), "--anonymous"))
    space = Space(client)
    node = lambda name: f"ns=2;s={setting.node}/plc/line/main.{name}"
    client.do("monitor", nodes=[node("m.n")])
    client.becomes(node("m.n"), lambda one: one["value"] == 5, "the first program")
    before = space.members(f"ns=2;s={setting.node}/plc/line/main")["local"]["m"]["type"]
    file.write_text(text.format(more="first : LREAL := 1.0;", value=6, again="second : Motor;"))
    indurop(*build)
    indurop("reload", "line", "--node", setting.node, "--health", "0s")
    client.becomes(node("m.n"), lambda one: one["value"] == 6, "the second program, at another place")
    wait_for(lambda: client.read(node("m.first"))["value"] == 1, "the new variable")
    members = space.members(f"ns=2;s={setting.node}/plc/line/main")["local"]
    assert members["m"]["type"] == members["second"]["type"] != before, members
    file.write_text(text.format(more="", value=7, again="").replace(" n : INT;", "").replace("n := 7;", ""))
    indurop(*build)
    indurop("reload", "line", "--node", setting.node, "--health", "0s", "--lossy")
    client.becomes(node("m.n"), lambda one: one["code"] == "BadNodeIdUnknown", "the variable to be gone")
    assert set(space.members(node("m"))) == {"input"}
    client.do("unmonitor", nodes=[node("m.n")])
    wait_for(lambda: client.read(node("m.n"))["code"] == "BadNodeIdUnknown" and client.read(node("m.n"), attribute="DisplayName")["code"] != "Good",
             "the node to be removed")


def test_plants_without_programs_have_no_model(setting):
    assert PLC not in Space(start(setting)).uris


def neutral(space, text):
    where, _, rest = text.rpartition(";")
    return space.uris[int(where[len("ns="):] or 0)], rest


def test_types_are_those_of_the_nodeset(setting):
    """With the NodeSet file of the OPC Foundation: each of its nodes is there, with its name, references and data type."""
    if "OPCUA_PLC_NODESET" not in os.environ:
        print("    OPCUA_PLC_NODESET is not set: not compared")
        return
    nodesets = NodeSets(pathlib.Path(os.environ["OPCUA_PACKAGES"]) / "node_modules/node-opcua-nodesets/nodesets", os.environ["OPCUA_PLC_NODESET"])
    client = start(setting, "plc")
    space = Space(client)
    wanted = {key: node for key, node in nodesets.nodes.items() if key[0] == PLC}
    differing, compared = [], 0
    for key, node in wanted.items():
        at = f"ns={space.uris.index(PLC)};{key[1]}"
        name = client.read(at, attribute="BrowseName")["value"]
        if name is None:
            differing.append((key[1], node.name, "missing"))
            continue
        has = {(neutral(space, one["reference"]), neutral(space, one["node"]), one["forward"]) for one in client.do("browse", node=at, all=True)}
        need = {(kind, target, True) for kind, target in node.forward} | {(kind, source, False) for kind, source in node.backward if kind != TYPE}
        compared += len(need)
        attributes = [(space.uris[name["namespaceIndex"]], name["name"]) == node.name]
        if node.kind == "Variable":
            attributes += [neutral(space, client.read(at, attribute="DataType")["value"]) == node.data_type,
                           client.read(at, attribute="ValueRank")["value"] == node.rank]
        if need - has or not all(attributes):
            differing.append((key[1], node.name[1], need - has, attributes))
    print(f"    {len(wanted)} nodes, {compared} references")
    assert not differing, "\n".join(map(str, differing))


if __name__ == "__main__":
    main(globals())
