#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Robots by the model of OPC 40010-1. The judge of what has to be there are the NodeSet files of the OPC Foundation, of the
values `indurop get`. robotics_test.py PROGRAMS FAKE_NODE [TEST...]"""

import os
import pathlib

from opcua_harness import API, main, wait_for  # first: it says where the others are
from harness import TOKEN
from nodesets import MANDATORY, NodeSets, PLACEHOLDER, UA

DI, ROBOTICS = UA + "DI/", UA + "Robotics/"
GOOD = "Good"
DEGREE, DEGREE_PER_SECOND, MILLIMETRE, MILLIMETRE_PER_SECOND = 0x4444, 0x453936, 0x4D4D54, 0x433136
OTHER, ROTARY, ROTARY_ENDLESS, LINEAR = range(4)
# A SCARA: two turning axes, a sliding one, one that turns endlessly.
SCARA = """<robot name="my_scara"><link name="base"/><link name="upper"/><link name="fore"/><link name="spindle"/><link name="tool0"/>
""" + "".join(f"""<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>
<axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="2" effort="100"/></joint>
""" for name, kind, parent, child, xyz in (
    ("shoulder", "revolute", "base", "upper", "0 0 0.4"), ("elbow", "revolute", "upper", "fore", "0.3 0 0"),
    ("quill", "prismatic", "fore", "spindle", "0.25 0 0"), ("spin", "continuous", "spindle", "tool0", "0 0 0"))) + """
<transmission name="t1"><joint name="shoulder"><hardwareInterface>any</hardwareInterface></joint></transmission></robot>
"""
NODESETS = NodeSets(pathlib.Path(os.environ["OPCUA_PACKAGES"]) / "node_modules/node-opcua-nodesets/nodesets")


class Space:
    """The server's nodes, with ids and names as those of the NodeSet files."""

    def __init__(self, client):
        self.client = client
        self.uris = client.read("i=2255")["value"]
        self.below = {}

    def neutral(self, text):
        space, _, rest = text.rpartition(";")
        return self.uris[int(space[len("ns="):] or 0)], rest

    def children(self, node):
        if node not in self.below:
            self.below[node] = [one | {"name": (self.uris[one["namespace"]], one["name"]), "type": self.neutral(one["type"])}
                                for one in self.client.do("browse", node=node)]
        return self.below[node]

    def member(self, node, *names):
        """The node of a path of names, of whatever namespaces."""
        for name in names:
            node = next(one["node"] for one in self.children(node) if one["name"][1] == name)
        return node

    def systems(self):
        if DI not in self.uris:
            return []
        objects = self.children("i=85")
        device_set = next(one["node"] for one in objects if one["name"] == (DI, "DeviceSet"))
        system = NODESETS.named(ROBOTICS, "MotionDeviceSystemType")
        return [one["node"] for one in self.children(device_set) if one["type"] == system]

    def attribute(self, node, name):
        return self.client.read(node, attribute=name)["value"]


