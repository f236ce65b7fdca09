#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""/metrics of indurop-serve: promtool judges the text, `indurop status` the figures. metrics_test.py PROGRAMS FAKE_NODE [TEST...]"""

import json
import pathlib
import re
import shutil
import signal
import subprocess

import harness
from harness import TOKEN, wait_for
from plant_test import take_domain
from remote_test import begin, there_are_namespaces

LINE = re.compile(r'(\w+)\{(.*)\} (\S+)')
LABEL = re.compile(r'(\w+)="((?:[^"\\]|\\.)*)"')
DOCS = pathlib.Path(__file__).resolve().parents[3] / "docs" / "metrics.md"


def read_metrics(server, **headers):
    """Samples by name and labels; the text has passed promtool."""
    answer = server.get("/metrics", **headers)
    assert answer.status == 200 and answer.headers["content-type"].startswith("text/plain; version=0.0.4"), answer.headers
    if shutil.which("promtool"):
        judged = subprocess.run(["promtool", "check", "metrics"], input=answer.body, capture_output=True, check=False)
        assert judged.returncode == 0 and not judged.stderr, judged.stderr.decode() + answer.body.decode()
    samples = {}
    for line in answer.body.decode().splitlines():
        if line.startswith("#"):
            continue
        name, labels, value = LINE.fullmatch(line).groups()
        key = (name, *sorted(LABEL.findall(labels)))
        assert key not in samples, line
        samples[key] = float(value)
    return samples


def value(samples, name, **labels):
    return samples[(name, *sorted(labels.items()))]


def status(setting):
    done = subprocess.run([setting.programs / "indurop", "status", "--node", setting.node, "-o", "json"], env=setting.environment,
                          capture_output=True, text=True, timeout=harness.DEADLINE_S, check=False)
    return json.loads(done.stdout)


def test_figures_are_those_of_status(setting):
    node = setting.start_node()
    server = setting.start_server()
    wait_for(lambda: status(setting)["ticks"] > 100, "some ticks")
    node.send_signal(signal.SIGSTOP)  # nothing moves while both are read
    samples, expected = read_metrics(server), status(setting)
    board = {"board": setting.node}
    assert value(samples, "indurop_up", **board) == 1
    assert value(samples, "indurop_ticks_total", **board) == expected["ticks"]
    assert value(samples, "indurop_lost_ticks_total", **board) == expected["lost_ticks"]
    assert value(samples, "indurop_basic_period_seconds", **board) == expected["basic_period_ns"] / 1e9
    close = lambda seconds, ns: abs(seconds * 1e9 - ns) < 0.5
    for quantile, word in (("0.5", "p50"), ("0.99", "p99"), ("0.999", "p99_9")):
        assert close(value(samples, "indurop_tick_lateness_seconds", quantile=quantile, **board), expected["lateness_ns"][word]), word
    assert close(value(samples, "indurop_tick_lateness_max_seconds", **board), expected["lateness_ns"]["max"])
    count = value(samples, "indurop_tick_lateness_seconds_count", **board)
    mean_ns = value(samples, "indurop_tick_lateness_seconds_sum", **board) / count * 1e9
    assert -0.01 < mean_ns - expected["lateness_ns"]["mean"] < 1.01, "status has whole nanoseconds"
    assert len(expected["modules"]) == 3
    for module in expected["modules"]:
        of = {**board, "module": module["name"]}
        assert value(samples, "indurop_module_running", **of) == (module["state"] == "running"), module
        for name, field in (("runs", "runs"), ("skipped_runs", "skipped"), ("overruns", "overruns"), ("deadline_misses", "deadline_misses"),
                            ("restarts", "restarts")):
            assert value(samples, f"indurop_module_{name}_total", **of) == module[field], (name, module)
        if module["runs"]:
            for quantile, field in (("0.5", "jitter_p50_ns"), ("0.99", "jitter_p99_ns")):
                assert close(value(samples, "indurop_module_jitter_seconds", quantile=quantile, **of), module[field]), module
    assert value(samples, "indurop_overruns_total", **board) == sum(module["overruns"] for module in expected["modules"]) == 1
    assert value(samples, "indurop_faults_total", **board) == 1
    node.send_signal(signal.SIGCONT)


def test_alarms_forces_and_chosen_values(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens, "--metrics", "press::*", "--metrics", "press::oil",
                                  "--metrics", "joints[1].y", "--metrics", "joints[2]", "--metrics", "station::name", "--metrics",
                                  "nothing::*")
    board = {"board": setting.node}
    base = f"/api/v1/boards/{setting.node}"
    assert server.post(base + "/set", {"values": {"press::oil": 90.5, "press::door_open": True, "joints[1].y": -12.25}}).status == 200
    assert server.post(base + "/force", {"values": {"gain": 4}}).status == 200
    wait_for(lambda: value(read_metrics(server), "indurop_alarms", state="active", **board) == 2, "the alarms")
    samples = read_metrics(server)
    assert value(samples, "indurop_alarms", state="unacknowledged", **board) == 2
    assert value(samples, "indurop_alarms", state="shelved", **board) == 0
    assert value(samples, "indurop_forced_values", **board) == 1
    count = len(server.get(base + "/variables?values=false").json()["variables"])
    assert value(samples, "indurop_variables", quality="good", **board) == count
    shown = {dict(labels)["variable"]: number for (name, *labels), number in samples.items() if name == "indurop_variable_value"}
    assert shown == {"press::oil": 90.5, "press::door_open": 1, "knu::Robot::joints[1].y": -12.25,
                     "knu::Robot::joints[2].x": 0, "knu::Robot::joints[2].y": 0, "knu::Robot::joints[2].z": 0}, shown


