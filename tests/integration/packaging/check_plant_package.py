#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_plant_package.py INDUROP PLANT WORK: what `indurop package` makes of a built plant and of its bundle: an installable
package that is the same byte by byte each time, has the bundle as it was packed, and runs nothing while it is installed."""

import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

indurop, plant, work = (pathlib.Path(), pathlib.Path(), pathlib.Path())
INSTALLED = "usr/share/indurop/plants/two_boards.bundle"
NAME = "indurop-plant-two.boards"


def run(*words, **more):
    return subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **more)


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


@unittest.skipUnless(shutil.which("dpkg-deb"), "no dpkg-deb")
class PlantPackage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        cls.bundle = work / "cell.bundle"
        packed = run(indurop, "pack", plant, "-o", cls.bundle, "-m", "gripper opens wider")
        assert packed.returncode == 0, packed.stderr

    def make(self, name, source, *more, umask=-1):
        file = work / name
        made = run(indurop, "package", source, "--package-version", "1.2", "-o", file, *more, umask=umask)
        self.assertEqual(made.returncode, 0, made.stderr)
        return file

    def test_the_same_bundle_gives_the_same_bytes(self):
        first = self.make("first.deb", self.bundle)
        self.assertEqual(digest(first), digest(self.make("second.deb", self.bundle, umask=0o077)))
        self.assertEqual(digest(first), digest(self.make("third.deb", plant, "-m", "gripper opens wider")))

    def test_it_says_what_it_is_and_runs_nothing(self):
        file = self.make("about.deb", self.bundle)
        fields = run("dpkg-deb", "-f", file).stdout
        for line in ("Package: " + NAME, "Version: 1.2", "Architecture: all", "  Comment: gripper opens wider"):
            self.assertIn(line + "\n", fields)
        self.assertRegex(fields, r"Depends: indurop \(>= [0-9.]+\)")
        self.assertIn("indurop deploy\n  /" + INSTALLED, fields)
        control = run("dpkg-deb", "-I", file).stdout
        for script in ("preinst", "postinst", "prerm", "postrm", "config"):
            self.assertNotIn(script, control)

    def test_it_installs_the_bundle_and_takes_it_away(self):
        file = self.make("installed.deb", self.bundle)
        root = work / "root"
        for folder in ("var/lib/dpkg/info", "var/lib/dpkg/updates"):
            (root / folder).mkdir(parents=True)
        (root / "var/lib/dpkg/status").touch()
        dpkg = ["dpkg", f"--root={root}", "--force-not-root", "--force-depends", "--force-bad-path",
                f"--log={work / 'dpkg.log'}"]
        done = run(*dpkg, "-i", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(digest(root / INSTALLED), digest(self.bundle))
        self.assertEqual((root / INSTALLED).stat().st_mode & 0o777, 0o644)
        self.assertEqual(run(*dpkg, "-P", NAME).returncode, 0)
        self.assertFalse((root / INSTALLED).exists())

    def test_lintian_finds_nothing(self):
        if not shutil.which("lintian"):
            self.skipTest("no lintian")
        file = self.make("judged.deb", self.bundle)
        # Whose the plant is, and since when, is not ours to say.
        judged = run("lintian", "--fail-on", "error,warning", "--allow-root",
                     "--suppress-tags", "copyright-without-copyright-notice", file)
        self.assertEqual(judged.returncode, 0, judged.stdout)

    def test_a_version_and_who_made_it_are_checked(self):
        none = run(indurop, "package", self.bundle)
        self.assertEqual(none.returncode, 2)
        self.assertIn("--package-version 1.0", none.stderr)
        self.assertIn("a version begins with a digit", run(indurop, "package", self.bundle, "--package-version", "v1-2").stderr)
        wrong = run(indurop, "package", self.bundle, "--package-version", "1", "--maintainer", "me")
        self.assertIn("write NAME <ADDRESS>", wrong.stderr)

    def test_a_damaged_bundle_becomes_no_package(self):
        damaged = work / "damaged.bundle"
        data = bytearray(self.bundle.read_bytes())
        data[len(data) // 2] ^= 1
        damaged.write_bytes(data)
        refused = run(indurop, "package", damaged, "--package-version", "1", "-o", work / "damaged.deb")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("damaged", refused.stderr)
        self.assertEqual([name for name in os.listdir(work) if name.startswith("damaged.deb")], [])


if __name__ == "__main__":
    indurop, plant, work = map(pathlib.Path, sys.argv[1:4])
    unittest.main(argv=sys.argv[:1] + sys.argv[4:], verbosity=2)
