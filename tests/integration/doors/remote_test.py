#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A board through `indurop serve` in Python: the same values as a node of this machine, changes by role, TLS by the
authority of a plant. What the server holds is compared with the local package and the command line."""

import asyncio
import math
import pathlib
import re
import subprocess
import threading
import unittest

from doors_node import OPTIONS, PATIENCE, NodeTest, indurop, wait_until

TOKEN = "a-token-of-the-test-bench"


class Remote(NodeTest):
    def setUp(self):
        super().setUp()
        self.server = None
        tokens = self.work / "tokens"
        tokens.write_text(f"bench {TOKEN}\nviewer a-token-that-only-looks read\n")
        tokens.chmod(0o600)
        self.options = ["--write", "--token-file", tokens]
        self.address = self.serve(*self.options)

    def tearDown(self):
        self.stop_server()
        super().tearDown()

    def serve(self, *options, port=0):
        """Starts a server, and returns its address."""
        self.server = subprocess.Popen([pathlib.Path(OPTIONS.indurop).parent / "indurop-serve", "--node", self.name,
                                        "--port", str(port), "--audit", self.work / "audit.jsonl", *options],
                                       cwd=self.work, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        for line in self.server.stdout:
            if found := re.search(r"(https?)://([\w.\[\]:]+):(\d+)/", line):
                threading.Thread(target=self.server.stdout.read, daemon=True).start()
                return f"{found[1]}://{found[2]}:{found[3]}"
        raise AssertionError("the server does not start")

    def stop_server(self):
        if self.server is not None:
            self.server.terminate()
            self.server.wait(PATIENCE)
            self.server.stdout.close()
            self.server = None

    def remote(self, **options):
        return indurop.remote(self.address, **{"token": TOKEN, **options})

    def test_the_same_as_a_node_of_this_machine(self):
        with self.remote() as remote:
            self.assertEqual(remote.name, self.name)
            self.assertTrue(remote.running)
            self.assertEqual(sorted(remote), sorted(self.node))
            self.assertEqual(len(remote), len(self.node))
            for name in self.node:
                mine, theirs = remote.variable(name), self.node.variable(name)
                for what in ("name", "type", "unit", "range", "retain", "description", "source", "size"):
                    self.assertEqual(getattr(mine, what), getattr(theirs, what), (name, what))
                self.assertEqual(mine.layout.dtype(), theirs.layout.dtype(), name)
                if name not in ("doors::count", "doors::twice"):
                    self.assertEqual(remote[name], self.node[name], name)
            self.assertEqual(remote.variable("places[1].x").range, (-10, 10))
            self.assertIn("places[1].x", remote)
            self.assertNotIn("place", remote)

    def test_changes_are_those_of_the_local_package(self):
        with self.remote() as remote:
            for name, value in (("places[1]", {"x": 2.5, "name": 'a "b", ü'}), ("places[1].valid", True),
                                ("grid", [[1, 2, 3], [-4, 5, -128]]), ("mode", "AUTO"), ("mode", 0), ("text", ""),
                                ("text", "{x: 1}"), ("gain", 2.5), ("places[2]", indurop.Record(y=-1e300, valid=True)),
                                ("places[0].y", math.inf), ("places[2].y", 5e-324)):
                remote[name] = value
                self.assertEqual(remote[name], self.node[name], name)
                written = self.node[name]
                if isinstance(value, (int, float, list)):
                    self.assertEqual(written, value, name)
            self.assertEqual(self.node["places[1]"].name, 'a "b", ü')
            remote["places[0].y"] = math.nan
            self.assertTrue(math.isnan(remote["places[0].y"]))
            # JSON has neither infinities nor the sign of zero, and a float has fewer digits there.
            for number in (math.inf, -math.inf, -0.0):
                remote["places[0].y"] = number
                self.assertEqual(repr(remote["places"]), repr(self.node["places"]))
                self.assertEqual(repr(remote["places[0].y"]), repr(number))
            remote["gain"] = 0.1
            self.assertEqual(remote["gain"], self.node["gain"])
            remote.variable("gain").write(3, reason="a trial of the bench")
        audit = (self.work / "audit.jsonl").read_text()
        self.assertIn("a trial of the bench", audit)
        self.assertIn('"bench"', audit)

    def test_refuses_and_changes_nothing(self):
        with self.remote() as remote:
            for name, value, error in (("gain", 11, indurop.OutOfRange), ("gain", "much", indurop.OutOfRange),
                                       ("grid", [[1, 2, 3], [4, 5, 128]], indurop.OutOfRange),
                                       ("grid", [[1, 2, 3]], indurop.OutOfRange), ("mode", 3, indurop.OutOfRange),
                                       ("text", "x" * 16, indurop.OutOfRange),
                                       ("text", "a\0b", indurop.OutOfRange),
                                       ("places[0].valid", "false", indurop.OutOfRange),
                                       ("places[0].x", 11, indurop.OutOfRange),
                                       ("places[0]", {"z": 1}, indurop.OutOfRange), ("gian", 1, indurop.NotFound)):
                with self.assertRaises(error, msg=f"{name} = {value}"):
                    remote[name] = value
            with self.assertRaisesRegex(indurop.NotFound, "did you mean 'doors::gain'"):
                remote.variable("gian")
            self.assertEqual(self.shown_value("grid"), [[0, 0, 0], [0, 0, 0]])
            self.indurop("lock", "--node", self.name, "all")
            with self.assertRaises(indurop.Locked):
                remote["gain"] = 1
        with self.remote(token="a-token-that-only-looks") as viewer, self.assertRaises(indurop.Denied):
            viewer["gain"] = 1
        with self.remote(token="") as anyone, self.assertRaises(indurop.Denied):
            anyone["gain"] = 1
        with self.assertRaises(indurop.Denied):
            self.remote(token="not-the-token-of-this-bench")
        with self.assertRaisesRegex(indurop.NotFound, self.name):
            self.remote(board="lokal")
        with self.assertRaises(indurop.Invalid):
            indurop.remote("ftp://desk")
        self.assertAlmostEqual(self.node["gain"], 1.5)

    def test_forces(self):
        with self.remote() as remote:
            gain = remote.variable("gain")
            gain.force(3, reason="test stand")
            self.assertTrue(gain.quality.forced)
            self.assertFalse(gain.quality.good)
            with self.assertRaises(indurop.Forced):
                gain.write(1)
            self.assertEqual(self.node["gain"], 3)
            gain.release()
            gain.write(1)
            self.assertTrue(gain.quality.good)
            with self.assertRaises(indurop.NotFound):
                gain.release()
            for seconds in (1e-12, 0.05):  # 0 ns would mean until it is released
                gain.force(3, seconds=seconds)
                wait_until("the force times out", lambda: not gain.quality.forced)
            for seconds in (-1, float("nan"), float("inf"), 1e300):
                with self.assertRaises(indurop.Invalid):
                    gain.force(3, seconds=seconds)
            self.assertFalse(gain.quality.forced)

    def test_watching(self):
        with self.remote() as remote:
            seen = []
            for value in remote.variable("count").watch(timeout=PATIENCE, rate_hz=100):
                seen.append(value)
                if len(seen) == 20:
                    break
            self.assertEqual(seen, sorted(set(seen)))
            places = remote.variable("places").watch(timeout=PATIENCE, rate_hz=100)
            self.assertEqual(next(places), self.node["places"])
            self.node["places[2]"] = {"x": 1.25, "name": "tool"}
            self.assertEqual(next(places), self.node["places"])
            with self.assertRaises(indurop.Timeout):
                list(remote.variable("gain").watch(timeout=0.2))

            async def some():
                found = []
                async for value in remote.variable("count").watch_async(rate_hz=100):
                    found.append(value)
                    if len(found) == 5:
                        break
                return found

            found = asyncio.run(some())
            self.assertEqual(found, sorted(set(found)))

    def test_the_end_of_a_node_and_of_a_server(self):
        with self.remote() as remote:
            watched = remote.variable("count").watch(rate_hz=100)
            next(watched)
            self.stop()
            rest = list(watched)  # ends when the node ends
            last = self.node["count"]
            self.assertEqual(last, rest[-1] if rest else last)
            self.assertFalse(remote.running)
            self.start()
            wait_until("the node is there again", lambda: remote.running)
            watched = remote.variable("count").watch(rate_hz=100)
            next(watched)
            port = int(self.address.rsplit(":", 1)[1])
            self.stop_server()
            with self.assertRaises(indurop.Unreachable):
                list(watched)
            with self.assertRaises(indurop.Unreachable):
                remote["gain"]  # pylint: disable=pointless-statement
            self.serve(*self.options, port=port)
            self.assertAlmostEqual(remote["gain"], 1.5, msg="a connection that was kept is opened again")

    def test_a_session_of_a_user(self):
        self.stop_server()
        done = subprocess.run([OPTIONS.indurop, "users", "add", "anna", "--role", "operate"], cwd=self.work,
                              input="correct horse\n", capture_output=True, text=True, check=False, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.address = self.serve("--write", "--users", self.work / "users.xml")
        with self.remote(token="", user="anna", password="correct horse") as remote:
            remote["gain"] = 4
            with self.assertRaises(indurop.Denied):
                remote.variable("gain").force(5)
        with self.assertRaises(indurop.Denied):
            self.remote(token="", user="anna", password="wrong horse")

    def test_tls_by_the_authority_of_the_plant(self):
        self.stop_server()
        (self.work / "plant.xml").write_text('<plant name="cell"><board name="drive"></board></plant>')
        self.indurop("keys", "init", "plant.xml", "--dir", "keys")
        self.indurop("keys", "server", "desk", "--dir", "keys", "--host", "127.0.0.1")
        keys = self.work / "keys" / "servers" / "desk"
        address = self.serve(*self.options, "--cert", keys / "server.pem", "--key", keys / "server.key")
        self.address = address.replace("https://", "")
        with self.remote(ca=str(keys / "ca.pem")) as remote:
            remote["gain"] = 5
            self.assertEqual(self.node["gain"], 5)
            self.assertGreater(next(remote.variable("count").watch(timeout=PATIENCE)), 0)
        with self.assertRaisesRegex(indurop.Unreachable, "certificate"):
            indurop.remote(address, token=TOKEN)
        with self.assertRaises(indurop.Unreachable):
            indurop.remote(self.address, token=TOKEN)
        with self.assertRaisesRegex(indurop.Unreachable, "certificate"):
            indurop.remote(self.address.replace("127.0.0.1", "localhost"), token=TOKEN, ca=str(keys / "ca.pem"))

    def test_a_certificate_of_the_plant_is_a_right(self):
        self.stop_server()
        (self.work / "plant.xml").write_text('<plant name="cell"><board name="drive"></board></plant>')
        self.indurop("keys", "init", "plant.xml", "--dir", "keys")
        self.indurop("keys", "server", "desk", "--dir", "keys", "--host", "127.0.0.1")
        keys = self.work / "keys"
        self.address = self.serve("--write", "--cert", keys / "servers/desk/server.pem", "--key",
                                  keys / "servers/desk/server.key", "--client-ca", keys / "ca.pem")

        def remote(who):
            identity = (str(keys / who / "identity.pem"), str(keys / who / "identity.key"))
            return indurop.remote(self.address, ca=str(keys / "ca.pem"), certificate=identity)

        with remote("deployer") as deployer:
            deployer["gain"] = 6
            self.assertEqual(self.node["gain"], 6)
            self.assertGreater(next(deployer.variable("count").watch(timeout=PATIENCE)), 0)
        with remote("viewer") as viewer:
            self.assertEqual(viewer["gain"], 6)
            with self.assertRaises(indurop.Denied):
                viewer["gain"] = 7


if __name__ == "__main__":
    unittest.main(verbosity=2)
