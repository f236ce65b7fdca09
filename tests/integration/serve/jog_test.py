#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Robots moved by hand over HTTP: who may, what is refused, and what releases the switch. jog_test.py PROGRAMS FAKE_NODE
[TEST...]"""

import signal
import threading

import harness
from harness import TOKEN, wait_for
from users_test import entries, hash_of, PASSWORD, sign_in, Users

API = "/api/v1"
REQUEST = {"robot": "arm", "frame": "base", "speed": [0, 0, 25]}


def begun(setting):
    setting.start_node("robot")
    setting.tokens.write_text(f"ana {TOKEN}\nbob {TOKEN[::-1]}\n")
    server = setting.start_server("--write", "--token-file", setting.tokens)
    base = f"{API}/boards/{setting.node}"
    return server, base, lambda: server.get(base + "/variables/arm::ROBOT_JOG").json()["value"]


def held(server, base, switch):
    """A hand that was heard at least four times. One that this machine was too slow for is put there again."""
    def tried():
        said = server.post(base + "/jog", REQUEST)
        assert said.status == 200, said.body
        hand = said.json()
        assert hand["keep_ns"] == 250_000_000, hand
        first = switch()["nBeat"]
        kept = all(server.post(f"{base}/jog/{hand['jog']}/keep").status == 200 for _ in range(4))
        now = switch()
        return kept and now["bEnable"] == 1 and now["nBeat"] - first in range(3, 5) and hand["jog"]
    return wait_for(tried, "a hand that is kept at the switch")


def ends_of(server):
    return [one["outcome"] for one in server.get(API + "/audit").json()["audit"] if one["action"] == "end of jog"]


def test_a_hand_presses_the_switch_while_it_is_heard(setting):
    server, base, switch = begun(setting)
    hand = held(server, base, switch)
    now = switch()
    assert (now["eFrame"], now["dSpeed"]) == (1, [0, 0, 25, 0, 0, 0]), now
    server.post(f"{base}/jog/{hand}/end")
    wait_for(lambda: switch()["bEnable"] == 0, "the release")
    assert server.post(f"{base}/jog/{hand}/keep").status == 404
    audit = server.get(API + "/audit").json()["audit"]
    assert {one["who"] for one in audit} == {"ana"} and {"jog", "end of jog"} <= {one["action"] for one in audit}, audit


def test_a_hand_moves_along_a_work_frame(setting):
    server, base, switch = begun(setting)
    said = server.post(base + "/jog", {**REQUEST, "frame": "pallet"})
    assert said.status == 200, said.body
    now = switch()
    assert (now["eFrame"], now["frame"]) == (3, "pallet"), now


def test_a_jog_that_is_not_renewed_is_released(setting):
    server, base, switch = begun(setting)
    hand = held(server, base, switch)
    wait_for(lambda: switch()["bEnable"] == 0, "the release of a hand that is not heard")
    assert server.post(f"{base}/jog/{hand}/keep").status == 404
    wait_for(lambda: any("did not renew it in time" in outcome for outcome in ends_of(server)), "a note about it")


def test_a_server_that_ends_releases_and_one_that_is_killed_beats_no_more(setting):
    server, base, switch = begun(setting)
    server.post(base + "/jog", REQUEST)
    setting.end(server.child)
    server = setting.start_server("--write", "--token-file", setting.tokens)
    switch = lambda: server.get(base + "/variables/arm::ROBOT_JOG").json()["value"]
    assert switch()["bEnable"] == 0
    assert server.post(base + "/jog", REQUEST).status == 200
    setting.end(server.child, signal.SIGKILL)
    server = setting.start_server("--write", "--token-file", setting.tokens)
    before = switch()["nBeat"]
    assert before > 0, "a robot that checks the beat sees that no client is there"
    assert held(server, base, switch), "the robot can be moved again"


def test_refuses_what_is_no_motion(setting):
    server, base, switch = begun(setting)
    jog = base + "/jog"
    for wrong, status in (({"robot": "leg"}, 409), ({"frame": "the \"moon"}, 409), ({"frame": "m" * 32}, 409), ({"speed": [0, 0, 0]}, 409), ({"speed": [1, 1]}, 409),
                          ({"speed": [101]}, 409), ({"speed": [0] * 6 + [1]}, 409), ({"speed": []}, 400), ({"speed": "fast"}, 400),
                          ({"speed": [None]}, 400), ({"robot": 7}, 400)):
        said = server.post(jog, {**REQUEST, **wrong})
        assert said.status == status, (wrong, said.status, said.body)
    assert server.ask("POST", jog, REQUEST).status == 401
    assert server.post(jog, REQUEST, token="x" * 30).status == 401
    assert server.post(jog + "/nothing/keep").status == 404
    assert server.post(f"{API}/boards/missing/jog", REQUEST).status == 404
    assert server.post(base + "/lock", {"lock": "tune"}).status == 200
    assert server.post(jog, REQUEST).status == 423, "the board is locked"
    assert server.post(base + "/lock", {"lock": "none"}).status == 200
    assert server.post(base + "/force", {"values": {"arm::ROBOT_JOG.bEnable": 0}}).status == 200
    assert server.post(jog, REQUEST).status == 409, "the switch is forced"
    assert server.post(base + "/release", {"all": True}).status == 200
    assert switch()["bEnable"] == 0 and switch()["nBeat"] == 0, "nothing was written"


def test_a_robot_that_cannot_be_guided_is_not(setting):
    server, base, switch = begun(setting)
    for wrong, status, why in (({"speed": []}, 409, "ROBOT_ARM"), ({"speed": [0, 0, 25]}, 409, "leave speed out")):
        said = server.post(base + "/jog", {"robot": "arm", "frame": "hand", **wrong})
        assert said.status == status and why in said.json()["message"], (wrong, said.body)
    assert switch()["bEnable"] == 0 and switch()["nBeat"] == 0, "nothing was written"
    path = server.get(base + "/robots/robot/guiding?robot=arm").json()
    assert (path["places"], path["records"], path["guided"]) == (0, False, False), path
    write = base + "/robots/robot/guiding/write"
    for body, status in (({}, 400), ({"job": "seam", "within": "all"}, 400), ({"job": "seam", "robot": "arm"}, 409)):
        said = server.post(write, body)
        assert said.status == status, (body, said.status, said.body)
    assert server.ask("POST", write, {"job": "seam"}).status == 401
    actions = [(one["action"], one["outcome"]) for one in server.get(API + "/audit").json()["audit"]]
    assert ("write guided path", "this server has recorded no path of this robot: guide it first") in actions, actions


def test_one_hand_at_a_time_and_only_its_own(setting):
    server, base, switch = begun(setting)

    def seen():
        hand = held(server, base, switch)
        second, other = server.post(base + "/jog", REQUEST, token=TOKEN[::-1]), server.post(f"{base}/jog/{hand}/end", token=TOKEN[::-1])
        return server.post(f"{base}/jog/{hand}/keep").status == 200 and (second, other)  # else it was too slow

    second, other = wait_for(seen, "one look while the hand is there")
    assert second.status == 409 and "ana is moving it" in second.json()["message"], second.body
    assert other.status == 404


def test_a_jog_ends_with_the_right_to_its_switch(setting):
    setting.start_node("robot")
    hashed = hash_of(PASSWORD)
    users = Users(setting, anna=f'role="operate" password="{hashed}" variables="arm::*"')
    server = setting.start_server("--write", "--users", users.file, "--audit", setting.folder / "audit.jsonl")
    base, anna = f"{API}/boards/{setting.node}", sign_in(server, "anna")
    jog = lambda: server.post(base + "/jog", REQUEST, anna).json().get("jog")
    keep = lambda hand: server.post(f"{base}/jog/{hand}/keep", None, anna).status
    hand = wait_for(lambda: (one := jog()) and keep(one) == 200 and one, "a hand that is kept")
    users.write(anna=f'role="operate" password="{hashed}" variables="leg::*"')
    assert keep(hand) == 404, "she may not change this variable any more"
    assert server.get(base + "/variables/arm::ROBOT_JOG").json()["value"]["bEnable"] == 0
    wait_for(lambda: any("may no longer" in one["outcome"] for one in entries(setting)), "a note about it")
    assert server.post(base + "/jog", REQUEST, anna).status == 403


def test_a_switch_that_another_client_writes_is_released(setting):
    """Two programs that press it would not know which of them moves the robot."""
    server, base, switch = begun(setting)
    for written in ({"nBeat": 1000}, {"bEnable": 0}, {"bEnable": 1, "nBeat": 1, "dSpeed": [50, 0, 0, 0, 0, 0]}):
        def ended():
            hand = held(server, base, switch)
            assert server.post(base + "/set", {"values": {f"arm::ROBOT_JOG.{name}": value for name, value in written.items()}}).status == 200
            kept = server.post(f"{base}/jog/{hand}/keep").status
            assert kept == 404 and switch()["bEnable"] == 0, (written, kept, switch())
            return "another client" in ends_of(server)[-1]
        wait_for(ended, "a note about it")


def test_a_jog_ends_with_the_run_of_its_node(setting):
    server, base, switch = begun(setting)
    node = setting.children[0]
    for again in (False, True):
        hand = held(server, base, switch)
        before = len(ends_of(server))
        setting.end(node, signal.SIGKILL)
        if again:
            node = setting.start_node("robot")
        wait_for(lambda: server.post(f"{base}/jog/{hand}/keep").status == 404, "its end")
        wait_for(lambda: len(ends_of(server)) > before, "a note about it")
        if again:
            assert switch()["bEnable"] == 0, "it is not pressed in the next run"
        else:
            node = setting.start_node("robot")


def test_a_switch_that_was_left_pressed_is_released_before(setting):
    """A robot whose beat has stopped moves again only after it has seen the switch released."""
    server, base, switch = begun(setting)
    held(server, base, switch)
    setting.end(server.child, signal.SIGKILL)
    server = setting.start_server("--write", "--token-file", setting.tokens)
    switch = lambda: server.get(base + "/variables/arm::ROBOT_JOG").json()["value"]
    assert switch()["bEnable"] == 1, "no process is left that could release it"
    seen = []
    pressing = threading.Thread(target=lambda: seen.append(server.post(base + "/jog", REQUEST).status))
    pressing.start()
    wait_for(lambda: switch()["bEnable"] == 0 or not pressing.is_alive(), "the release")
    released = switch()["bEnable"] == 0
    pressing.join()
    assert released and seen == [200], (released, seen)
    wait_for(lambda: switch()["bEnable"] == 0, "the end of this one")
    assert held(server, base, switch)


def test_a_lock_ends_the_motion(setting):
    server, base, switch = begun(setting)
    held(server, base, switch)
    server.post(base + "/lock", {"lock": "all"})
    wait_for(lambda: switch()["bEnable"] == 0, "the release")


if __name__ == "__main__":
    harness.main(globals())
