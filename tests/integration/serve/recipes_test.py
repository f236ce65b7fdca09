#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Recipes over HTTP and on the command line, of a node that runs and of one that does not. recipes_test.py PROGRAMS FAKE_NODE
[TEST...]"""

import json
import pathlib
import subprocess

import harness
from harness import wait_for

API = "/api/v1"


class Press:
    """The conveyor of examples/plc."""

    def __init__(self, setting, server=True):
        self.setting = setting
        example = setting.programs.parent / "examples" / "plc"
        setting.start(setting.programs / "indurop", "run", example / "module.xml", "-q", "--node", setting.node)
        wait_for(lambda: self.call("status", "-o", "json").returncode == 0, "the node")
        if server:
            self.server = setting.start_server("--write", "--token-file", setting.tokens)
        self.base = f"{API}/boards/{setting.node}/recipes"

    def call(self, *words):
        return subprocess.run([self.setting.programs / "indurop", *words, "--node", self.setting.node],
                              env=self.setting.environment, capture_output=True, text=True, timeout=60)

    def run(self, *words, code=0):
        done = self.call(*words)
        assert done.returncode == code, (words, done)
        return done

    def who_changed(self, name):
        answers = json.loads(self.run("explain", name, "-o", "json").stdout)["answers"]
        return next(one["text"] for one in answers if "last" in one["question"])

    def get(self, name):
        return self.run("get", name).stdout.strip()


def test_are_saved_compared_and_loaded_in_one_tick(setting):
    press = Press(setting)
    press.run("set", "conveyor::stop", "true")
    done = press.server.post(f"{press.base}/stopped/save", {"names": ["start", "stop"], "comment": "for cleaning"})
    assert done.status == 200 and done.json()["values"] == 2, done.body
    press.run("set", "conveyor::stop", "false")
    listed = press.server.get(press.base).json()["recipes"]
    assert [(one["recipe"], one["comment"], one["who"], one["values"]) for one in listed] == [
        ("stopped", "for cleaning", "ana", 2)], listed
    values = {one["name"]: one for one in press.server.get(f"{press.base}/stopped").json()["values"]}
    assert values["conveyor::stop"] == {"name": "conveyor::stop", "recipe": True, "now": False, "same": False}
    assert values["conveyor::start"]["same"]
    done = press.server.post(f"{press.base}/stopped/load", {"reason": "cleaning"})
    assert done.status == 200 and done.json()["tick"] > 0, done.body
    assert press.get("conveyor::stop") == "true"
    assert "ana" in press.who_changed("conveyor::stop"), press.who_changed("conveyor::stop")
    audit = press.server.get(API + "/audit").json()["audit"]
    assert [(one["action"], one["what"], one["outcome"]) for one in audit if one["who"] == "ana"] == [
        ("save recipe", "stopped", "begun"), ("save recipe", "stopped", "done"),
        ("load recipe", "stopped", "begun"), ("load recipe", "stopped", "done")], audit
    assert press.server.post(f"{press.base}/stopped/remove", {}).status == 200
    assert press.server.get(press.base).json()["recipes"] == []


def test_what_is_wrong_is_said_at_once_and_nothing_is_changed(setting):
    press = Press(setting)
    press.run("recipe", "save", "wrong", "start", "stop")
    file = next(pathlib.Path(setting.environment["INDUROP_STATE_DIR"]).glob("*/recipes/wrong.json"))
    text = json.loads(file.read_text())
    text["values"] = {"conveyor::start": True, "conveyor::stop": "perhaps", "conveyor::strat": 1}
    file.write_text(json.dumps(text))
    refused = press.server.post(f"{press.base}/wrong/load", {})
    assert refused.status == 422 and len(refused.json()["details"]) >= 2, refused.body
    assert press.get("conveyor::start") == "false"
    press.run("force", "conveyor::start", "false")
    text["values"] = {"conveyor::start": True, "conveyor::stop": True}
    file.write_text(json.dumps(text))
    refused = press.server.post(f"{press.base}/wrong/load", {})
    assert refused.status == 422 and "forced" in refused.json()["message"], refused.body
    assert press.get("conveyor::stop") == "false"
    file.write_text("{}")
    assert press.server.post(f"{press.base}/wrong/load", {}).status == 404
    for name in ("..%2F..%2Fwrong", "a%20b", "x" * 61):
        assert press.server.post(f"{press.base}/{name}/save", {}).status in (400, 404), name
    assert press.server.post(f"{press.base}/nothing/load", {}).status == 404
    assert press.server.post(f"{press.base}/new/save", {"names": ["nothing"]}).status == 422
    assert press.server.post(f"{press.base}/new/save", {}, token=None).status == 401


def test_the_command_line_does_the_same(setting):
    press = Press(setting, server=False)
    press.run("recipe", "save", "calm", "start", "stop", "--comment", "nothing moves")
    press.run("set", "conveyor::stop", "true")
    shown = json.loads(press.run("recipe", "diff", "calm", "-o", "json").stdout)
    assert [(one["name"], one["recipe"], one["now"]) for one in shown["differences"]] == [("conveyor::stop", False, True)]
    assert "in tick" in press.run("recipe", "load", "calm").stderr
    assert press.get("conveyor::stop") == "false"
    assert "calm" in press.run("recipe", "list", "-o", "csv").stdout
    assert "did you mean" in press.run("recipe", "load", "clam", code=1).stderr
    press.run("recipe", "load", code=2)
    press.run("stop")
    assert "next start" in press.run("recipe", "load", "calm").stderr
    press.run("recipe", "remove", "calm")


if __name__ == "__main__":
    harness.main(globals())
