#!/usr/bin/env python3
"""Shows the settings of clang-tidy, and what finds the files for it, violations that they have to find."""

import json
import shutil
import subprocess
import unittest

import check_tidy

from sample import HEAD, ROOT, Sample


class Tidy(Sample):
    def setUp(self):
        super().setUp()
        shutil.copy(ROOT / ".clang-tidy", self.root)

    def tidy(self, text):
        self.put("core/rt/a.cpp", HEAD + text)
        entry = {"file": str(self.root / "core/rt/a.cpp"), "directory": str(self.root), "command": "c++ -std=c++20 -c core/rt/a.cpp"}
        return check_tidy.tidy_one(self.root, self.root, entry, self.root, b"")

    def test_clean_file_is_remembered(self):
        self.assertEqual(self.tidy("int twice(int a) { return a * 2; }\n"), [])
        self.assertTrue([path for path in self.root.iterdir() if len(path.name) == 64])

    def test_changed_files(self):
        def git(*words):
            subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e@example.org", *words], cwd=self.root, check=True,
                           capture_output=True)
        self.assertEqual(check_tidy.changed(self.root), ([], "no git here"))
        git("init")
        self.put("core/rt/a.cpp", HEAD)
        self.put("core/rt/b.cpp", HEAD)
        git("add", ".")
        git("commit", "-m", "one")
        self.assertEqual(check_tidy.changed(self.root)[0], [])
        self.put("core/rt/b.cpp", HEAD + "int b;\n")
        git("commit", "-am", "two")
        self.put("core/rt/c.cpp", HEAD)
        self.assertEqual(sorted(check_tidy.changed(self.root)[0]), ["core/rt/b.cpp", "core/rt/c.cpp"])

    def test_files_that_are_compiled_together(self):
        self.put("core/rt/a.cpp", HEAD + "int* f() { return 0; }\n")
        self.put("build/core/rt/Unity/unity_0_cxx.cxx", f'/* made */\n#include "{self.root}/core/rt/a.cpp"\n')
        together = {"file": str(self.root / "build/core/rt/Unity/unity_0_cxx.cxx"), "directory": str(self.root),
                    "command": "c++ -std=c++20 -c build/core/rt/Unity/unity_0_cxx.cxx"}
        alone = {**together, "file": str(self.root / "core/rt/b.cpp")}
        self.put("build/compile_commands.json", json.dumps([together, alone]))
        entries = list(check_tidy.compiled(self.root / "build"))
        self.assertEqual([entry["file"] for entry in entries], [str(self.root / "core/rt/a.cpp"), alone["file"]])
        self.found(check_tidy.tidy_one(self.root, self.root, entries[0], self.root, b""), "core/rt/a.cpp", "modernize-use-nullptr")

    def test_findings_are_remembered(self):
        self.assertEqual(*(self.tidy("int* f() { return 0; }\n") for _ in range(2)))

    def test_function_name(self):
        self.found(self.tidy("int TwiceAsMuch(int a) { return a * 2; }\n"), "readability-identifier-naming")

    def test_private_member_name(self):
        text = "class A {\n  int a = 0;\n\n public:\n  int get() const { return a; }\n};\nint f() { return A().get(); }\n"
        self.found(self.tidy(text), "readability-identifier-naming")

    def test_macro_name(self):
        self.assertTrue(any("naming" in line for line in self.tidy("#define Other 1\n")))

    def test_analyzer(self):
        text = "int f(bool a) {\n  int* p = nullptr;\n  int b = 1;\n  if (!a) {\n    p = &b;\n  }\n  return *p;\n}\n"
        self.found(self.tidy(text), "clang-analyzer-core.NullDereference")

    def test_misspelt_family(self):
        self.put(".clang-tidy", (ROOT / ".clang-tidy").read_text().replace("bugprone-*", "bug-prone-*"))
        self.put("core/rt/clock.cpp", HEAD)
        self.found(check_tidy.families(self.root), "bugprone")


if __name__ == "__main__":
    unittest.main()
