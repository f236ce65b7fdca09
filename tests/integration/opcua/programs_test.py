#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""PLC programs by the model of OPC 30000 (PLCopen). The judge is what the standard demands, as it is stated here, and `indurop
get`. programs_test.py PROGRAMS FAKE_NODE [TEST...]"""

import subprocess

from opcua_harness import main, wait_for  # first: it says where the others are

DI, PLC = "http://opcfoundation.org/UA/DI/", "http://PLCopen.org/OpcUa/IEC61131-3/"
CONFIGURATION, RESOURCE, PROGRAM, TASK, CONTAINER = 1001, 1002, 1004, 1006, 1004
HAS_EXTERNAL_VAR, WITH = 4005, 4006
# Properties that DI demands of each device.
DEVICE = {"SerialNumber": "String", "RevisionCounter": "Int32", "Manufacturer": "LocalizedText", "Model": "LocalizedText",
          "DeviceManual": "String", "DeviceRevision": "String", "SoftwareRevision": "String", "HardwareRevision": "String"}
VARIABLES = {"start", "stop", "motor"}  # of conveyor.xml


class Space:
    def __init__(self, client):
        self.client = client
        self.uris = client.read("i=2255")["value"]

    def id(self, uri, number):
        return f"ns={self.uris.index(uri)};i={number}"

    def children(self, node):
        return {(self.uris[one["namespace"]], one["name"]): one for one in self.client.do("browse", node=node)}

    def only(self, node, type_id):
        found = [one for one in self.client.do("browse", node=node) if one["type"] == type_id]
        assert len(found) == 1, (node, found)
        return found[0]["node"]

    def folder(self, node, name):
        one = self.children(node)[(PLC, name)]
        assert one["type"] == self.id(DI, CONTAINER), one
        assert self.children(one["node"])[(DI, "SupportedTypes")]["type"] == "ns=0;i=61", one
        return one["node"]


def start(setting, *options):
    example = setting.programs.parent / "examples" / "plc"
    setting.start(setting.programs / "indurop", "run", example / "module.xml", "-q", "--node", setting.node)
    wait_for(lambda: subprocess.run([setting.programs / "indurop", "status", "--node", setting.node, "-o", "json"], check=False,
                                    env=setting.environment, capture_output=True).returncode == 0, "the node")
    server = setting.start_server(*(["--plc", example / "conveyor.xml"] if "plc" in options else []))
    return setting.client(setting.start_opcua(server, "--anonymous"))


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
    assert interval["type"] == "String" and interval["value"].startswith("T#"), interval
    (program,) = [one for one in client.do("browse", node=space.folder(resource, "Programs")) if one["name"] != "SupportedTypes"]
    assert program["name"] == "conveyor" and program["kind"] == "Object", program
    assert program["type"].startswith("ns=2;"), "CtrlProgramType is abstract"
    own = space.children(space.id(PLC, PROGRAM))
    assert program["type"] in [one["node"] for one in own.values()], own


def test_shows_the_variables_of_the_board(setting):
    client = start(setting, "plc")
    space = Space(client)
    program = f"ns=2;s={setting.node}/plc/conveyor"
    external = [one for one in client.do("browse", node=program) if one["reference"] == space.id(PLC, HAS_EXTERNAL_VAR)]
    board = client.walk(f"ns=2;s={setting.node}")
    assert external and all(one["node"] in board for one in external), external
    assert {one["name"] for one in external} >= VARIABLES and all("watch" not in one["name"] for one in external), external
    start_node = next(one["node"] for one in external if one["name"] == "start")
    client.do("monitor", nodes=[start_node])
    full = start_node.partition(f"{setting.node}/")[2]
    setting.set(full, 1)
    client.becomes(start_node, lambda one: one["value"] is True, "start to be set")


def test_plants_without_programs_have_no_model(setting):
    assert PLC not in Space(start(setting)).uris


if __name__ == "__main__":
    main(globals())
