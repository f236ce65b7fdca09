#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Alarms over OPC UA: events of conditions, acknowledging by users with the role to, and what the journal says of it.
alarms_test.py PROGRAMS FAKE_NODE [TEST...]"""

from opcua_harness import API, harness, main, wait_for

SECURE = {"mode": "SignAndEncrypt", "policy": "Basic256Sha256"}
ACKNOWLEDGE, ADD_COMMENT = "ns=0;i=9111", "ns=0;i=9029"
OIL = "press::oil > 80"


class Plant:
    def __init__(self, setting):
        self.setting = setting
        setting.start_node()
        self.server = setting.start_server("--write", "--token-file", setting.tokens, "--audit", setting.folder / "audit.jsonl")
        self.board = f"{API}/boards/{setting.node}"
        wait_for(lambda: self.server.get(f"{self.board}/alarms").json()["watched"], "a process that evaluates alarms")
        endpoint = setting.start_opcua(self.server, "--anonymous")
        self.client = setting.client(endpoint, user="ana", password=harness.TOKEN, **SECURE)
        self.guest = setting.client(endpoint)
        self.condition = setting.id(f"alarms/{OIL}")

    def set(self, name, value):
        assert self.server.post(f"{self.board}/set", {"values": {name: value}}).status == 200

    def state(self):
        return next(one for one in self.server.get(f"{self.board}/alarms?all=true").json()["alarms"] if one["alarm"] == OIL)

    def event(self, client, condition, what):
        return wait_for(lambda: next((one for one in reversed(client.do("events")) if condition(one)), None), what)


def test_an_alarm_comes_is_acknowledged_and_goes(setting):
    plant = Plant(setting)
    client = plant.client
    client.do("listen", node="ns=0;i=2253")
    plant.guest.do("listen", node=f"ns=2;s={setting.node}")
    plant.set("press::oil", 91.5)
    raised = plant.event(client, lambda one: one["ConditionName"] == OIL and one["ActiveState.Id"], "the alarm")
    assert raised["Severity"] == 800 and raised["Retain"] and not raised["AckedState.Id"], raised
    assert raised["SourceName"] == setting.node and "the oil is too hot" in raised["Message"] and "91.5" in raised["Message"], raised
    assert raised["ConditionId"] == plant.condition
    event = raised["EventId"]
    plant.event(plant.guest, lambda one: one["ActiveState.Id"], "the alarm at a client that is not signed in")
    assert plant.guest.do("call", object=plant.condition, method=ACKNOWLEDGE, event=event, text="?") == "BadUserAccessDenied"
    assert client.do("call", object=plant.condition, method=ACKNOWLEDGE, event="00", text="?") == "BadEventIdUnknown"
    assert plant.state()["state"] == "unacknowledged"
    assert client.do("call", object=plant.condition, method=ADD_COMMENT, event=event, text="?") == "BadNotSupported"
    assert client.do("call", object=plant.condition, method=ACKNOWLEDGE, event=event, text="seen it") == "Good", setting.log.read_text()
    assert (plant.state()["state"], plant.state()["who"], plant.state()["reason"]) == ("acknowledged", "ana", "seen it")
    plant.event(client, lambda one: one["AckedState.Id"] and one["ActiveState.Id"] and one["ClientUserId"] == "ana", "the acknowledgement")
    assert client.do("call", object=plant.condition, method=ACKNOWLEDGE, event=event, text="?") != "Good", "once"
    plant.set("press::oil", 20)
    over = plant.event(client, lambda one: not one["ActiveState.Id"] and one["ConditionName"] == OIL, "the end")
    assert not over["Retain"], over
    assert "ana" in (setting.folder / "audit.jsonl").read_text()


def test_an_alarm_that_is_acknowledged_elsewhere_is_here_too(setting):
    plant = Plant(setting)
    plant.set("press::oil", 91.5)
    wait_for(lambda: plant.state()["state"] == "unacknowledged", "the alarm")
    wait_for(lambda: plant.client.read(f"{plant.condition}-ActiveState-Id")["value"], "the condition to be active")
    plant.client.do("listen", node="ns=0;i=2253")
    refreshed = plant.client.do("refresh")
    assert refreshed == "Good", refreshed
    plant.event(plant.client, lambda one: one["ConditionName"] == OIL and one["Retain"], "what is retained, for a client that comes later")
    assert plant.server.post(f"{plant.board}/alarms/ack", {"alarms": [OIL], "reason": "on the page"}).status == 200
    noted = plant.event(plant.client, lambda one: one["AckedState.Id"] and one["ConditionName"] == OIL, "the acknowledgement")
    assert (noted["ClientUserId"], noted["Comment"]) == ("ana", "on the page"), noted
    plant.set("press::oil", 20)
    plant.event(plant.client, lambda one: not one["ActiveState.Id"] and one["ConditionName"] == OIL, "the end")
    plant.set("press::oil", 91.5)
    wait_for(lambda: plant.state()["state"] == "unacknowledged", "the alarm again")
    plant.set("press::oil", 20)
    wait_for(lambda: plant.state()["state"] == "returned", "the condition to be over")
    assert plant.server.post(f"{plant.board}/alarms/shelve", {"alarms": ["press::door_open"], "for_ns": 10**12, "reason": "x"}).status == 200
    shelved = setting.id("alarms/press::door_open") + "-SuppressedOrShelved"
    wait_for(lambda: plant.client.read(shelved)["value"], "the shelving")


if __name__ == "__main__":
    main(globals())
