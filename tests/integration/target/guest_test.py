#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The packages on a board as users have one: Debian with systemd and its PREEMPT_RT kernel in QEMU (indurop-lab --vm --bare).
They are installed, a board is started as a service and deployed to. Its rights and filters, watchdogs, journal, updates of the
platform, a start before the network, a full disk, a wrong clock, and the removal of the package under a node that runs are checked,
each by a program that is not ours. Needs root, QEMU, mmdebstrap and the packages of `make deb`. INDUROP_KEEP_GUEST names a lab that
is there already, and stays."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import unittest

SKIPPED = 77
PATIENCE = 1800  # seconds; translated machines on a busy host are a hundred times slower than this one
UNIT = "indurop-agent@board1.service"
PLANT = """<plant name="cell"><board name="board1"><module><name>main</name><filename>./target_b1.so</filename>
<moduletype>thread</moduletype><operationtype>periodic</operationtype><period>20ms</period><budget>60s</budget><priority>1</priority>
</module></board></plant>
"""
RUNS = "indurop get --node board1 b1::last -o csv | sed -n 's/^b1::last,\\([0-9]*\\),.*/\\1/p'"
CAP_IPC_LOCK, CAP_SYS_NICE = 14, 23
options = None


class Guest:
    def __init__(self):
        self.lab = os.environ.get("INDUROP_KEEP_GUEST") or f"guest{os.getpid()}"

    def call(self, *words, code=0, **more):
        done = subprocess.run([options.bin / "indurop-lab", "-l", self.lab, *words], capture_output=True, timeout=PATIENCE, check=False,
                              **more)
        text = done.stdout.decode(errors="replace") + done.stderr.decode(errors="replace")
        if code is not None and done.returncode != code:
            raise AssertionError(f"{words}: {done.returncode} instead of {code}\n{text}")
        return text

    def __call__(self, script, code=0, **more):
        """A shell script on the board."""
        return self.call("exec", "board1", "sh", "-c", script, code=code, **more)

    def put(self, file, folder):
        with open(file, "rb") as content:
            self(f"mkdir -p {folder} && cat >{folder}/{file.name}", stdin=content)

    def until(self, right, script):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            said = self(script, code=None)
            if right(said):
                return said
            time.sleep(1)
        raise AssertionError(f"{script} still says:\n{said}")