class Checker:
    """Compares instances with what their types demand."""

    def __init__(self, space):
        self.space, self.seen, self.checked, self.instances = space, set(), 0, {}

    def check(self, node, type_id, declaration=None):
        if (node, declaration) in self.seen:
            return
        self.seen.add((node, declaration))
        children = self.space.children(node)
        for name, (declared, rule) in NODESETS.demanded(type_id, declaration).items():
            if rule == MANDATORY:
                found = [one for one in children if one["name"] == name]
                assert len(found) == 1, f"{node}: {len(found)} of the mandatory {name[1]}"
                self.check_as(found[0], declared)
            elif rule == PLACEHOLDER:
                wanted = self.type_of(declared)
                found = [one for one in children if one["type"][0] and NODESETS.is_a(one["type"], wanted)]
                assert found, f"{node}: none for {name[1]}"
                for one in found:
                    self.check_as(one, declared)
        for one in children:  # also what is optional, with what it demands itself
            if one["kind"] in ("Object", "Variable"):
                self.instances.setdefault(one["type"], set()).add(one["node"])
                self.check(one["node"], one["type"])

    @staticmethod
    def type_of(declared):
        return NODESETS.first(declared, (UA, "i=40"))

    def check_as(self, found, declared):
        """A node that exists is of the type that its declaration has."""
        want, node = NODESETS.nodes[declared], found["node"]
        self.checked += 1
        assert found["kind"] == want.kind, (node, found["kind"])
        if want.kind == "Method":
            return
        assert NODESETS.is_a(found["type"], self.type_of(declared)), (node, found["type"])
        if want.kind == "Variable":
            assert NODESETS.is_a(self.space.neutral(self.space.attribute(node, "DataType")), want.data_type), node
            assert self.space.attribute(node, "ValueRank") == want.rank, node
            self.check_value(node, want)
        self.check(node, found["type"], declared)

    def check_value(self, node, want):
        one = self.space.client.read(node)
        assert one["code"] == GOOD, (node, one)
        if want.name[1] == "MotorTemperature":
            assert one["value"] is None, "the model says null if there is no sensor"
            return
        assert one["value"] is not None or one["type"] == "LocalizedText", (node, one)  # an empty one is encoded as none
        fields = NODESETS.nodes[want.data_type].fields
        if fields:
            assert one["type"] == "Int32" and one["value"] in fields, (node, one)
        elif want.data_type[0] == UA:
            base = {"i=1": "Boolean", "i=11": "Double", "i=12": "String", "i=21": "LocalizedText", "i=17": "NodeId"}
            assert one["type"] == base.get(want.data_type[1], "ExtensionObject"), (node, one)


class Shown:
    """The robot of a board, as a client finds it: by names, from DeviceSet."""

    def __init__(self, client):
        space = self.space = Space(client)
        self.system, = space.systems()
        self.device = self.only(self.system, "MotionDevices")
        self.safety = self.only(self.system, "SafetyStates")
        self.controller = self.only(self.system, "Controllers")
        self.task = self.only(self.controller, "TaskControls")
        self.axes = self.objects(self.device, "Axes")

    def objects(self, node, folder):
        return [one["node"] for one in self.space.children(self.space.member(node, folder)) if one["kind"] == "Object"]

    def only(self, node, folder):
        found, = self.objects(node, folder)
        return found

    def parameter(self, node, name):
        return self.space.member(node, "ParameterSet", name)

    def axis(self, number, name):
        return self.parameter(self.axes[number], name)


def begin(setting, *options, **more):
    node = setting.start_robot(**more)
    server = setting.start_server(*options)
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    return node, server, client


def test_every_mandatory_node_exists(setting):
    _, server, client = begin(setting)
    space = Space(client)
    system, = space.systems()
    checker = Checker(space)
    checker.check(system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))
    number = {name: len(checker.instances.get(NODESETS.named(ROBOTICS, name + "Type"), ())) for name in (
        "Controller", "MotionDevice", "Axis", "PowerTrain", "Motor", "TaskControl", "SafetyState", "User")}
    assert number == {"Controller": 1, "MotionDevice": 1, "Axis": 6, "PowerTrain": 6, "Motor": 6, "TaskControl": 1, "SafetyState": 1,
                      "User": 1}, number
    assert checker.checked > 100, checker.checked
    print(f"    {checker.checked} mandatory nodes")
    writable = [node for nodes in checker.instances.values() for node in nodes
                if node.startswith("ns=2;s=") and (space.attribute(node, "UserAccessLevel") or 1) & 2]
    assert not writable, writable
    shown = Shown(client)
    software = shown.only(shown.controller, "Software")
    assert client.read(space.member(software, "SoftwareRevision"))["value"] == server.get(f"{API}/status").json()["version"]
    assert client.read(space.member(shown.device, "Model"))["value"] == "cell_arm"
    assert client.read(space.member(shown.device, "MotionDeviceCategory"))["value"] == 1, "ARTICULATED_ROBOT"
    assert client.read(space.member(shown.device, "TaskControlReference"))["value"] == shown.task
    assert shown.task in {one["node"] for one in space.children(space.member(shown.controller, "TaskControls"))}
    links = {NODESETS.nodes[space.neutral(one["reference"])].name[1] for one in space.children(shown.controller)}
    assert {"Controls", "HasSafetyStates"} <= links, links