def test_qualities_of_devices(setting):
    (setting.folder / "ioconfig.xml").write_text("""<ioconfig>
<device name="conveyor &quot;north&quot;" driver="modbus_tcp" address="127.0.0.1:1502" quality="station::starts">
<input variable="knu::Robot::gain" at="input:1"/></device></ioconfig>""")
    (setting.folder / "module.xml").write_text("""<root><module><filename>./libiodispat.so</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1000000</period><priority>1</priority>
<property><value name="config">ioconfig.xml</value></property></module></root>""")
    setting.start_node("config", setting.folder / "module.xml")
    samples = read_metrics(setting.start_server())
    assert value(samples, "indurop_device_quality", board=setting.node, device='conveyor \\"north\\"') == 5, samples


def test_a_board_that_ended(setting):
    node = setting.start_node()
    server = setting.start_server()
    assert value(read_metrics(server), "indurop_up", board=setting.node) == 1
    setting.end(node, signal.SIGKILL)
    wait_for(lambda: value(read_metrics(server), "indurop_up", board=setting.node) == 0, "its end")
    assert not any(name == "indurop_ticks_total" for name, *_ in read_metrics(server))


def test_a_board_of_another_host(setting):
    if not there_are_namespaces():
        return
    _, _, _, remote = begin(setting)
    wait_for(lambda: ("indurop_lost_ticks_total", ("board", setting.node)) in read_metrics(remote), "its report")
    samples = read_metrics(remote)
    assert value(samples, "indurop_up", board=setting.node) == 1
    assert {"indurop_overruns_total", "indurop_faults_total", "indurop_variables"} < {name for name, *_ in samples}
    assert not any(name.startswith("indurop_module") for name, *_ in samples)


def test_a_board_that_receives_another_one(setting):
    left, right = f"{setting.node}_left", f"{setting.node}_right"
    boards = ""
    for board, name in ((left, "counter"), (right, "walker")):  # the walker reads what the counter writes
        shutil.copy(pathlib.Path(setting.fake_node).parent / "modules" / f"{name}.so", setting.folder)
        boards += f"""<board name="{board}"><module><filename>./{name}.so</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>10ms</period><priority>1</priority></module></board>"""
    (setting.folder / "plant.xml").write_text(
        f"""<plant name="two"><domain>{take_domain(setting)}</domain><external>off</external>{boards}</plant>""")
    run = setting.start(setting.programs / "indurop", "run", "plant.xml", "--local", "-q", cwd=setting.folder, stderr=subprocess.DEVNULL)
    server = setting.start_server(node=right)
    both = {"board": right, "peer": left}
    wait_for(lambda: read_metrics(server).get(("indurop_peer_up", *sorted(both.items()))) == 1, "the other board")
    samples = read_metrics(server)
    assert 0 <= value(samples, "indurop_peer_age_seconds", **both) < harness.DEADLINE_S
    assert value(samples, "indurop_peer_lost_updates_total", **both) == 0
    setting.end(run)


def test_needs_what_reading_needs(setting):
    setting.start_node()
    server = setting.start_server("--write", "--token-file", setting.tokens)
    assert server.get("/metrics").status == 200
    assert server.get("/metrics", Authorization="Bearer " + TOKEN[::-1]).status == 401
    assert server.ask("POST", "/metrics", {}, TOKEN).status == 405
    assert read_metrics(server, Authorization="Bearer " + TOKEN)


def test_the_page_lists_all_metrics(setting):
    """docs/metrics.md names each metric that there is, and no other."""
    setting.start_node()
    server = setting.start_server("--metrics", "gain")
    there = {re.sub("_(sum|count)$", "", name) for name, *_ in read_metrics(server)}
    documented = set(re.findall(r"^\| `(indurop_\w+)`", DOCS.read_text(), re.MULTILINE))
    # Of boards that receive others, and of field devices, which this one has not.
    assert documented - there == {"indurop_peer_up", "indurop_peer_age_seconds", "indurop_peer_lost_updates_total",
                                  "indurop_device_quality", "indurop_module_period_seconds"} - there, documented ^ there
    assert there <= documented, there - documented


if __name__ == "__main__":
    if not shutil.which("promtool"):
        print("without promtool: the text is not judged")
    harness.main(globals())
