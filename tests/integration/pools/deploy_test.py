#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A manifest sends pools between two boards with agents: these start indurop-pools, start it again when it is killed,
and end it with the pools of the next deployment. Each byte of each chunk is compared on the receiving board."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from harness import LARGE, SMALL, Setting, expect, wait_for


class Plant(Setting):
    """Two boards with agents: a writes the pools, b compares what arrives."""

    def __init__(self, head=""):
        super().__init__()
        self.head = head or f"<external>{self.domain}</external>"
        self.attributes = {"a": "", "b": ""}
        self.link = ["--one-host", "--domain", self.domain + 2]

    def __exit__(self, kind, *rest):
        for name in ("a", "b"):  # of agents that were killed
            for pid in [self.program(name), self.node_pid(name)]:
                if pid:
                    os.kill(pid, signal.SIGKILL)
        super().__exit__(kind, *rest)

    def manifest(self, name, pools):
        def board(key, file, period):
            return (f"<board name=\"{self.node(key)}\" {self.attributes[key]}><module>"
                    f"<filename>{self.build}/{file}</filename><moduletype>process</moduletype>"
                    f"<operationtype>periodic</operationtype><period>{period}</period><priority>1</priority>"
                    "<restart delay=\"10ms\" max=\"1000\"/></module></board>\n")
        file = self.folder / name
        file.write_text(f"<plant name=\"p{os.getpid()}\">{self.head}<domain>{self.domain + 1}</domain>\n"
                        f"{board('a', 'pools_writer.exe', '50ms')}{board('b', 'pools_checker.exe', '10ms')}{pools}"
                        "</plant>\n")
        return file

    def route(self, pool, more=""):
        return f"<pool name=\"{pool}\" from=\"{self.node('a')}\" to=\"{self.node('b')}\" {more}/>\n"

    def agent(self, name, program=None):
        program = program or self.programs / "indurop-agent"
        self.start("agent-" + name, [program, "--board", self.node(name), *self.link])

    def deploy(self, file, *more, code=0):
        done = self.indurop("deploy", str(file), "--health", "500ms", "--timeout", "20s", *map(str, self.link), *more)
        expect(done.returncode == code, f"deploy {file.name}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def programs_of(self, name):
        """The processes of indurop-pools for this board."""
        found = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (folder / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[0].endswith(b"/indurop-pools") and self.node(name).encode() in words:
                found.append(int(folder.name))
        return found

    def program(self, name):
        found = self.programs_of(name)
        return found[0] if found else 0

    def node_pid(self, name):
        status = self.status(name)
        return status["pid"] if status.get("state") == "running" else 0

    def chunks_arrive(self, what):
        self.grows("b", "large_seen", 5, what)
        expect(not self.wrong_chunks(), f"{what}: wrong chunks: {self.wrong_chunks()}")

    def board_status(self, name):
        done = self.indurop("status", "--plant", "-o", "json", *map(str, self.link))
        rows = json.loads(done.stdout)["boards"] if done.stdout else []
        return next((row for row in rows if row["board"] == self.node(name)), {})


def deployed(test):
    for name in ("a", "b"):
        test.agent(name)
    test.deploy(test.manifest("first.xml", test.route(LARGE) + test.route("small", "every=\"10Hz\"")))
    test.chunks_arrive("chunks reach the other board")
    test.grows("b", "small_seen", 5, "those of a second pool too")
    shown = test.indurop("status", "--node", test.node("a")).stdout
    expect("indurop-pools is running (pid " in shown and f"{LARGE} sent to {test.node('b')}" in shown, shown)
    expect("small sent to" in shown and "at most every 100 ms" in shown, shown)
    row = wait_for(lambda: (one := test.board_status("b")).get("pools") and one, "status --plant knows the pools")
    expect(row["pools"]["state"] == "running" and row["pools"]["pools"][0]["text"] == f"received from {test.node('a')}",
           str(row))
    checked = test.indurop("check", str(test.folder / "first.xml"))
    expect(checked.returncode == 0 and LARGE in checked.stdout and "2 pools" in checked.stdout + checked.stderr,
           checked.stdout + checked.stderr)
    listed = json.loads(test.indurop("vars", "--node", test.node("a"), "-o", "json").stdout)["pools"]
    expect([one["name"] for one in listed] == [LARGE, SMALL] and listed[0]["chunks"] == 4, str(listed))


def program_killed(test):
    nodes = [test.node_pid(name) for name in ("a", "b")]
    for name in ("b", "a"):
        pid = test.program(name)
        os.kill(pid, signal.SIGKILL)
        wait_for(lambda: "was ended by signal 9" in test.indurop("status", "--node", test.node(name)).stdout,
                 "status says what is wrong")
        wait_for(lambda: test.program(name) not in (0, pid), f"the program of {name} is started again")
        test.chunks_arrive(f"chunks arrive after the death of the program of {name}")
    expect(test.says("agent-b", "indurop-pools was ended by signal 9 (Killed); it is started again in 1 s"), "the log")
    expect(nodes == [test.node_pid(name) for name in ("a", "b")], "a node was disturbed")


def back_off(test):
    """It becomes rarer with each death, until the program has lived for a minute."""
    for number, pause in ((2, 2), (3, 4)):
        pid = test.program("b")
        os.kill(pid, signal.SIGKILL)
        wait_for(lambda: test.says("agent-b", f"it is started again in {pause} s"), f"death {number} is reported")
        wait_for(lambda: test.program("b") not in (0, pid), "the program is started again")
    test.chunks_arrive("chunks arrive after several deaths")


def agent_killed(test):
    for name in ("a", "b"):
        node = test.node_pid(name)
        test.kill("agent-" + name)
        wait_for(lambda: not test.programs_of(name), f"the program ends with the agent of {name}")
        expect(test.node_pid(name) == node, "the node ended with its agent")
        shown = test.indurop("status", "--node", test.node(name)).stdout
        expect("indurop-pools has ended with the agent of this board" in shown, shown)
        test.agent(name)
        wait_for(lambda: len(test.programs_of(name)) == 1, f"the next agent of {name} starts it")
        test.chunks_arrive(f"chunks arrive after the death of the agent of {name}")
        expect(test.node_pid(name) == node, "the node was started again")


def node_killed(test):
    for name in ("b", "a"):
        program, node = test.program(name), test.node_pid(name)
        os.kill(node, signal.SIGKILL)
        wait_for(lambda: test.node_pid(name) not in (0, node), f"the node of {name} runs again")
        test.chunks_arrive(f"chunks arrive after the death of the node of {name}")
        expect(test.programs_of(name) == [program], "the program did not go on")


def node_stopped(test):
    done = test.indurop("stop", "@" + test.node("b"), *map(str, test.link))
    expect(done.returncode == 0, done.stderr)
    wait_for(lambda: not test.programs_of("b"), "the program ends with the node")
    done = test.indurop("start", "@" + test.node("b"), *map(str, test.link))
    expect(done.returncode == 0, done.stderr)
    test.chunks_arrive("chunks arrive when the node has been started again")


def other_pools(test):
    nodes = [test.node_pid(name) for name in ("a", "b")]
    program = test.program("b")
    without = test.manifest("second.xml", test.route(SMALL))
    plan = test.deploy(without, "--dry-run")
    expect(f"pool {LARGE}" in plan and "ended" in plan and "the nodes are restarted" not in plan, plan)
    expect(test.programs_of("b") == [program], "the dry run has changed something")
    test.deploy(without)
    wait_for(lambda: test.program("b") not in (0, program), "the program is started for other pools")
    test.grows("b", "small_seen", 5, "the pool that stays arrives")
    seen = test.value("b", "large_seen")
    time.sleep(1)
    expect(test.value("b", "large_seen") == seen, "a pool is sent that is not in the manifest any more")
    test.deploy(test.manifest("third.xml", ""))
    wait_for(lambda: not test.programs_of("a") and not test.programs_of("b"), "the programs end with the last pool")
    expect("indurop-pools" not in test.indurop("status", "--node", test.node("a")).stdout, "status shows an old state")
    expect(nodes == [test.node_pid(name) for name in ("a", "b")], "the nodes were started again")
    done = test.indurop("rollback", "--health", "500ms", *map(str, test.link))
    expect(done.returncode == 0, done.stderr)
    test.grows("b", "small_seen", 5, "the pool is sent again after a rollback")
    expect(nodes == [test.node_pid(name) for name in ("a", "b")], "the nodes were started again by a rollback")


def refused(test):
    """All mistakes at once, and nothing is changed."""
    a, b = test.node("a"), test.node("b")
    program = test.program("b")
    text = test.deploy(test.manifest("wrong.xml", f"<pool name=\"larg\" from=\"{a}\" to=\"{b}\"/>\n"
                                                  f"<pool name=\"{SMALL}\" from=\"{a}\" to=\"{b}\"/>\n"
                                                  f"<pool name=\"small\" from=\"{b}\" to=\"{a}\"/>\n"), code=4)
    expect("wrong.xml:4:13: error: <pool>: no module declares a pool 'larg'; did you mean" in text, text)
    expect(f"wrong.xml:6:13: error: a second <pool> for '{SMALL}', the first is in line 5" in text, text)
    text = test.deploy(test.manifest("wrong.xml", f"<pool name=\"large\" from=\"x\" to=\"{b}\"/>\n"
                                                  f"<pool name=\"small\" from=\"{a}\" to=\"{a}\"/>\n"), code=4)
    expect("error: from: there is no board 'x'" in text and "is the board that the chunks come from" in text, text)
    expect(test.programs_of("b") == [program], "a deployment that was refused has changed something")


def not_installed(test):
    """A board without the program refuses before anything changes."""
    test.end("agent-b")
    folder = test.folder / "lacking/bin"
    folder.mkdir(parents=True)
    (test.folder / "lacking/lib").symlink_to(test.programs.parent / "lib")
    for name in ("indurop-agent", "indurop-node"):
        (folder / name).write_bytes((test.programs / name).read_bytes())
        (folder / name).chmod(0o755)
    test.agent("b", folder / "indurop-agent")
    wait_for(lambda: test.board_status("b").get("state") == "running", "the board runs")
    text = test.deploy(test.manifest("fourth.xml", test.route(LARGE)), code=4)
    expect(f"fourth.xml:4:13: error: board {test.node('b')} cannot receive the pool '{LARGE}', because " in text, text)
    expect("install all of the package indurop" in text, text)
    row = test.board_status("b")
    expect("indurop-pools cannot be started, because" in row["pools"]["problem"], str(row))


def with_keys(test):
    """Without an external domain, pools are sent in that of the boards, with their keys."""
    manifest = test.manifest("keys.xml", test.route(LARGE))
    made = test.indurop("keys", "init", str(manifest), "--dir", str(test.folder / "keys"))
    expect(made.returncode == 0, made.stderr)
    for name in ("a", "b"):
        of_board = test.folder / "etc" / f"p{os.getpid()}" / test.node(name)
        shutil.copytree(test.folder / "keys/boards" / test.node(name), of_board)
    test.environment["INDUROP_KEYS_DIR"] = str(test.folder / "etc")
    for name in ("a", "b"):
        test.agent(name)
    test.deploy(manifest, "--keys", str(test.folder / "keys"))
    test.chunks_arrive("chunks reach a board with keys")
    expect(test.says("agent-a", f"DDS domain {test.domain + 1}, with keys"), "the keys of the board are not used")


def two_hosts(test):
    """A network namespace for each board, addresses in the manifest, no multicast."""
    if not os.environ.get("POOLS_TEST_NETWORK"):
        print("not tested: boards on two hosts (root and network namespaces are needed)")
        return
    test.start("other", ["unshare", "-n", "sleep", "1000"])
    other = test.children["other"].pid
    inside = ["nsenter", f"--net=/proc/{other}/ns/net"]
    mine = os.readlink("/proc/self/ns/net")
    wait_for(lambda: os.readlink(f"/proc/{other}/ns/net") != mine, "a second network namespace")
    for command in ("ip link add pa type veth peer name pb netns " + str(other), "ip addr add 10.99.0.1/24 dev pa",
                    "ip link set pa up", f"{' '.join(inside)} ip addr add 10.99.0.2/24 dev pb",
                    f"{' '.join(inside)} ip link set pb up", f"{' '.join(inside)} ip link set lo up"):
        subprocess.run(command.split(), check=True)
    test.link = ["--domain", test.domain + 2]
    test.attributes = {"a": "address=\"10.99.0.1\" interface=\"pa\"", "b": "address=\"10.99.0.2\""}
    del test.environment["CYCLONEDDS_URI"]
    test.start("agent-a", [test.programs / "indurop-agent", "--board", test.node("a"), *test.link, "--interface", "pa"])
    test.start("agent-b", [*inside, test.programs / "indurop-agent", "--board", test.node("b"), *test.link,
                           "--interface", "pb"])
    test.link += ["--interface", "pa"]
    test.deploy(test.manifest("hosts.xml", test.route(LARGE)))
    test.chunks_arrive("chunks reach a board of another host")
    words = pathlib.Path(f"/proc/{test.program('b')}/cmdline").read_text().split("\0")
    expect("--one-host" not in words and words[words.index("--peer") + 1] == "10.99.0.1"
           and words[words.index("--address") + 1] == "10.99.0.2", str(words))


def without_agents(test):
    test.start("local", [test.programs / "indurop", "run", test.manifest("local.xml", test.route(LARGE)), "--local"])
    test.chunks_arrive("chunks reach another board of this host")
    pid = test.program("a")
    os.kill(pid, signal.SIGKILL)
    wait_for(lambda: test.says("local", f"indurop-pools of board {test.node('a')} ended with exit code 137"), "its end")
    expect(test.end("local") in (0, 143), "the plant does not end")
    expect(not test.programs_of("b"), "the program outlives the plant")


def main():
    with Plant() as test:
        without_agents(test)
    with Plant("<external>off</external><multicast>off</multicast>") as test:
        two_hosts(test)
    with Plant("<external>off</external><security>keys</security>") as test:
        with_keys(test)
    with Plant() as test:
        for step in (deployed, program_killed, back_off, agent_killed, node_killed, node_stopped, other_pools, refused,
                     not_installed):
            print(step.__name__, flush=True)
            step(test)
        for name in ("a", "b"):
            expect(test.end("agent-" + name) == 0, "the agent did not end well")
            expect(not test.programs_of(name) and not test.node_pid(name), "something outlives its agent")
        expect(not test.wrong_chunks(), f"wrong chunks: {test.wrong_chunks()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
