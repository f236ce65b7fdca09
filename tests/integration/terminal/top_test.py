#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""indurop top on a terminal of 80x24 and smaller ones, and in a pipe. top_test.py PROGRAMS FAKE_NODE [TEST...]"""

import pathlib
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "serve"))
import harness  # noqa: E402
from terminal import Terminal  # noqa: E402


def top(setting, *options, **size):
    return Terminal([str(setting.programs / "indurop"), "top", "--node", setting.node, "-d", "0.1", *options],
                    setting.environment, **size)


def has(*texts):
    return lambda lines: all(any(text in line for line in lines) for text in texts)


def test_fits_a_terminal_of_80x24(setting):
    setting.start_node()
    screen = top(setting)
    screen.sees(has(f"node {setting.node}", "running for", "tick ", "MODULE", "modify", "output", "SIGSEGV at address 0x0",
                    "LOG ", "tick 41: output ran 1.20 ms and was not done, behind modify with 2.50 ms",
                    "tick 43: modify: the gripper ?[31mis open", "q Quit"),
                "the page")
    lines = screen.lines()
    assert lines[-1].startswith("q Quit"), lines
    heading = next(line for line in lines if line.startswith("MODULE"))
    row = next(line for line in lines if line.startswith("modify"))
    assert len(heading) <= 80 and row[heading.index("OVERR") + 4] == "0", lines
    assert not screen.echoes()
    screen.press("q")
    assert screen.wait() == 0


def test_its_log_says_who_ordered_what(setting):
    setting.start_node()
    screen = top(setting)
    for words in (["set", "gain", "2.5"], ["force", "mode", "AUTO", "--reason", "a trial"]):
        subprocess.run([setting.programs / "indurop", *words, "--node", setting.node], env=setting.environment, check=True)
    screen.sees(has(": set knu::Robot::gain = 2.5, by ", ": force knu::Robot::mode = AUTO, by "), "the orders")
    screen.press("q")
    assert screen.wait() == 0


def test_takes_keys_and_another_size(setting):
    node = setting.start_node()
    screen = top(setting)
    screen.sees(has("sorted by load"), "the page")
    screen.press("s")
    screen.sees(has("sorted by name"), "another order")
    screen.press(" ")
    screen.sees(has("PAUSED"), "the pause")
    screen.press(" ")
    screen.sees(lambda lines: not has("PAUSED")(lines), "it to go on")
    for rows, columns in ((10, 60), (4, 20), (30, 120)):
        screen.resize(rows, columns)
        screen.sees(lambda lines, last=rows - 1: lines[last].startswith("q Quit") and has("node ")(lines), f"{columns}x{rows}")
    setting.end(node, signal.SIGKILL)
    screen.sees(has("the node is killed"), "the node to be missed")
    setting.start_node()
    screen.sees(has("running for"), "the node to be back")
    screen.press("\x1b[21~")  # F10
    assert screen.wait() == 0


def test_ends_with_signals_and_counts(setting):
    setting.start_node()
    screen = top(setting, "-n", "2")
    assert screen.wait() == 0
    screen = top(setting)
    screen.sees(has("MODULE"), "the page")
    screen.press("\x03")
    assert screen.wait() == 130


def test_prints_a_page_in_a_pipe(setting):
    command = [setting.programs / "indurop", "top", "--node", setting.node]
    run = lambda: subprocess.run(command, env=setting.environment, capture_output=True, text=True, timeout=60, check=False)
    assert run().returncode == 6
    setting.start_node()
    done = run()
    assert done.returncode == 0 and "MODULE" in done.stdout and "\x1b" not in done.stdout, done
    assert all(len(line) <= 80 for line in done.stdout.splitlines()), done.stdout


if __name__ == "__main__":
    harness.main(globals())
