#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shared functions called over HTTP: which, with what arguments, by whom, and what is written in the audit log.
functions_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import os
import pathlib
import random
import select
import shutil
import socket
import subprocess

import harness
from harness import TOKEN, wait_for
from users_test import entries, PASSWORD, sign_in, user, Users

API = "/api/v1"
MODULE = """<root><module><filename>{file}</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></root>
"""
SHOWN = ["--call", "calc::[!s]*"]


def start(setting):
    module = pathlib.Path(os.environ["FUNCTIONS_MODULE"])
    shutil.copy(module, setting.folder)
    (setting.folder / "module.xml").write_text(MODULE.format(file=module.name))
    child = setting.start(setting.programs / "indurop", "run", "module.xml", "--node", setting.node, "-q", cwd=setting.folder,
                          stderr=subprocess.DEVNULL)
    wait_for(lambda: indurop(setting, "get", "calc::calls").returncode == 0, "the node to run")
    return child


def indurop(setting, verb, *words):
    return subprocess.run([setting.programs / "indurop", verb, "--node", setting.node, *words], capture_output=True, text=True,
                          check=False, env=setting.environment)


def call(server, setting, function, token=TOKEN, **arguments):
    """The answer to a call; a server that wants fewer calls in a second gets them later."""
    return send(server, setting, function, {"arguments": arguments}, token)


def send(server, setting, function, body, token=TOKEN):
    def once():
        answer = server.post(f"{API}/boards/{setting.node}/functions/{function}/call", body, token=token)
        return None if answer.status == 503 else answer
    return wait_for(once, "the server to take another call")


def is_served(server, setting):
    listed = server.get(f"{API}/boards/{setting.node}/functions").json()["functions"]
    return all(one["served"] for one in listed if one["name"] != "calc::nowhere")


def begin(setting, *options):
    node = start(setting)
    server = setting.start_server("--write", "--token-file", setting.tokens, "--audit", setting.folder / "audit.jsonl", *SHOWN, *options)
    wait_for(lambda: is_served(server, setting), "the functions to be served")
    return node, server


def test_only_what_is_named_is_shown(setting):
    node, server = begin(setting)
    listed = {one["name"]: one for one in server.get(f"{API}/boards/{setting.node}/functions").json()["functions"]}
    assert set(listed) == {f"calc::{name}" for name in ("add", "turn", "reset", "nap", "fails", "nowhere")}, listed
    add, turn = listed["calc::add"], listed["calc::turn"]
    assert [one["name"] for one in add["arguments"]] == ["a", "b"] and add["result"]["kind"] == "i32" and add["served"]
    assert add["description"] == "The sum of two numbers."
    assert [one["form"]["kind"] for one in turn["arguments"]] == ["struct", "enum", "text"] and turn["result"]["kind"] == "struct"
    assert listed["calc::reset"]["result"] is None and not listed["calc::nowhere"]["served"]
    assert call(server, setting, "calc::secret", a=1).status == 404
    setting.end(server.child)
    server = setting.start_server("--write", "--token-file", setting.tokens)
    assert server.get(f"{API}/boards/{setting.node}/functions").json()["functions"] == []
    assert call(server, setting, "calc::add", a=1, b=2).status == 404, "without --call there is none"
    setting.end(node)


def test_arguments_and_results_of_every_kind(setting):
    _, server = begin(setting)
    answer = call(server, setting, "calc::add", a=2, b=-7)
    assert answer.status == 200 and answer.json() == {"board": setting.node, "function": "calc::add", "result": -5}, answer.body
    assert call(server, setting, "calc::add", a="40", b="2").json()["result"] == 42
    turned = call(server, setting, "calc::turn", pair={"a": 3, "b": 2.5}, mode="FAST", text="abc").json()["result"]
    assert turned == {"a": 5, "b": -3}, turned
    raw = send(server, setting, "calc::add", {"arguments": {"a": 1, "b": 2}, "values": "bytes"}).json()["result"]
    assert raw == "03000000"
    assert indurop(setting, "get", "calc::calls").stdout.strip() == "3"
    assert call(server, setting, "calc::reset").json()["result"] is None
    assert indurop(setting, "get", "calc::calls").stdout.strip() == "0"
    said = [one for one in entries(setting) if one["action"] == "call" and one["outcome"] == "done"]
    assert said[0]["who"] == "ana" and said[0]["what"] == "calc::add a=2 b=-7", said