def move(setting):
    """All axes to different positions."""
    target = [20, 10, -15, 30, 25, -40]
    ask = lambda **fields: setting.set("PLC_ROBOT::ROBOT_MODULE_SERVICE", "{" + ", ".join(
        f"{name}: {value}" for name, value in dict(fields, nRequest=setting.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge") + 1).items()) + "}")
    state = lambda: setting.get("PLC_ROBOT::ROBOT_MODULE_STATE.eState")
    ask(eOpCode="SVC_AD_GROUP_ENABLE")
    wait_for(lambda: state() in (1, "ROBOT_GROUP_STANDBY"), "power")
    ask(eOpCode="SVC_MV_DIRECT_ABSOLUTE", dTarget=target, dVelocity=50)
    wait_for(lambda: abs(setting.get("PLC_ROBOT::ROBOT_ARM.joint")[5] + 40) < 0.1 and state() in (1, "ROBOT_GROUP_STANDBY"), "the arm to arrive")


def test_values_are_those_of_the_board(setting):
    _, _, client = begin(setting)
    shown = Shown(client)
    moving = shown.axis(5, "ActualPosition")
    speed = shown.axis(5, "ActualSpeed")
    control = shown.parameter(shown.device, "InControl")
    client.do("monitor", nodes=[moving, speed, control])
    client.becomes(control, lambda one: one["value"] is False, "no power")
    move(setting)
    client.becomes(control, lambda one: one["value"] is True, "power")
    last = client.becomes(moving, lambda one: abs(one["value"] + 40) < 0.1, "the last position")
    assert last["count"] > 3 and client.becomes(speed, lambda one: one["value"] == 0, "no speed")["count"] > 3
    for number in range(6):
        state = f"PLC_ROBOT::AXIS_STATE[{number}]"
        for name, field, unit in (("ActualPosition", "dPosition", DEGREE), ("ActualSpeed", "dActualVelocity", DEGREE_PER_SECOND)):
            node = shown.axis(number, name)
            one, own = client.do("read", nodes=[node, setting.id(f"{state}.{field}")])
            assert one["value"] == setting.get(f"{state}.{field}"), (number, name, one)
            assert (one["value"], one["code"], one["source"]) == (own["value"], own["code"], own["source"]), (one, own)
            assert client.read(shown.space.member(node, "EngineeringUnits"))["value"]["unitId"] == unit
        assert client.read(shown.space.member(shown.axes[number], "MotionProfile"))["value"] == ROTARY
        assert shown.space.attribute(shown.axes[number], "DisplayName") == f"joint{number + 1}"
    override = client.read(shown.parameter(shown.device, "SpeedOverride"))
    assert override["value"] == setting.get("PLC_ROBOT::ROBOT_OVERRIDE") == 100, override


def test_the_mode_and_stops_follow_the_cell(setting):
    _, _, client = begin(setting)
    shown = Shown(client)
    mode, emergency, protective = (shown.parameter(shown.safety, name) for name in ("OperationalMode", "EmergencyStop", "ProtectiveStop"))
    client.do("monitor", nodes=[mode, emergency, protective])
    names = NODESETS.nodes[NODESETS.named(ROBOTICS, "OperationalModeEnumeration")].fields
    become = lambda name: client.becomes(mode, lambda one: one["code"] == GOOD and names[one["value"]] == name, name)
    first = become("OTHER")
    setting.set("PLC_ROBOT::ROBOT_MODE.eMode", "ROBOT_MODE_AUTOMATIC")
    later = become("AUTOMATIC")
    assert later["source"] > first["source"] and client.read(mode)["value"] == 3
    setting.set("PLC_ROBOT::ROBOT_MODE.eMode", "ROBOT_MODE_MANUAL")
    become("MANUAL_REDUCED_SPEED")
    stops = lambda: tuple(client.do("changes")[node]["value"] for node in (emergency, protective))
    wait_for(lambda: stops() == (False, False), "no stop")
    setting.set("PLC_ROBOT::I14", 0)
    wait_for(lambda: stops() == (True, False), "the emergency stop")
    setting.set("PLC_ROBOT::I14", 1)
    setting.set("PLC_ROBOT::I15", 0)
    wait_for(lambda: stops() == (False, True), "the light curtain")
    setting.set("PLC_ROBOT::I15", 1)
    wait_for(lambda: stops() == (False, False), "no stop")


def test_the_job_that_runs(setting):
    _, _, client = begin(setting)
    shown = Shown(client)
    name, loaded = (shown.parameter(shown.task, one) for one in ("TaskProgramName", "TaskProgramLoaded"))
    client.do("monitor", nodes=[name, loaded])
    client.becomes(loaded, lambda one: one["value"] is False, "no job")
    assert client.read(name)["value"] == setting.get("PLC_ROBOT::ROBOT_JOB.name") == ""
    move(setting)
    request = setting.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge") + 1
    setting.set("PLC_ROBOT::ROBOT_MODULE_SERVICE", f"{{eOpCode: SVC_JB_START, nJob: 1, nRequest: {request}}}")
    client.becomes(name, lambda one: one["value"] == "wait", "the job")
    assert client.becomes(loaded, lambda one: one["value"] is True, "the job to be loaded")["count"] == 2
    assert client.read(name)["value"] == setting.get("PLC_ROBOT::ROBOT_JOB.name")


def test_quality(setting):
    node, server, client = begin(setting, "--write", "--token-file", setting.tokens)
    shown = Shown(client)
    override, mode = shown.parameter(shown.device, "SpeedOverride"), shown.parameter(shown.safety, "OperationalMode")
    client.do("monitor", nodes=[override, mode])
    forces = f"{API}/boards/{setting.node}"
    assert server.post(f"{forces}/force", {"values": {"PLC_ROBOT::ROBOT_OVERRIDE": 40}}, TOKEN).status == 200
    assert client.becomes(override, lambda one: one["code"] == "GoodLocalOverride", "the force")["value"] == 40
    assert server.post(f"{forces}/release", {"all": True}, TOKEN).status == 200
    client.becomes(override, lambda one: one["code"] == GOOD, "no force")
    setting.end(node)
    for one in (override, mode):
        assert client.becomes(one, lambda now: now["code"] == "BadOutOfService", "the node to be stopped")["value"] is None
    setting.end(server.child)
    client.becomes(mode, lambda one: one["code"] == "BadNoCommunication", "the server to be lost")
    assert client.read(override)["code"] == "BadNoCommunication"


def test_another_arm(setting):
    node, _, client = begin(setting, urdf=SCARA)
    shown = Shown(client)
    space = shown.space
    assert [space.attribute(axis, "DisplayName") for axis in shown.axes] == ["shoulder", "elbow", "quill", "spin"]
    profiles = [client.read(space.member(axis, "MotionProfile"))["value"] for axis in shown.axes]
    assert profiles == [ROTARY, ROTARY, LINEAR, ROTARY_ENDLESS], profiles
    units = [[client.read(space.member(shown.axis(number, name), "EngineeringUnits"))["value"]["unitId"] for number in (1, 2)]
             for name in ("ActualPosition", "ActualSpeed")]
    assert units == [[DEGREE, MILLIMETRE], [DEGREE_PER_SECOND, MILLIMETRE_PER_SECOND]], units
    assert client.read(space.member(shown.device, "MotionDeviceCategory"))["value"] == 0, "OTHER"
    Checker(space).check(shown.system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))
    # The same variables, another arm.
    position = shown.axis(3, "ActualPosition")
    client.do("monitor", nodes=[position])
    end = lambda: setting.end(node) is not None and client.becomes(position, lambda one: one["code"] == "BadOutOfService", "the end")
    end()
    node = setting.start_robot()
    wait_for(lambda: len(Shown(client).axes) == 6, "six axes")
    assert Shown(client).axis(3, "ActualPosition") == position
    client.becomes(position, lambda one: one["code"] == GOOD, "values to go on")
    end()
    setting.start_robot(urdf=SCARA)
    wait_for(lambda: len(Shown(client).axes) == 4, "four axes")
    Checker(shown.space).check(shown.system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))


