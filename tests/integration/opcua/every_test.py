#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Monitored items that report every run, in node-opcua's client: value by value, with their times, what `indurop record` has of the
same runs; and what becomes of them when a queue is too short, or something on the way is killed. every_test.py PROGRAMS FAKE_NODE [TEST...]"""

import signal
import subprocess
import time

from history_test import exported
from opcua_harness import Client, main, wait_for

RUNS = 10_000
SAME_CLOCK_NS = 10_000_000
LOST = "BadDataLost"


def begin(setting, *options, port=0):
    node = setting.start_real_node(*options)
    server = setting.start_server("--port", port)
    return node, server, setting.client(setting.start_opcua(server, "--anonymous"))


def number(value):
    """A UInt64 comes as its two halves."""
    return value[0] * 2**32 + value[1] if isinstance(value, list) and len(value) == 2 and isinstance(value[0], int) else value


class Taken:
    """What an item of the client has reported so far: (code, value, time in ns, was something discarded)."""

    def __init__(self, client, node):
        self.client, self.node, self.all = client, node, []

    def more(self):
        self.all += [(code, number(value), int(ns), cut) for code, value, ns, cut in self.client.do("take", node=self.node)]
        return self.all

    def values(self):
        return [one for one in self.more() if one[0] == "Good"]

    def codes(self):
        return {one[0] for one in self.more()}

    def until(self, count):
        wait_for(lambda: len(self.values()) >= count, f"{count} values")
        return self.values()


def every(client, node, **words):
    (answer,) = client.do("every", nodes=[node], **{"queue": 5000, **words})
    return Taken(client, node), answer


def breaks(values):
    """Where the counter is not one more than before, or the time not later."""
    return [(a, b) for a, b in zip(values, values[1:]) if {a[0], b[0]} != {"Good"} or b[1] != a[1] + 1 or b[2] <= a[2]]


def unmarked(values):
    """The same without those that are marked: a machine that is too busy loses runs, and says so."""
    return [(a, b) for a, b in breaks(values) if LOST not in (a[0], b[0])]


def test_every_run_is_reported_as_it_is_recorded(setting):
    _, _, client = begin(setting)
    count = setting.id("every::count")
    assert client.read(count, attribute="MinimumSamplingInterval")["value"] == 0
    (setting.folder / "recordings").mkdir()
    file = setting.folder / "recordings" / "run.mcap"
    recorder = setting.start(setting.programs / "indurop", "record", "--node", setting.node, "-o", file, stderr=subprocess.DEVNULL)
    wait_for(file.exists, "the recorder")
    time.sleep(0.5)
    taken, answer = every(client, count)
    assert answer == {"code": "Good", "interval": 0, "queue": 5000}, answer
    deadline = time.monotonic() + 3 * RUNS / 1000
    while len(taken.values()) < RUNS + 500 and time.monotonic() < deadline:
        time.sleep(0.2)
    values = taken.more()
    time.sleep(1)
    assert setting.end(recorder, signal.SIGINT) in (0, 128 + signal.SIGINT), "it has lost no run"
    assert len(values) > RUNS and taken.codes() == {"Good"} and not any(cut for *_, cut in values), (len(values), taken.codes())
    recorded = [(when, int(text)) for when, text in exported(setting, "every::count", "every::count")]
    shift = next(values[100][2] - when for when, text in recorded if text == values[100][1])
    assert abs(shift) < SAME_CLOCK_NS, shift
    expected = [(when + shift, value) for when, value in recorded if values[0][2] <= when + shift <= values[-1][2]]
    found = [(ns, value) for _, value, ns, _ in values]
    assert found == expected, (len(found), len(expected), [both for both in zip(found, expected) if both[0] != both[1]][:3])
    assert breaks(values) == [], breaks(values)[:3]


def test_parts_arrays_and_what_is_refused(setting):
    _, _, client = begin(setting)
    y, _ = every(client, setting.id("every::points[1].y"))
    wait_for(lambda: len(y.values()) > 300, "values")
    assert unmarked(y.more()) == []
    points, _ = every(client, setting.id("every::points"))
    wait_for(lambda: len(points.more()) > 300, "values")
    assert unmarked([(code, value and value[1]["y"], *more) for code, value, *more in points.all]) == []
    still, _ = every(client, setting.id("every::numbers"))
    wait_for(still.more, "the value that does not change")
    assert [one[:2] for one in still.all] == [("Good", [0, 0, 0, -7])], still.all
    count = setting.id("every::count")
    assert every(client, count, queue=1)[1]["interval"] == 100, "without a queue there is one value at a time"
    assert every(client, count, interval=50)[1]["interval"] == 100, "who asks for samples gets samples"
    assert every(client, count, queue=100_000)[1]["queue"] == 5000
    answers = client.do("every", nodes=[count] * 100, queue=10)
    assert [one["interval"] for one in answers].count(100) > 0 and answers[0]["interval"] == 0, answers
    assert "wants every run, but gets samples" in setting.log.read_text()


def test_boards_without_a_tape_are_sampled(setting):
    setting.start_node()
    server = setting.start_server()
    client = setting.client(setting.start_opcua(server, "--anonymous"))
    tick = setting.id("knu::Robot::tick")
    assert client.read(tick, attribute="MinimumSamplingInterval")["value"] == 100
    taken, answer = every(client, tick)
    assert answer["interval"] == 100, answer
    taken.until(5)


def test_a_queue_that_is_too_short_says_so(setting):
    _, _, client = begin(setting)
    count, y = setting.id("every::count"), setting.id("every::points[1].y")
    oldest, _ = every(client, count, queue=20, publishing=500)
    newest, _ = every(client, y, queue=20, publishing=500, oldest=False)
    oldest.until(100)
    newest.until(100)
    for taken, at in ((oldest, 1), (newest, 1)):
        gaps = [(a, b) for a, b in zip(taken.all, taken.all[1:]) if b[1] != a[1] + 1]
        assert len(gaps) > 2 and all(pair[at][3] for pair in gaps), gaps[:3]
    assert sum(1 for one in oldest.all if one[3]) <= len(oldest.all) / 10, "one of each queue"
    assert {one[0] for one in oldest.all} == {"Good"}


def test_two_clients_and_an_item_that_changes(setting):
    _, _, client = begin(setting)
    count = setting.id("every::count")
    other = Client(setting, client.endpoint)
    other.connect()
    first, _ = every(client, count, publishing=50)
    first.until(200)
    second, _ = every(other, count, publishing=200)
    second.until(500)
    sampled = client.do("modify", node=count, interval=250, queue=1000)
    assert sampled["interval"] == 250 and sampled["queue"] == 1000, sampled
    time.sleep(0.5)
    few = len(first.more())
    second.until(len(second.all) + 1500)
    assert 2 < len(first.more()) - few < 150, "samples"
    assert unmarked(first.all[:few - 3]) == [] and unmarked(second.all) == [], (unmarked(first.all[:few - 3]), unmarked(second.all), second.all[:5])
    assert client.do("modify", node=count, interval=0, queue=3000)["interval"] == 0
    few = len(first.more())
    first.until(few + 1000)
    again = next(i for i in range(few, few + 50) if first.all[i][2] % 1_000_000 and unmarked(first.all[i:]) == [])
    assert again - few < 5, first.all[few:few + 8]
    # Disabled, it reports nothing; then what it has now, and every run.
    client.do("mode", node=count, mode="Disabled")
    time.sleep(0.3)
    few = len(first.more())
    time.sleep(0.5)
    assert len(first.more()) == few
    client.do("mode", node=count, mode="Reporting")
    first.until(few + 300)
    assert unmarked(first.all[few:]) == [] and unmarked(second.more()) == [], (unmarked(first.all[few:]), unmarked(second.all))
    client.do("unmonitor", nodes=[count])
    second.until(len(second.all) + 300)
    assert unmarked(second.all) == []
    other.do("close")
    assert setting.opcua.poll() is None


def test_what_is_killed_ends_no_subscription(setting):
    node, server, client = begin(setting)
    count = setting.id("every::count")
    taken, _ = every(client, count)
    taken.until(300)
    # The server is back before the tape has forgotten anything: nothing is missing.
    setting.end(server.child, signal.SIGKILL)
    wait_for(lambda: "BadNoCommunication" in taken.codes(), "the loss of the server")
    server = setting.start_server("--port", server.port)
    few = len(taken.values())
    values = taken.until(few + 300)
    assert breaks(values) == [] and LOST not in taken.codes(), (breaks(values)[:3], taken.codes())
    # The node: what it did not do is a gap, and its times show when.
    setting.end(node, signal.SIGKILL)
    killed = time.time_ns()
    wait_for(lambda: LOST in taken.codes(), "the loss of the node")
    reached = setting.get_count()
    last = taken.values()[-1]
    assert last[1] == reached, "its last run is reported"
    setting.start_real_node()
    values = taken.until(len(taken.all) + 300)
    at = values.index(last)
    assert breaks(values[:at + 1]) == [] and breaks(values[at + 1:]) == [], (breaks(values), last)
    lost = next(one for one in taken.all if one[0] == LOST)
    assert last[2] < lost[2] <= killed < values[at + 1][2], (last, lost, values[at + 1])


def test_a_tape_that_was_overwritten_is_a_gap(setting):
    _, server, client = begin(setting, "--tape", "1")
    count = setting.id("every::count")
    taken, _ = every(client, count)
    taken.until(300)
    setting.opcua.send_signal(signal.SIGSTOP)
    wait_for(lambda: server.get(f"/api/v1/boards/{setting.node}/history?name=every::count&from_ns=0&most=1")
             .json()["variables"][0]["gaps"][0]["to_ns"] > taken.all[-1][2] + 500_000_000, "the tape to forget")
    setting.opcua.send_signal(signal.SIGCONT)
    wait_for(lambda: LOST in taken.codes(), "the gap")
    values = taken.until(len(taken.values()) + 1000)
    assert breaks(values) and unmarked(taken.all) == [], unmarked(taken.all)
    times = [one[2] for one in taken.all]
    assert times == sorted(times)


def test_a_deployment_ends_no_subscription(setting):
    node, _, client = begin(setting)
    count = setting.id("every::count")
    taken, _ = every(client, count)
    taken.until(300)
    setting.end(node)
    other = setting.start_node("many", "3")
    wait_for(lambda: "BadNodeIdUnknown" in taken.codes(), "the variable to be gone")
    setting.end(other)
    setting.start_real_node()
    few = len(taken.values())
    values = taken.until(few + 500)
    assert breaks(values[few:]) == []


if __name__ == "__main__":
    main(globals())
