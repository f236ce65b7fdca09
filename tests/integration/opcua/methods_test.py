#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Shared functions as methods, called by node-opcua's client: arguments and results, roles, the journal.
methods_test.py PROGRAMS FAKE_NODE [TEST...]"""

from opcua_harness import API, main, wait_for  # first: it says where the others are
import functions_test
from functions_test import indurop, SHOWN
from users_test import entries, PASSWORD, user, Users

SECURE = {"mode": "SignAndEncrypt", "policy": "Basic256Sha256"}


def begin(setting, **users):
    node = functions_test.start(setting)
    server = setting.start_server("--write", "--users", Users(setting, **users).file, "--audit", setting.folder / "audit.jsonl", *SHOWN)
    wait_for(lambda: all(one["served"] for one in server.get(f"{API}/boards/{setting.node}/functions").json()["functions"]
                         if one["name"] != "calc::nowhere"), "the functions to be served")
    return node, server, setting.start_opcua(server, "--anonymous")


def invoke(client, setting, name, *words, **more):
    """A method's answer; a server that wants fewer calls in a second gets them later."""
    def once():
        answer = client.do("invoke", object=setting.id("calc"), method=setting.id(f"calc::{name}()"), words=list(words), **more)
        return None if answer["code"] == "BadResourceUnavailable" else answer
    return wait_for(once, "the server to take another call")


def test_methods_have_typed_arguments_and_a_result(setting):
    _, _, endpoint = begin(setting, anna=user("operate"))
    client = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    names = {one["name"] for one in client.do("browse", node=setting.id("calc"))}
    assert {"add", "turn", "reset", "nap", "fails", "nowhere"} <= names and "secret" not in names, names
    answer = invoke(client, setting, "add", 40, 2)
    assert answer == {"code": "Good", "outputs": [42], "inputs": ["a", "b"], "results": ["result"]}, (answer, setting.log.read_text())
    answer = invoke(client, setting, "turn", {"a": [0, 3], "b": 2.5}, 1, "abc")
    assert answer["code"] == "Good" and answer["outputs"][0]["a"] == [0, 5] and answer["outputs"][0]["b"] == -3, (answer, setting.log.read_text())
    answer = invoke(client, setting, "reset")
    assert answer["code"] == "Good" and answer["outputs"] == [] and answer["results"] == [], answer
    assert indurop(setting, "get", "calc::calls").stdout.strip() == "0"
    assert client.read(setting.id("calc::add()"), attribute="Description")["value"] == "The sum of two numbers."


def test_methods_are_called_by_those_who_may(setting):
    _, _, endpoint = begin(setting, anna=user("operate"), leo=user("look"))
    leo = setting.client(endpoint, user="leo", password=PASSWORD, **SECURE)
    anonymous = setting.client(endpoint)
    for client in (leo, anonymous):
        assert invoke(client, setting, "add", 1, 2)["code"] == "BadUserAccessDenied"
    anna = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    assert invoke(anna, setting, "add", 1, 2)["code"] == "Good"
    done = [one for one in entries(setting) if one["action"] == "call" and one["outcome"] == "done"]
    assert [(one["who"], one["reason"], one["what"]) for one in done] == [("anna", "OPC UA", "calc::add a=1 b=2")], done


def test_what_cannot_be_called_says_why(setting):
    node, server, endpoint = begin(setting, anna=user("operate"))
    client = setting.client(endpoint, user="anna", password=PASSWORD, **SECURE)
    code = lambda *words, **more: invoke(client, setting, *words, **more)["code"]
    assert code("add", 1) == "BadArgumentsMissing"
    assert code("add", 1, 2, 3) == "BadTooManyArguments"
    assert code("add", "1", 2, types=["String", "Int32"]) == "BadInvalidArgument"
    assert code("turn", {"a": [0, 1], "b": 1}, 7, "abc") == "BadInvalidArgument", "no such enumerator"
    assert code("turn", {"a": [0, 1], "b": 1}, 1, "x" * 9) == "BadInvalidArgument"
    assert code("fails", 1) == "BadInvalidArgument"
    assert code("nowhere", 1) == "BadNotImplemented"
    assert code("nap", 1500) == "BadTimeout"
    wait_for(lambda: code("add", 1, 1) == "Good", "the module to answer again")
    setting.end(node)
    assert code("add", 1, 2) == "BadNotImplemented"
    setting.end(server.child)
    assert code("add", 1, 2) == "BadNoCommunication"


if __name__ == "__main__":
    main(globals())