def test_two_robots(setting):
    """They have a controller and the emergency stop of the cell in common."""
    _, _, client = begin(setting, second=os.environ["SEVEN_AXES"])
    wait_for(lambda: setting.get("PLC_ROBOT2::ROBOT_MODULE_STATE.nAXESGROUP") == 7, "the second robot")
    space = wait_for(lambda: (one := Space(client)) and len(one.children(one.member(one.systems()[0], "MotionDevices"))) == 2 and one,
                     "two robots")
    system, = space.systems()
    Checker(space).check(system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))
    axes = {name: len(space.children(space.member(system, "MotionDevices", name, "Axes"))) for name in ("PLC_ROBOT", "PLC_ROBOT2")}
    assert axes == {"PLC_ROBOT": 6, "PLC_ROBOT2": 7}, axes
    setting.set("PLC_ROBOT::I14", 0)
    for name in axes:
        stop = space.member(system, "SafetyStates", name, "ParameterSet", "EmergencyStop")
        wait_for(lambda stop=stop: client.read(stop)["value"] is True, f"the emergency stop of {name}")


def test_a_deployment_without_the_robot(setting):
    node, _, client = begin(setting)
    shown = Shown(client)
    position, mode = shown.axis(0, "ActualPosition"), shown.parameter(shown.safety, "OperationalMode")
    client.do("monitor", nodes=[position, mode])
    for one in (position, mode):
        client.becomes(one, lambda now: now["code"] == GOOD, "a value")
    setting.end(node)
    node = setting.start_real_node()
    for one in (position, mode):
        client.becomes(one, lambda now: now["code"] == "BadNodeIdUnknown", "the robot to be gone")
    wait_for(lambda: Space(client).systems() == [], "no robot")
    setting.end(node)
    setting.start_robot()
    for one in (position, mode):
        client.becomes(one, lambda now: now["code"] == GOOD, "the robot to be back")
    again = Shown(client)
    assert (again.system, again.axis(0, "ActualPosition")) == (shown.system, position)
    Checker(again.space).check(again.system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))


