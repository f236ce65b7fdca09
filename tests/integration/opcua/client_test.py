#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Variables of another server as points of ioconfig.xml, through indurop-opcua --client: values of each type, qualities, outputs,
servers and programs that end. client_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import os
import pathlib
import shutil
import signal
import subprocess

from opcua_harness import HERE, main, wait_for

PERIODIC = """<module><filename>{file}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
<period>{period}</period><priority>{priority}</priority>{more}</module>
"""
GOOD, LOST, REFUSED, OUT_OF_RANGE, REPORTED = 1, 2, 3, 4, 6


class Foreign:
    """A server with a variable of each type of number."""

    def __init__(self, setting, port=0):
        self.setting = setting
        self.child = setting.start("node", HERE / "foreign.mjs", os.environ["OPCUA_PACKAGES"], setting.folder, port,
                                   stdin=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.port = int(self.child.stdout.readline())
        self.url = f"opc.tcp://127.0.0.1:{self.port}"

    def do(self, what, **words):
        self.child.stdin.write(json.dumps({"do": what, **words}) + "\n")
        self.child.stdin.flush()
        return json.loads(self.child.stdout.readline())["done"]

    def set(self, name, value, status="Good"):
        self.do("set", name=name, value=value, status=status)

    def get(self, name):
        return self.do("get", name=name)


class Cell:
    """A node whose I/O module has points at a server, and the program between them."""

    def __init__(self, setting, url, points, *options, attributes="security='none'"):
        self.setting = setting
        self.socket = setting.folder / "client.sock"
        self.options = options
        self.start_program()
        (setting.folder / "ioconfig.xml").write_text(
            f"<ioconfig><device name='press' driver='opcua' address='{url}' cycle='20ms' socket='{self.socket}' quality='every::numbers[0]' "
            f"{attributes}>{points}</device></ioconfig>\n")
        every = pathlib.Path(os.environ["OPCUA_MODULE"])
        shutil.copy(every, setting.folder)
        io = PERIODIC.format(file=os.environ["IO_MODULE"], period="5ms", priority=1,
                             more="<property><value name='config'>ioconfig.xml</value></property>")
        declares = PERIODIC.format(file=every.name, period="5ms", priority=2, more="")
        (setting.folder / "module.xml").write_text(f"<root>{io}{declares}</root>")
        self.log = setting.folder / "node.log"
        self.node = setting.start("sh", "-c", 'exec "$0" "$@" >node.log 2>&1', setting.programs / "indurop", "run", "module.xml", "--node",
                                  setting.node, cwd=setting.folder)

    def start_program(self):
        with self.setting.log.open("a") as log:
            self.program = self.setting.start("node", self.setting.programs / "indurop-opcua", "--client", "--socket", self.socket, "--state",
                                              self.setting.folder / "opcua", *self.options, stderr=log)
        assert self.program.stdout.readline().strip() == str(self.socket), self.setting.log.read_text()

    def value(self, name):
        return self.setting.get(f"every::{name}")

    def said(self, text):
        wait_for(lambda: self.log.exists() and text in self.log.read_text(), f"the node to print: {text}")

    def becomes(self, name, value):
        try:
            wait_for(lambda: self.value(name) == value, f"{name} = {value}")
        except AssertionError:
            print(name, self.value(name), self.log.read_text())
            raise


def point(kind, variable, node, **more):
    words = "".join(f" {name}='{value}'" for name, value in more.items())
    return f"<{kind} variable='every::{variable}' at='{node}'{words}/>"


INPUTS = {"flag": ("Boolean", True), "tiny": ("SByte", -128), "byte": ("Byte", 255), "small": ("Int16", -32768), "word": ("UInt16", 65535),
          "whole": ("Int32", -2147483648), "natural": ("UInt32", 4294967295), "wide": ("Int64", -9223372036854775807),
          "huge": ("UInt64", 18446744073709551615), "single": ("Float", 0.1), "precise": ("Double", 0.1)}


def test_inputs_of_each_type_have_all_their_digits(setting):
    foreign = Foreign(setting)
    for node, value in INPUTS.values():
        foreign.set(node, str(value) if "Int64" in node else value)
    cell = Cell(setting, foreign.url, "".join(point("input", name, f"ns=2;s={node}") for name, (node, _) in INPUTS.items())
                + point("input", "point.x", "nsu=urn:maker:press;s=Double", scale=10, offset=1))
    cell.becomes("numbers[0]", GOOD)
    for name, (_, value) in INPUTS.items():
        read = cell.value(name)
        assert int(read) == value if isinstance(value, int) else abs(read - value) < 1e-8, (name, read, value)
    assert cell.value("precise") == 0.1 and cell.value("point.x") == 2
    foreign.set("Double", -1e300)
    cell.becomes("precise", -1e300)


def test_outputs_arrive_in_the_type_of_the_node(setting):
    foreign = Foreign(setting)
    names = {"wide": "Int64", "huge": "UInt64", "precise": "Double", "flag": "Boolean", "whole": "Int16", "natural": "Byte", "matrix[0][0]": "Float"}
    cell = Cell(setting, foreign.url, "".join(point("output", name, f"ns=2;s={node}") for name, node in names.items())
                + point("output", "matrix[0][1]", "ns=2;s=Int32", quality="every::numbers[1]", stop=-7))
    cell.becomes("numbers[1]", GOOD)
    for name, value, node, arrives in [("wide", -9007199254740995, "Int64", "-9007199254740995"), ("huge", 18446744073709551614, "UInt64", "18446744073709551614"),
                                       ("precise", 0.1, "Double", 0.1), ("flag", "false", "Boolean", False), ("flag", "true", "Boolean", True),
                                       ("whole", -12, "Int16", -12), ("natural", 255, "Byte", 255), ("matrix[0][0]", 0.5, "Float", 0.5),
                                       ("matrix[0][1]", 2.6, "Int32", 3)]:
        setting.set(f"every::{name}", value)
        wait_for(lambda: foreign.get(node) == arrives, f"{node} = {arrives}, not {foreign.get(node)}")
    setting.set("every::matrix[0][1]", 1e12)  # the nearest that the node can hold
    cell.becomes("numbers[1]", OUT_OF_RANGE)
    assert foreign.get("Int32") == 2147483647
    setting.end(cell.node)
    wait_for(lambda: foreign.get("Int32") == -7, "the value for a node that stops")


def test_quality_is_that_of_the_server(setting):
    foreign = Foreign(setting)
    cell = Cell(setting, foreign.url, point("input", "precise", "ns=2;s=Double", quality="every::numbers[1]", bad="-1")
                + point("output", "single", "ns=2;s=Fixed", quality="every::numbers[2]") + point("input", "byte", "ns=2;s=Byte", quality="every::word"))
    foreign.set("Double", 5)
    cell.becomes("precise", 5)
    cell.becomes("numbers[2]", REFUSED)  # it can only be read
    cell.becomes("numbers[0]", REFUSED)
    assert cell.value("numbers[1]") == GOOD and cell.value("word") == GOOD
    cell.said("writing ns=2;s=Fixed: BadNotWritable")
    for status in ("BadSensorFailure", "UncertainLastUsableValue", "BadNoCommunication"):
        foreign.set("Double", 6, status)
        cell.becomes("numbers[1]", REPORTED)
        cell.becomes("precise", -1)
        assert cell.value("word") == GOOD
        foreign.set("Double", 5)
        cell.becomes("precise", 5)
        cell.becomes("numbers[1]", GOOD)
    foreign.set("Double", "NaN")
    cell.becomes("numbers[1]", OUT_OF_RANGE)
    cell.becomes("precise", -1)


def test_points_that_the_server_does_not_have(setting):
    foreign = Foreign(setting)
    foreign.set("Double", 5)
    others = ["ns=2;s=Nothing", "nsu=urn:unknown;s=Double", "ns=2;s=String", "ns=2;s=List"]
    cell = Cell(setting, foreign.url, point("input", "precise", "ns=2;s=Double") + "".join(
        point("input", f"matrix[0][{i}]" if i < 3 else "matrix[1][0]", node, quality=f"every::{quality}")
        for i, (node, quality) in enumerate(zip(others, ["numbers[1]", "numbers[2]", "word", "byte"]))))
    for quality in ("numbers[1]", "numbers[2]", "word", "byte"):
        cell.becomes(quality, REFUSED)
    cell.becomes("precise", 5)  # the others are read all the same


def test_a_server_that_ends_is_noticed_and_found_again(setting):
    foreign = Foreign(setting)
    foreign.set("Double", 5)
    cell = Cell(setting, foreign.url, point("input", "precise", "ns=2;s=Double", quality="every::numbers[1]", bad="-1")
                + point("output", "single", "ns=2;s=Float"))
    cell.becomes("precise", 5)
    for how in (signal.SIGKILL, signal.SIGTERM):
        setting.end(foreign.child, how)
        cell.becomes("numbers[1]", LOST)
        cell.becomes("precise", -1)
        setting.set("every::single", 0.25)
        foreign = Foreign(setting, foreign.port)
        foreign.set("Double", 7)
        cell.becomes("precise", 7)
        cell.becomes("numbers[0]", GOOD)
        wait_for(lambda: foreign.get("Float") == 0.25, "the output")
        setting.set("every::single", 0.5)
    foreign.child.send_signal(signal.SIGSTOP)  # hangs
    cell.becomes("numbers[1]", LOST)
    foreign.child.send_signal(signal.SIGCONT)
    cell.becomes("numbers[1]", GOOD)


def test_the_program_may_be_killed_and_come_later(setting):
    foreign = Foreign(setting)
    foreign.set("Double", 5)
    cell = Cell(setting, foreign.url, point("input", "precise", "ns=2;s=Double", quality="every::numbers[1]"))
    cell.becomes("numbers[1]", GOOD)
    setting.end(cell.program, signal.SIGKILL)
    cell.becomes("numbers[1]", LOST)
    cell.said("indurop-opcua --client has ended; trying again")
    cell.start_program()  # at the socket that the killed one left
    cell.becomes("numbers[1]", GOOD)
    second = subprocess.run([setting.programs / "indurop-opcua", "--client", "--socket", cell.socket, "--state", setting.folder / "second"],
                            capture_output=True, text=True, check=False, timeout=60)
    assert second.returncode == 1 and "another indurop-opcua --client" in second.stderr, second
    cell.program.send_signal(signal.SIGSTOP)
    cell.becomes("numbers[1]", LOST)
    cell.program.send_signal(signal.SIGCONT)
    cell.becomes("numbers[1]", GOOD)
    setting.end(cell.node, signal.SIGKILL)
    wait_for(lambda: foreign.do("sessions") == 0, "the session of a killed node to end")


def test_a_certificate_is_trusted_by_a_person_and_a_user_has_a_password(setting):
    foreign = Foreign(setting)
    foreign.set("Double", 5)
    passwords = setting.folder / "passwords"
    passwords.write_text("anna of the press\n")
    passwords.chmod(0o600)
    cell = Cell(setting, foreign.url, point("input", "precise", "ns=2;s=Double"), "--password-file", passwords, attributes="user='anna'")
    cell.said("BadCertificateUntrusted")
    assert cell.value("numbers[0]") != GOOD
    folder = setting.folder / "opcua/client"
    rejected = wait_for(lambda: list((folder / "rejected").glob("*.pem")), "the certificate")
    for file in rejected:
        file.rename(folder / "trusted/certs" / file.name)
    cell.becomes("precise", 5)
    passwords.write_text("anna wrong\n")
    setting.end(cell.program)
    cell.start_program()
    cell.becomes("numbers[0]", LOST)
    wait_for(lambda: "BadUserAccessDenied" in setting.log.read_text(), "the program to say why")


def test_our_own_server_is_a_server_as_well(setting):
    setting.start_node()
    endpoint = setting.start_opcua(setting.start_server(), "--anonymous")
    other = setting.node
    setting.node = f"{other}_2"
    cell = Cell(setting, endpoint, point("input", "precise", f"ns=2;s={other}/knu::Robot::gain"))
    cell.becomes("numbers[0]", GOOD)
    setting.node = other


main(globals())