def test_what_cannot_be_called_says_why(setting):
    node, server = begin(setting)
    for wrong in ({}, {"a": 1}, {"a": 1, "b": 2, "c": 3}, {"a": "x", "b": 2}, {"a": 1.5, "b": 2}, {"a": 2**31, "b": 0}, {"a": None, "b": 1},
                  {"a": [1], "b": 1}, {"a": {}, "b": 1}, {"": 1, "b": 1}):
        answer = call(server, setting, "calc::add", **wrong) if "" not in wrong else send(server, setting, "calc::add", {"arguments": wrong})
        assert answer.status == 422, (wrong, answer.body)
    for body in ("", "x", "[]", "1", '{"arguments": []}', '{"arguments": 1}', '{"values": "xml"}', '{"arguments": {"a": 1', "\0"):
        answer = server.post(f"{API}/boards/{setting.node}/functions/calc::add/call", body or None)
        assert answer.status in (400, 422, 503), (body, answer.status)
    assert call(server, setting, "calc::turn", pair={"a": 1, "b": 1}, mode="NONE", text="a").status == 422
    assert call(server, setting, "calc::turn", pair={"a": 1, "b": 1}, mode="FAST", text="x" * 8).status == 422
    for name in ("calc::missing", "add", "calc::*", "..%2Fadd", "calc::add%20"):
        assert call(server, setting, name, a=1, b=2).status == 404, name
    assert call(server, setting, "calc::nowhere", a=1).status == 409
    answer = call(server, setting, "calc::fails", why=3)
    assert answer.status == 422 and "failed" in answer.json()["message"], answer.body
    assert call(server, setting, "calc::nap", ms=10).json()["result"] == 10
    answer = call(server, setting, "calc::nap", ms=1500)
    assert answer.status == 504 and "executed all the same" in answer.json()["message"], answer.body
    wait_for(lambda: call(server, setting, "calc::add", a=1, b=1).status == 200, "the module to answer again")
    assert indurop(setting, "lock", "all").returncode == 0
    assert call(server, setting, "calc::add", a=1, b=2).status == 423
    assert indurop(setting, "lock", "none").returncode == 0
    calls = int(indurop(setting, "get", "calc::calls").stdout)
    setting.end(node)
    assert call(server, setting, "calc::add", a=1, b=2).status == 409 and calls > 0
    assert server.get(f"{API}/boards/missing/functions").status == 404


def test_a_call_needs_the_role(setting):
    start(setting)
    server = setting.start_server("--write", "--users", Users(setting, anna=user("operate"), leo=user("look"),
                                                              vera=user("operate", 'variables="calc::*"')).file,
                                  "--audit", setting.folder / "audit.jsonl", *SHOWN)
    tokens = {name: sign_in(server, name) for name in ("anna", "leo", "vera")}
    wait_for(lambda: is_served_for(server, setting, tokens["leo"]), "the functions to be served")
    assert call(server, setting, "calc::add", token=tokens["anna"], a=1, b=2).json()["result"] == 3
    for name in ("leo", "vera"):
        assert call(server, setting, "calc::add", token=tokens[name], a=1, b=2).status == 403, name
    assert server.post(f"{API}/boards/{setting.node}/functions/calc::add/call", {"arguments": {"a": 1, "b": 2}}, token=None).status in (401, 403)
    done = [one for one in entries(setting) if one["action"] == "call" and one["outcome"] == "done"]
    assert [one["who"] for one in done] == ["anna"], done
    assert indurop(setting, "get", "calc::calls").stdout.strip() == "1"


def test_a_call_that_waits_is_not_executed_when_its_client_has_lost_the_right(setting):
    start(setting)
    users = Users(setting, anna=user("operate"), leo=user("operate"))
    server = setting.start_server("--write", "--users", users.file, "--audit", setting.folder / "audit.jsonl", *SHOWN)
    anna, leo = sign_in(server, "anna"), sign_in(server, "leo")
    wait_for(lambda: is_served_for(server, setting, leo), "the functions to be served")
    waiting = [begin_call(server, setting, "nap", {"ms": 100}, leo) for _ in range(8)]  # a tenth of a second each, one after the other
    last = begin_call(server, setting, "add", {"a": 1, "b": 2}, anna)
    wait_for(lambda: any(one["action"] == "call" for one in entries(setting)), "the first one to begin")
    users.write(anna=user("look"), leo=user("operate"))
    assert last.recv(4096).startswith((b"HTTP/1.1 401 ", b"HTTP/1.1 403 ")), "it has lost the right"
    for connection in [*waiting, last]:
        connection.close()
    assert indurop(setting, "get", "calc::calls").stdout.strip() == "0"
    assert {one["outcome"] for one in entries(setting) if one["who"] == "anna" and one["action"] == "call"}.isdisjoint({"begun", "done"})


def is_served_for(server, setting, token):
    listed = server.get(f"{API}/boards/{setting.node}/functions", Authorization=f"Bearer {token}").json()["functions"]
    return all(one["served"] for one in listed if one["name"] != "calc::nowhere")


def test_a_killed_server_takes_no_slot_with_it(setting):
    _, server = begin(setting)
    chance = random.Random(2)
    for _ in range(20):  # more than there are slots
        connection = begin_nap(server, setting)
        select.select([connection], [], [], chance.random() * 0.02)
        setting.end(server.child, how=9)
        connection.close()
        server = setting.start_server("--write", "--token-file", setting.tokens, *SHOWN)
    wait_for(lambda: call(server, setting, "calc::add", a=20, b=22).status == 200, "calls to be answered")
    assert call(server, setting, "calc::add", a=20, b=22).json()["result"] == 42


def begin_nap(server, setting):
    """Sends a call, and does not wait for its answer."""
    return begin_call(server, setting, "nap", {"ms": 50}, TOKEN)


def begin_call(server, setting, function, arguments, token):
    body = json.dumps({"arguments": arguments})
    text = (f"POST {API}/boards/{setting.node}/functions/calc::{function}/call HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {token}\r\n"
            f"Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n{body}")
    connection = socket.create_connection(("127.0.0.1", server.port), timeout=harness.DEADLINE_S)
    connection.sendall(text.encode())
    return connection


if __name__ == "__main__":
    harness.main(globals())