def test_a_plant_without_a_robot_has_none_of_it(setting):
    setting.start_real_node()
    client = setting.client(setting.start_opcua(setting.start_server(), "--anonymous"))
    uris = client.read("i=2255")["value"]
    assert len(uris) == 3 and uris[2] == "urn:indurop:boards", uris
    assert not [one for one in client.do("browse", node="i=85") if one["name"] == "DeviceSet"]


def test_a_robot_that_comes_later(setting):
    """The types are loaded while clients are connected."""
    node = setting.start_real_node()
    client = setting.client(setting.start_opcua(setting.start_server(), "--anonymous"))
    flag = setting.id("every::flag")
    client.do("monitor", nodes=[flag])
    client.becomes(flag, lambda one: one["code"] == GOOD, "a value")
    setting.end(node)
    setting.start_robot()
    wait_for(lambda: Space(client).systems(), "the robot")
    shown = Shown(client)
    Checker(shown.space).check(shown.system, NODESETS.named(ROBOTICS, "MotionDeviceSystemType"))
    assert client.read(shown.axis(0, "ActualPosition"))["code"] == GOOD
    metadata = {one["name"] for one in client.do("browse", node="i=11715")}
    assert {DI, ROBOTICS} <= metadata, metadata


if __name__ == "__main__":
    main(globals())
