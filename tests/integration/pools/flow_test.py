#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Chunks reach a module of another node, and a subscriber that knows only pool.idl; each byte is compared. They keep
their age, are sent on demand and at most at the given rate, and a receiver that is stopped does not stop the writer."""

import os
import shutil
import signal
import subprocess
import time

from harness import LARGE, SMALL, Setting, expect, wait_for


def sent_on_demand(test):
    test.pools("send", "a", "--plant", "cell", "--send", LARGE, "--send", "small")
    wait_for(lambda: test.says("send", "sends " + SMALL), "the sender has the pools")
    test.grows("a", "written", 10, "the writer writes")
    wait_for(lambda: test.counts("send"), "a report")
    expect(test.counts("send")[LARGE]["sent"] == 0, "sent without a reader")
    user = [one for one in test.pool("a", LARGE)["users"] if one["name"] == "indurop-pools"]
    expect(len(user) == 1 and user[0]["seen"] == 0, "chunks were read without a reader: " + str(user))


def hear_no_other_plant(test):
    """A plant built from the same .glb in the same network."""
    test.pools("stranger", "b", "--plant", "cell2", "--receive", LARGE)
    wait_for(lambda: test.says("stranger", "receives topic"), "the receiver has the pool")
    time.sleep(3)  # others discover each other in less
    expect(test.counts("stranger")[LARGE]["senders"] == 0, "a sender of another plant is heard")
    test.end("stranger")


def reach_another_node(test):
    test.pools("receive", "b", "--plant", "cell", "--receive", LARGE, "--receive", SMALL)
    test.grows("b", "large_seen", 20, "chunks of many parts reach the other node")
    test.grows("b", "small_seen", 20, "chunks of one part reach the other node")
    error_ms = test.value("b", "age_error_ns") / 1e6
    print(f"age() differs from the time since the writer began a chunk by {error_ms:.1f} ms at most")
    # The writer needs some milliseconds between its stamp and publish(); on a busy machine more.
    expect(error_ms < 1000, "age() does not include the transport, or more than it")
    shown = test.pool("b", LARGE)
    names = sorted(one["name"] for one in shown["users"])
    expect(names == ["indurop-pools", "pools_checker"], f"users of the pool: {names}")


def reach_a_subscriber(test, program, what):
    for topic in ("pooltest/Flow/large", "pooltest/Flow/small"):
        done = subprocess.run([program, str(test.domain), topic, "10"], capture_output=True, text=True, check=False,
                              env=test.environment, timeout=60)
        expect(done.returncode == 0, f"{what} of {topic}: code {done.returncode}: {done.stdout[-500:]}{done.stderr[-500:]}")


def late_subscriber(test):
    """Who subscribes when nothing is written any more gets the newest chunk."""
    writer = [one["pid"] for one in test.pool("a", LARGE)["users"] if one["name"] == "pools_writer"][0]
    os.kill(writer, signal.SIGSTOP)
    time.sleep(0.5)  # what is on its way arrives
    before = test.pool("a", LARGE)["published"]
    done = subprocess.run([test.build / "pools_subscriber", str(test.domain), "pooltest/Flow/large", "1"],
                          capture_output=True, text=True, check=False, env=test.environment, timeout=60)
    expect(test.pool("a", LARGE)["published"] == before, "the writer was not stopped")
    os.kill(writer, signal.SIGCONT)
    expect(done.returncode == 0, f"a late subscriber: code {done.returncode}: {done.stdout}{done.stderr}")


def stopped_receiver(test):
    without = test.value("a", "without_chunk")
    test.children["receive"].send_signal(signal.SIGSTOP)
    test.grows("a", "written", 60, "the writer goes on while the receiver is stopped")
    expect(test.value("a", "without_chunk") == without, "the writer found no chunk while a receiver was stopped")
    test.children["receive"].send_signal(signal.SIGCONT)
    test.grows("b", "large_seen", 5, "chunks come again")


def lossy_network(test):
    """One packet in twenty is lost, of parts, acknowledgements and all others."""
    if not os.environ.get("POOLS_TEST_NETWORK") or not shutil.which("iptables"):
        print("not tested: a network that loses packets (root and iptables are needed)")
        return
    rule = ["-p", "udp", "-m", "statistic", "--mode", "random", "--probability", "0.05", "-j", "DROP"]
    if subprocess.run(["iptables", "-A", "INPUT", *rule], capture_output=True, check=False).returncode != 0:
        print("not tested: a network that loses packets (iptables refuses the rule)")
        return
    for variable in ("large_seen", "small_seen"):
        test.grows("b", variable, 20, "chunks come although packets are lost")
    subprocess.run(["iptables", "-D", "INPUT", *rule], check=True)


def rate(test):
    test.end("send")
    test.pools("rate", "a", "--plant", "cell", "--send", LARGE + "@4Hz", "--send", SMALL, "--hz", "1000")
    wait_for(lambda: test.counts("rate").get(LARGE, {}).get("sent", 0) > 0 and test.says("rate", "sends " + LARGE),
             "chunks are sent")
    begin = time.monotonic()
    before = test.counts("rate")[LARGE]
    wait_for(lambda: test.counts("rate")[LARGE]["sent"] >= before["sent"] + 8, "chunks are sent at the rate")
    after = test.counts("rate")[LARGE]
    took = time.monotonic() - begin
    expect(after["sent"] - before["sent"] <= took * 4 + 2, f"{after['sent'] - before['sent']} chunks in {took:.1f} s")
    expect(after["by_rate"] > before["by_rate"], "chunks that the rate drops are not counted")


def main():
    with Setting() as test:
        test.start_node("a", [("pools_writer.exe", "50ms")])
        test.start_node("b", [("pools_checker.exe", "10ms")])
        sent_on_demand(test)
        hear_no_other_plant(test)
        reach_another_node(test)
        reach_a_subscriber(test, test.build / "pools_subscriber", "Cyclone DDS")
        if (test.build / "pools_fastdds_subscriber").exists():
            reach_a_subscriber(test, test.build / "pools_fastdds_subscriber", "Fast DDS")
        late_subscriber(test)
        stopped_receiver(test)
        lossy_network(test)
        rate(test)
        expect(test.end("receive") == 143, "the exit code after SIGTERM")
        expect(not test.wrong_chunks(), f"wrong chunks: {test.wrong_chunks()}")
        expect(test.counts("receive")[LARGE]["received"] > 0, "the last report")
        print(test.counts("receive"), test.counts("rate"))


main()