class OnTheTarget(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.guest = guest = Guest()
        if "INDUROP_KEEP_GUEST" not in os.environ:
            cls.addClassCleanup(guest.call, "down", code=None)
        if "board1 " not in guest.call("list"):
            guest.call("--vm", "--bare", "up", "board1")

    def entries(self, words):
        """Of the journal: what journalctl finds, by its own JSON. It ends with 1 if a pattern (-g) is not found."""
        return [json.loads(line) for line in self.guest(f"journalctl -q -o json --no-pager {words} || [ $? = 1 ]").splitlines() if line]

    def status(self):
        return json.loads(self.guest("indurop status --node board1 -o json"))

    def agent(self):
        return int(self.guest(f"systemctl show -P MainPID {UNIT}"))

    def runs(self):
        return int(self.guest(RUNS))

    def goes_on(self):
        before = self.runs()
        self.guest.until(lambda said: said.strip().isdigit() and int(said) > before, RUNS)

    def drop_in(self, unit, name, text):
        self.guest(f"mkdir -p /etc/systemd/system/{unit}.d && cat >/etc/systemd/system/{unit}.d/{name}.conf && systemctl daemon-reload",
                   input=text.encode())

    def test_01_apt_installs_the_package(self):
        for package in options.debs.glob("indurop_*.deb"):
            self.guest.put(package, "/root/debs")
        said = self.guest("cd /root/debs && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ./indurop_*.deb 2>&1")
        self.assertIn("Setting up indurop ", said)
        self.assertEqual(self.guest("dpkg --audit"), "")
        self.assertEqual(self.guest("stat -c %U:%a /var/lib/indurop").strip(), "indurop:750")
        self.assertEqual(self.guest("stat -c %G:%a /dev/cpu_dma_latency").strip(), "indurop:660")
        self.assertEqual(self.guest("cat /proc/sys/kernel/watchdog").strip(), "0")
        self.assertEqual(self.guest(f"systemd-analyze verify {UNIT} 2>&1").strip(), "")
        self.assertEqual(self.guest(f"systemctl is-enabled {UNIT}", code=None).strip(), "disabled")

    def test_02_a_refused_system_call_would_end_the_service(self):
        """From here on: what follows would end by SIGSYS if the filter refused anything."""
        self.drop_in("indurop-agent@.service", "strict", "[Service]\nSystemCallErrorNumber=kill\nWatchdogSec=20s\n")
        self.guest(f"systemctl enable --now {UNIT}")
        self.guest.until(lambda said: said.strip() == "active", f"systemctl is-active {UNIT}")

    def test_03_a_deployed_project_runs(self):
        self.guest.put(options.module, "/root/plant")
        self.guest("cat >/root/plant/plant.xml", input=PLANT.encode())
        # A board that is too slow to start its node in time takes its deployment back: it is given again.
        self.guest.until(lambda said: "is committed" in said, "indurop deploy /root/plant/plant.xml --timeout 5min 2>&1")
        self.goes_on()
        self.guest("indurop record --node board1 -q -o /tmp/some.mcap --duration 3s && indurop recording info /tmp/some.mcap")

    def test_04_it_has_its_rights_and_no_other(self):
        self.has_its_rights()

    def has_its_rights(self):
        rights = self.status()["rt"]
        self.assertEqual([rights[name] for name in ("fifo", "memory_locked", "cpu_dma_latency", "preempt_rt")], [True] * 4)
        for process in (self.agent(), self.status()["pid"]):
            facts = dict(re.findall(r"(\w+):\s*(\S+)", self.guest(f"cat /proc/{process}/status")))
            self.assertEqual(int(facts["CapEff"], 16), 1 << CAP_IPC_LOCK | 1 << CAP_SYS_NICE)
            self.assertEqual((facts["Seccomp"], facts["NoNewPrivs"]), ("2", "1"))
            self.assertNotEqual(facts["Uid"], "0")
        node = self.status()["pid"]
        locked = re.search(r"VmLck:\s*(\d+)", self.guest(f"cat /proc/{node}/status"))
        self.assertGreater(int(locked.group(1)), 1000)
        classes = self.guest(f"ps -L -o cls=,rtprio= -p {node}").split("\n")
        self.assertIn("FF 90", [" ".join(line.split()) for line in classes])

    def test_05_nothing_was_refused(self):
        self.nothing_was_refused()
        self.assertEqual(self.guest(f"systemctl show -P NRestarts {UNIT}").strip(), "0")

    def nothing_was_refused(self):
        self.assertEqual(self.entries("-k -g 'type=1326'"), [])
        self.assertNotIn("SYS", self.guest(f"journalctl -q -u {UNIT} -g 'status=31|code=killed, status=.*SYS'", code=None))

    def test_06_the_journal_has_fields(self):
        found = self.entries("-n 200 INDUROP_MODULE=main")
        self.assertTrue(found)
        for entry in found:
            self.assertEqual((entry["INDUROP_BOARD"], entry["SYSLOG_IDENTIFIER"], entry["_SYSTEMD_UNIT"]), ("board1", "indurop-node", UNIT))
        self.assertTrue([entry for entry in found if re.fullmatch(r"run \d+", entry["MESSAGE"]) and entry["PRIORITY"] == "6"])
        self.assertEqual(self.entries("INDUROP_MODULE=another"), [])
        agent = self.entries("SYSLOG_IDENTIFIER=indurop-agent INDUROP_BOARD=board1")
        self.assertTrue([entry for entry in agent if entry["MESSAGE"].endswith(": committed")])
        # A message comes once, whichever way it takes.
        started = self.entries(f"-u {UNIT} -g 'running 1 modules'")
        self.assertEqual(len(started), len({entry["_PID"] for entry in started}))

    def test_07_an_agent_that_hangs_is_replaced_and_its_node_goes_on(self):
        agent, node = self.agent(), self.status()["pid"]
        # The lab starts its guests without watchdogs of services, and each reload of systemd (enable does one) returns to that.
        self.guest(f"systemctl service-watchdogs yes && kill -STOP {agent}")
        self.guest.until(lambda said: said.strip() not in ("", "0", str(agent)), f"systemctl show -P MainPID {UNIT}")
        self.guest.until(lambda said: said.strip() == "active", f"systemctl is-active {UNIT}")
        self.assertTrue(self.entries(f"_PID=1 -g 'Watchdog timeout' UNIT={UNIT}"))
        self.guest.until(lambda said: "taking over" in said, f"journalctl -q -u {UNIT} -g 'taking over'")
        self.assertEqual(self.status()["pid"], node)
        self.goes_on()
        # The node that lost its agent still writes to the journal.
        cursor = self.entries("-n 1 INDUROP_MODULE=main")[0]["__CURSOR"]
        self.guest.until(lambda said: "run " in said, f"journalctl -q --after-cursor '{cursor}' INDUROP_MODULE=main")

    def test_08_a_fault_is_an_error_of_its_module(self):
        # The agent that hung left its node to the next one, which is not its parent and cannot know why it ends.
        for cause in ("the node ended", "signal 9"):
            node = self.status()["pid"]
            self.guest(f"kill -9 {node}")
            self.guest.until(lambda said, before=node: said.strip().isdigit() and int(said) != before,
                             "indurop status --node board1 -o json | grep -o '\"pid\":[0-9]*' | head -n 1 | cut -d: -f2")
            self.assertTrue([entry for entry in self.entries("-p err SYSLOG_IDENTIFIER=indurop-agent") if cause in entry["MESSAGE"]], cause)
            self.goes_on()

    def test_09_the_platform_is_updated_from_the_desk(self):
        agent, node = self.agent(), self.status()["pid"]
        self.guest("indurop platform pack /usr --release-version 99.1 -o /root/99.1.release")
        # As with plants: a board that is too slow to be healthy in time goes back.
        self.guest.until(lambda said: "is committed" in said,
                         "indurop platform deploy /root/99.1.release --health 20s --timeout 10min 2>&1")
        self.assertEqual(self.agent(), agent)
        self.runs_release("99.1")
        self.assertNotEqual(self.status()["pid"], node)
        self.has_its_rights()
        self.nothing_was_refused()

    def test_10_a_release_whose_agent_hangs_is_left(self):
        self.guest(f"mkdir /root/hanging && cp -rL {self.release_folder()}/. /root/hanging")
        self.guest("cat >/root/hanging/bin/indurop-agent", input=options.hanging_agent.read_bytes())
        self.guest("indurop platform pack /root/hanging --release-version 99.2 -o /root/99.2.release")
        self.guest("systemctl service-watchdogs yes")  # 20 s here
        said = self.guest("indurop platform deploy /root/99.2.release --health 20s --timeout 10min 2>&1", code=5)
        self.assertIn("was rolled back", said)
        self.guest.until(lambda said: said.strip() == "active", f"systemctl is-active {UNIT}")
        self.runs_release("99.1")

    def release_folder(self):
        node = self.status()["pid"]
        return pathlib.PurePath(self.guest(f"readlink /proc/{node}/exe").strip()).parent.parent

    def runs_release(self, version):
        self.guest.until(lambda said: [(board["release"], board["state"]) for board in json.loads(said)["boards"]] == [(version, "running")],
                         "indurop platform status -o json")
        deployed = str(self.release_folder()).startswith("/var/lib/indurop/board1/platform/")
        self.assertEqual(deployed, version != self.installed())
        self.goes_on()

    def installed(self):
        return self.guest("dpkg-query -W -f '${Version}' indurop").strip()

    def test_11_a_machine_that_hangs_is_reset_and_the_plant_resumes_before_the_network(self):
        self.guest("mkdir -p /etc/systemd/system.conf.d && printf '[Manager]\\nRuntimeWatchdogSec=60s\\n' "
                   ">/etc/systemd/system.conf.d/watchdog.conf && systemctl daemon-reexec")
        self.guest.until(lambda said: said.strip() == "active", "cat /sys/class/watchdog/watchdog0/state")
        # The card gets its address long after the agent has said that it is ready.
        self.drop_in("lab-board.service", "late", f"[Unit]\nAfter={UNIT}\n[Service]\nExecStartPre=sleep 15\n")
        saved = self.runs() - 150
        boot = self.guest("cat /proc/sys/kernel/random/boot_id")
        # Without an end of its own (panic=0) the kernel hangs after a panic, and only the watchdog is left.
        self.guest("sync; echo 0 >/proc/sys/kernel/panic; (sleep 1; echo c >/proc/sysrq-trigger) >/dev/null 2>&1 &", code=None)
        self.guest.until(lambda said: re.fullmatch(r"[0-9a-f-]{36}\s*", said) is not None and said != boot,
                         "cat /proc/sys/kernel/random/boot_id")
        self.goes_on()
        self.assertGreater(self.runs(), saved)
        node = int(self.entries("-b INDUROP_BOARD=board1 -g 'running 1 modules'")[0]["__MONOTONIC_TIMESTAMP"])
        network = int(self.guest("systemctl show -P ActiveEnterTimestampMonotonic lab-board.service"))
        self.assertLess(node, network)
        self.guest.until(lambda said: "board1" in said, "indurop boards 2>&1")
        self.runs_release("99.1")

    def test_12_the_platform_goes_back(self):
        self.guest.until(lambda said: "is committed" in said, "indurop platform back --health 20s --timeout 10min 2>&1")
        self.runs_release(self.installed())
        self.nothing_was_refused()

    def test_13_a_full_disk_is_reported_and_stops_nothing(self):
        as_board = "setpriv --reuid=indurop --regid=indurop --clear-groups"
        self.guest(f"cd /var/lib/indurop && {as_board} sh -c 'fallocate -l $(df --output=avail -B1 . | tail -n 1) ballast; "
                   "cat /dev/zero >>ballast' 2>&1 | grep -q 'No space left'")
        why = "retained variables cannot be saved"
        self.guest.until(lambda said: why in said, "indurop status --node board1 2>&1")
        self.assertTrue([entry for entry in self.entries(f"-b -p err INDUROP_BOARD=board1 -g '{why}'")])
        self.guest("cat >/root/plant/plant.xml", input=PLANT.replace("20ms", "30ms").encode())
        self.assertIn("board1: disk full", self.guest("indurop deploy /root/plant/plant.xml --timeout 5min 2>&1", code=1))
        # The board has all files of this release; only the switch itself needs space.
        self.assertIn("No space left on device", self.guest("indurop platform deploy /root/99.1.release --timeout 5min 2>&1", code=5))
        self.goes_on()
        self.guest("rm /var/lib/indurop/ballast")
        self.guest.until(lambda said: why not in said, "indurop status --node board1 2>&1")
        self.guest.until(lambda said: "is committed" in said, "indurop deploy /root/plant/plant.xml --timeout 5min 2>&1")
        self.goes_on()

    def test_14_a_wrong_clock_stops_nothing(self):
        """As a board without a battery has one until its clock is set."""
        now = self.guest("date +%s").strip()
        before = self.runs()
        self.guest(f"date -s 1970-01-02 && systemctl restart {UNIT}")  # not before the time that the machine has run
        self.goes_on()
        self.assertGreater(self.runs(), before - 150)
        self.assertEqual(self.guest("date +%Y").strip(), "1970")
        self.guest("cat >/root/plant/plant.xml", input=PLANT.replace("20ms", "40ms").encode())
        self.guest.until(lambda said: "is committed" in said, "indurop deploy /root/plant/plant.xml --timeout 5min 2>&1")
        latest = self.status()["deployment"]
        self.guest(f"date -s @{now}")
        self.goes_on()
        self.guest(f"systemctl restart {UNIT}")
        self.goes_on()
        self.assertEqual(self.status()["deployment"], latest)

    def test_15_a_package_that_is_removed_says_what_goes_on(self):
        node = self.status()["pid"]
        said = self.guest("DEBIAN_FRONTEND=noninteractive apt-get remove -y indurop 2>&1")
        self.assertIn("these go on without their files", said)
        self.assertIn(f"(process {node})", said)
        cursor = self.entries("-n 1 INDUROP_MODULE=main")[0]["__CURSOR"]
        self.guest.until(lambda said: "run " in said, f"journalctl -q --after-cursor '{cursor}' INDUROP_MODULE=main")
        self.guest("cd /root/debs && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ./indurop_*.deb")
        self.assertEqual(self.status()["pid"], node)

    def test_16_systemd_has_little_to_say_against_the_service(self):
        said = self.guest(f"systemd-analyze security --no-pager {UNIT}")
        exposure = float(re.search(r"Overall exposure level.*?: ([\d.]+)", said).group(1))
        print(f"systemd-analyze security: {exposure}")
        self.assertLessEqual(exposure, 3.0)

    def test_17_it_stops_by_command(self):
        self.guest(f"systemctl stop {UNIT}")
        self.assertIn("stopped", self.guest("indurop status --node board1 2>&1", code=None))
        self.assertEqual(self.guest(f"systemctl is-failed {UNIT}", code=None).strip(), "inactive")


def main():
    global options
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--module", type=pathlib.Path, required=True)
    parser.add_argument("--hanging-agent", type=pathlib.Path, required=True)
    parser.add_argument("--debs", type=pathlib.Path, required=True)
    options, rest = parser.parse_known_args()
    missing = [tool for tool in ("qemu-system-x86_64", "mmdebstrap", "ssh", "ip") if not shutil.which(tool)]
    why = ""
    if os.geteuid() != 0:
        why = "needs root"
    elif missing:
        why = f"not installed: {', '.join(missing)}"
    elif not list(options.debs.glob("indurop_*.deb")):
        why = f"no packages in {options.debs}; make deb builds them"
    if why:
        print(f"skipped: {why}")
        sys.exit(SKIPPED)
    unittest.main(argv=[sys.argv[0], "-v", *rest])


if __name__ == "__main__":
    main()
