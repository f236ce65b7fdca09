#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_packages.py SOURCE BUILD WORK: the Debian packages as far as minutes allow, from what `cmake --install` writes: each
file is in exactly one package, the maintainer scripts are shell, user and folders can be made, the lists of packages agree."""

import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

source, build, work = (pathlib.Path(), pathlib.Path(), pathlib.Path())
# Packages of the group build that are no build dependencies: essential, or for who builds again and again.
NOT_NEEDED = {"build-essential", "ccache"}


def debian():
    return source / "cmake/packaging/debian"


def library_folder():
    cache = (build / "CMakeCache.txt").read_text()
    return "usr/" + re.search(r"^CMAKE_INSTALL_LIBDIR:\w+=(.*)$", cache, re.MULTILINE).group(1)


def patterns():
    """Pairs of package and pattern of the *.install files; what comes from debian/ itself is checked by dh_install."""
    for file in sorted(debian().glob("*.install")):
        for line in file.read_text().splitlines():
            pattern = line.split()[0]
            if not pattern.startswith("debian/"):
                yield file.stem, pattern.replace("usr/lib/${DEB_HOST_MULTIARCH}", library_folder())


def matches(name, pattern):
    """As dh_install takes it: a pattern may stand for a folder with all that is in it, and * ends at a slash."""
    parts, wanted = name.split("/"), pattern.split("/")
    return len(parts) >= len(wanted) and all(map(fnmatch.fnmatchcase, parts, wanted))


def control():
    """The paragraphs of debian/control by the name of their package; the source's is ""."""
    found = {}
    for paragraph in (debian() / "control").read_text().split("\n\n"):
        fields = dict(re.findall(r"^(\S+):((?:.*\n?)(?:^ .*\n?)*)", paragraph, re.MULTILINE))
        found[fields.get("Package", "").strip()] = fields
    return found


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(work, ignore_errors=True)
        cls.root = work / "root"
        subprocess.run(["cmake", "--install", build, "--prefix", "/usr", "--strip"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "DESTDIR": str(cls.root)})
        cls.files = []
        for path in cls.root.rglob("*"):
            if path.is_symlink() or path.is_file():
                name = str(path.relative_to(cls.root))
                cls.files.append(name.replace("usr/share/doc/InduRoP/", "usr/share/doc/indurop/"))

    def test_every_installed_file_is_in_exactly_one_package(self):
        wrong = []
        for name in sorted(set(self.files) - {"usr/share/doc/indurop/LICENSE"}):  # debian/copyright says it
            owners = {package for package, pattern in patterns() if matches(name, pattern)}
            if len(owners) != 1:
                wrong.append(f"{name}: {', '.join(sorted(owners)) or 'no package'}")
        self.assertEqual(wrong, [], "write these into cmake/packaging/debian/*.install")

    def test_every_pattern_stands_for_a_file(self):
        optional = ("share/indurop/web", "indurop-opcua", "share/indurop/opcua")  # without npm there is neither
        unused = [f"{package}: {pattern}" for package, pattern in patterns()
                  if not any(one in f"{package}: {pattern}" for one in optional) and not any(matches(name, pattern) for name in self.files)]
        self.assertEqual(unused, [])

    def test_nothing_has_the_rights_of_another_user(self):
        self.assertEqual([str(path) for path in self.root.rglob("*") if not path.is_symlink() and path.stat().st_mode & 0o6000], [])

    def test_an_installation_shows_the_examples(self):
        """From where it was put, not from the build tree; `indurop demo chapter` reads no terminal and ends on its own."""
        shown = subprocess.run([self.root / "usr/bin/indurop", "demo", "chapter", "--folder", work / "demo"], text=True,
                               capture_output=True, check=False, timeout=240)
        self.assertEqual(shown.returncode, 0, shown.stdout + shown.stderr)
        self.assertIn("cntr4", shown.stdout)


