#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What indurop-opcua sends, as tshark's dissector of OPC UA reads it: no message is malformed, and the values are those that
the client has. In a network namespace of its own. wire_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import shutil
import subprocess

from opcua_harness import enter_namespace, main, skip, wait_for

# tshark 4.4 reads the certificates, too. Those of the library have a comment in UTF-8, which once had to be in ASCII.
COMMENT = "BER Error: String with tag=22 expected but class:UNIVERSAL(0) Primitive tag:12 was unexpected"


def test_every_message_is_well_formed(setting):
    setting.start_real_node()
    server = setting.start_server()
    endpoint = setting.start_opcua(server, "--anonymous")
    port = endpoint.rsplit(":", 1)[1]
    file = setting.folder / "traffic.pcapng"
    capture = setting.start("tshark", "-q", "-i", "lo", "-f", f"tcp port {port}", "-w", file, stderr=subprocess.DEVNULL)
    wait_for(lambda: file.exists() and file.stat().st_size > 0, "the capture to begin")
    client = setting.client(endpoint)
    precise, point, text = (setting.id(f"every::{name}") for name in ("precise", "point", "text"))
    values = {node: client.read(node) for node in (precise, point, text)}
    client.walk(f"ns=2;s={setting.node}")
    part = setting.id("every::points[1].y")
    client.do("monitor", nodes=[part])
    client.becomes(part, lambda one: one["count"] > 3, "changes")
    client.do("close")
    setting.end(capture, how=2)
    as_opcua = f"tcp.port=={port},opcua"
    read = subprocess.run(["tshark", "-r", file, "-d", as_opcua, "-Y", "opcua", "-T", "json", "-e", "opcua.transport.type",
                           "-e", "opcua.servicenodeid.numeric", "-e", "opcua.Double", "-e", "opcua.String", "-e", "_ws.malformed",
                           "-e", "_ws.expert.message"], capture_output=True, text=True, check=True)
    packets = [one["_source"]["layers"] for one in json.loads(read.stdout)]
    assert len(packets) > 30, len(packets)
    malformed = [one["_ws.expert.message"] for one in packets if "_ws.malformed" in one]
    assert all(set(texts) <= {COMMENT} for texts in malformed), malformed
    types = {kind for one in packets for kind in one.get("opcua.transport.type", [])}
    assert {"HEL", "ACK", "OPN", "MSG"} <= types, types
    services = {int(kind) for one in packets for kind in one.get("opcua.servicenodeid.numeric", [])}
    assert {634, 530, 829} <= services, services  # the answers to Read, Browse and Publish
    doubles = {float(value) for one in packets for value in one.get("opcua.Double", [])}
    assert values[precise]["value"] in doubles, doubles
    texts = {value for one in packets for value in one.get("opcua.String", [])}
    assert values[text]["value"] in texts, texts


if __name__ == "__main__":
    if not shutil.which("tshark"):
        skip("tshark is missing")
    enter_namespace()
    main(globals())
