#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What indurop-mqtt sends, as tshark's dissectors of MQTT and Sparkplug B read it: no message is malformed, and the topics
are those of the specification. In a network namespace of its own. wire_test.py PROGRAMS FAKE_NODE [TEST...]"""

import ctypes
import json
import shutil
import subprocess

from mqtt_harness import main, skip, wait_for

CLONE_NEWNET = 0x40000000


def enter_namespace():
    """A loopback without other traffic."""
    if not shutil.which("ip"):
        skip("ip is missing")
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNET) != 0:
        skip("no right to network namespaces")
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


def published_topics(file, port):
    """The topics of the messages captured so far: frames reach the file some time after they were sent."""
    read = subprocess.run(["tshark", "-r", file, "-d", f"tcp.port=={port},mqtt", "-Y", "mqtt.msgtype == 3", "-T", "fields", "-e", "mqtt.topic"],
                          capture_output=True, check=False)
    return read.stdout


def test_every_message_is_well_formed(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    setting.start_broker()
    file = setting.folder / "traffic.pcapng"
    capture = setting.start("tshark", "-q", "-i", "lo", "-f", f"tcp port {setting.port}", "-w", file, stderr=subprocess.DEVNULL)
    wait_for(lambda: file.exists() and file.stat().st_size > 0, "the capture to begin")
    door = setting.start_door(server, "--sparkplug", "plant", "--edge-node", "edge", "--token-file", setting.tokens)
    client = setting.subscribe("indurop/#")
    gain = f"indurop/{setting.node}/values/knu/Robot/gain"
    client.becomes(gain, lambda one: one["value"] == 1, "a value")
    setting.publish(f"indurop/{setting.node}/set/ana/knu/Robot/gain", "3")
    client.becomes(gain, lambda one: one["value"] == 3, "the value")
    setting.end(door)
    client.becomes("indurop/online", lambda one: one is False, "its end")
    wait_for(lambda: b"/NDEATH/edge" in published_topics(file, setting.port), "the last message in the capture")
    setting.end(capture, how=2)
    read = subprocess.run(["tshark", "-r", file, "-d", f"tcp.port=={setting.port},mqtt", "-Y", "mqtt", "-T", "json", "-e", "mqtt.topic", "-e",
                           "mqtt.msgtype", "-e", "mqtt.willtopic", "-e", "sparkplugb.messagetype", "-e", "sparkplugb.groupid", "-e", "sparkplugb.edgenodeid", "-e",
                           "sparkplugb.deviceid", "-e", "protobuf.field.number", "-e", "_ws.malformed", "-e", "_ws.expert.message"],
                          capture_output=True, text=True, check=True)
    packets = [one["_source"]["layers"] for one in json.loads(read.stdout)]
    assert len(packets) > 30, len(packets)
    assert not [one for one in packets if "_ws.malformed" in one], "tshark calls none malformed"
    assert "spBv1.0/plant/NDEATH/edge" in [topic for one in packets for topic in one.get("mqtt.willtopic", [])]
    spark = [one for one in packets if "sparkplugb.messagetype" in one]
    kinds = [kind for one in spark for kind in one["sparkplugb.messagetype"]]
    assert kinds[0] == "NBIRTH" and {"NBIRTH", "DBIRTH", "DDATA", "NDEATH"} == set(kinds), set(kinds)
    assert {name for one in spark for name in one["sparkplugb.groupid"]} == {"plant"}
    assert {name for one in spark for name in one["sparkplugb.edgenodeid"]} == {"edge"}
    assert {name for one in spark for name in one.get("sparkplugb.deviceid", [])} == {setting.node}
    assert all({"1", "2"} <= set(one["protobuf.field.number"]) for one in spark), "each payload has a time and metrics, or only a time"


if __name__ == "__main__":
    if not shutil.which("tshark"):
        skip("tshark is missing")
    enter_namespace()
    main(globals())