class Control(unittest.TestCase):
    def test_it_is_built_with_what_the_build_needs(self):
        needed = {line.split()[0] for line in (source / ".ci/packages.txt").read_text().splitlines()
                  if line and not line.startswith("#") and "build" in line.split()[1].split(",")}
        written = set(re.findall(r"[a-z0-9+.-]+", re.sub(r"\([^)]*\)|:native|<[^>]*>", "", control()[""]["Build-Depends"])))
        self.assertEqual(needed - NOT_NEEDED, written - {"debhelper-compat", "dh-sequence-installsysusers"})

    def test_a_real_time_kernel_is_recommended_and_never_needed(self):
        fields = control()["indurop"]
        self.assertIn("linux-image-rt-amd64", fields["Recommends"])
        for package, fields in control().items():
            self.assertNotIn("linux-image", fields.get("Depends", ""), package)

    def test_no_package_for_boards_needs_a_compiler(self):
        for package, fields in control().items():
            if package:
                needed = fields["Depends"] + fields.get("Recommends", "")
                self.assertNotRegex(needed, r"g\+\+|gcc|clang|cmake|build-essential", package)

    def test_no_question_is_asked(self):
        names = {path.name for path in debian().iterdir()}
        self.assertFalse({name for name in names if name.endswith((".config", ".templates"))})
        self.assertNotIn("debconf", (debian() / "control").read_text())


class Scripts(unittest.TestCase):
    def scripts(self):
        found = sorted(path for kind in ("preinst", "postinst", "prerm", "postrm") for path in debian().glob(f"*.{kind}"))
        self.assertTrue(found)
        return found + sorted((source / "cmake/packaging").glob("*.sh"))

    def test_they_are_shell(self):
        for script in self.scripts():
            subprocess.run(["sh", "-n", script], check=True)
            if shutil.which("shellcheck"):
                subprocess.run(["shellcheck", "-s", "sh", script], check=True)

    def test_they_end_at_the_first_error_and_run_what_debhelper_adds(self):
        for script in self.scripts():
            text = script.read_text()
            self.assertRegex(text, r"(?m)^set -eu?$", script)
            if script.parent == debian():
                self.assertIn("\n#DEBHELPER#\n", text, script)

    def test_user_and_folders_can_be_made_twice(self):
        if not shutil.which("systemd-sysusers") or not shutil.which("systemd-tmpfiles") or os.geteuid() != 0:
            self.skipTest("no systemd, or not root")
        root = work / "users"
        shutil.rmtree(root, ignore_errors=True)
        (root / "etc").mkdir(parents=True)
        (root / "var/lib").mkdir(parents=True)
        for _ in range(2):
            subprocess.run(["systemd-sysusers", f"--root={root}", source / "cmake/packaging/systemd/indurop.sysusers"], check=True)
            subprocess.run(["systemd-tmpfiles", f"--root={root}", "--create", debian() / "indurop.tmpfiles"], check=True)
        users = (root / "etc/passwd").read_text().splitlines()
        self.assertEqual(len(users), 1)
        self.assertTrue(users[0].startswith("indurop:"))
        state = (root / "var/lib/indurop").stat()
        self.assertEqual((state.st_uid, state.st_mode & 0o7777), (int(users[0].split(":")[2]), 0o750))


@unittest.skipUnless(shutil.which("dpkg-deb"), "no dpkg-deb")
class Architecture(unittest.TestCase):
    def refused(self, written):
        """What is said of a package with one of this machine's programs that has `written` as its architecture."""
        root = work / "one"
        shutil.rmtree(root, ignore_errors=True)
        (root / "DEBIAN").mkdir(parents=True)
        (root / "DEBIAN/control").write_text(
            f"Package: one\nVersion: 1\nArchitecture: {written}\nMaintainer: one <one@example.org>\nDescription: one\n")
        shutil.copy(sys.executable, root / "program")
        subprocess.run(["dpkg-deb", "-b", root, work / "one.deb"], check=True, stdout=subprocess.DEVNULL)
        said = subprocess.run([source / "cmake/packaging/check_architecture.py", "arm64" if written == "all" else written, work / "one.deb"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(said.returncode != 0, ": error: " in said.stdout, said.stdout + said.stderr)
        return said.returncode != 0

    def test_a_package_with_programs_of_another_one_is_refused(self):
        own = subprocess.run(["dpkg", "--print-architecture"], capture_output=True, text=True, check=True).stdout.strip()
        for written in ("amd64", "arm64", "all"):
            self.assertEqual(self.refused(written), written != own, written)


if __name__ == "__main__":
    source, build, work = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    del sys.argv[1:4]
    unittest.main(verbosity=2)
