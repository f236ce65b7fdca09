#!/usr/bin/env python3
"""Shows every lint a violation: a check that finds nothing because it is broken fails here."""

import os
import shutil
import subprocess
import unittest

import check_classes
import check_commits
import check_expressions
import check_format
import check_functions
import check_headers
import check_includes
import check_precompiled
import check_readme
import check_run
import check_symbols
import check_text
import check_tick

from sample import HEAD, HERE, ROOT, Sample


class Includes(Sample):
    def check(self, name, include):
        self.put(name, f"{HEAD}#include {include}\n")
        return check_includes.check(self.root, check_includes.load_rules(HERE / "include_rules.txt"))[0]

    def test_rooms_below_are_allowed(self):
        self.put("core/rt/clock.h", HEAD)
        self.assertEqual(self.check("scheduler/a.cpp", '"core/rt/clock.h"'), [])

    def test_no_room_reaches_into_a_program(self):
        self.found(self.check("tools/serve/a.cpp", '"tools/cli/a.h"'), "tools/serve/a.cpp:4", "of the program tools/cli/")

    def test_dds_outside_dds(self):
        self.found(self.check("network/mirror/a.cpp", "<dds/dds.h>"), "network/mirror/a.cpp:4", "dds/dds.h")

    def test_dds_inside_dds(self):
        self.assertEqual(self.check("network/dds/a.cpp", "<dds/dds.h>"), [])

    def test_xml_outside_config(self):
        self.found(self.check("scheduler/a.cpp", "<tinyxml2.h>"), "tinyxml2.h")

    def test_iceoryx_outside_vars(self):
        self.found(self.check("store/runtime/a.h", '"iceoryx_hoofs/posix_wrapper/shared_memory_object.hpp"'), "iceoryx_hoofs")

    def test_room_above(self):
        self.found(self.check("store/vars/a.cpp", '"scheduler/run_block.h"'), "scheduler/run_block.h")

    def test_dlopen_in_scheduler(self):
        self.found(self.check("scheduler/a.cpp", "<dlfcn.h>"), "dlfcn.h")

    def test_table_of_the_documentation_that_is_old(self):
        rules = self.root / "rules.txt"
        self.put("rules.txt", "# core/rt/: the floor\ncore/rt/: std core/rt/\n")
        self.put("docs/architecture.md", "<!-- rooms -->\n| `core/rt/` | the roof | - |\n<!-- /rooms -->\n")
        self.found(check_includes.check_table(self.root, rules, check_includes.load_rules(rules)), "docs/architecture.md")
        table = check_includes.table(self.root, rules, check_includes.load_rules(rules))
        self.assertIn("| `core/rt/` | the floor | - |", table)
        self.put("docs/architecture.md", f"<!-- rooms -->\n{table}<!-- /rooms -->\n")
        self.assertEqual(check_includes.check_table(self.root, rules, check_includes.load_rules(rules)), [])

    def test_permission_nobody_uses(self):
        self.put("core/rt/clock.h", HEAD)
        self.put("store/vars/a.cpp", f'{HEAD}#include "core/rt/clock.h"\n#include <vector>\n')
        rules = {"core/rt/": ["std", "core/rt/"], "store/vars/": ["std", "posix", "store/vars/", "core/rt/", "fmt", "-<dlfcn.h>"]}
        self.found(check_includes.unused(rules, check_includes.check(self.root, rules)[1]), "store/vars/ may include fmt")

    def test_third_party_in_public_header(self):
        self.found(self.check("include/indurop/a.h", "<fmt/core.h>"), "fmt/core.h")

    def test_folder_inside_a_room(self):
        self.assertEqual(self.check("config/check/a.h", '"config/model/plant.h"'), [])
        self.found(self.check("config/model/a.h", '"config/check/check.h"'), "config/check/check.h")

    def test_internals_in_example(self):
        self.found(self.check("examples/a/a.cpp", '"store/vars/store.h"'), "store/vars/store.h")

    def test_relative_path_upwards(self):
        self.found(self.check("core/rt/a.cpp", '"../rt/clock.h"'), "../rt/clock.h")

    def test_folder_without_rule(self):
        self.found(self.check("misc/a.cpp", "<vector>"), "no line in include_rules.txt")


class Text(Sample):
    def check(self, rule):
        return check_text.RULES[rule](self.root)

    def test_clean_file(self):
        self.put("core/rt/a.h", HEAD + "#pragma once\n")
        for rule in ("spdx", "todo", "disabled", "length", "characters"):
            self.assertEqual(list(self.check(rule)), [])

    def test_long_prose(self):
        table = "| " + "a " * 70 + "|"
        code = "```\n" + "x " * 70 + "\n```"
        self.put("docs/a.md", f"# Title\n\n{table}\n\n{code}\n\n`indurop {'-o ' * 50}`\n")
        self.assertEqual(list(self.check("prose")), [])
        self.put("docs/a.md", "# Title\n\n" + "word " * 24 + "\n")
        self.found(self.check("prose"), "docs/a.md:3", "column 120")

    def test_missing_spdx(self):
        self.put("core/rt/a.h", "#pragma once\n")
        self.found(self.check("spdx"), "core/rt/a.h:1", "SPDX")

    def test_missing_purpose(self):
        self.put("core/rt/a.h", HEAD.split("\n", 1)[0] + "\n#pragma once\n")
        self.found(self.check("spdx"), "core/rt/a.h:2")

    def test_semaphore_outside_of_its_room(self):
        self.put("core/rt/a.h", HEAD + "#include <semaphore.h>\nsem_t word;\n")
        self.assertEqual(list(self.check("border")), [])
        self.put("store/vars/a.h", HEAD + "  pthread_mutex_t lock;\n")
        self.found(self.check("border"), "store/vars/a.h:4", "pthread_mutex_t")
        self.put("store/vars/a.h", HEAD + "  ::sem_post(&word);\n")
        self.found(self.check("border"), "store/vars/a.h:4", "sem_post")
        self.put("store/vars/a.h", HEAD + 'constexpr auto kWords = "flock sem_t pthread_mutex_t";\n')
        self.assertEqual(list(self.check("border")), [])

    def test_print_that_throws(self):
        self.put("core/rt/a.h", HEAD + '  fmt::print(stderr, "full");\n')
        self.found(self.check("border"), "core/rt/a.h:4", "base::print")
        self.put("core/rt/a.h", HEAD + '  base::print(stderr, "full");\n')
        self.assertEqual(list(self.check("border")), [])

    def test_todo_without_issue(self):
        self.put("core/rt/a.cpp", HEAD + "// TODO" + ": later\n")
        self.found(self.check("todo"), "core/rt/a.cpp:4")

    def test_todo_with_issue(self):
        self.put("core/rt/a.cpp", HEAD + "// TODO" + "(#12): later\n")
        self.assertEqual(list(self.check("todo")), [])

    def test_disabled_test(self):
        self.put("tests/unit/a_test.cpp", HEAD + "TEST(Suite, DISABLED_Name) {}\n")
        self.found(self.check("disabled"), "tests/unit/a_test.cpp:4")

    def test_disabled_in_cmake(self):
        self.put("tests/unit/CMakeLists.txt", "set_tests_properties(a PROPERTIES DISABLED TRUE)\n")
        self.found(self.check("disabled"), "tests/unit/CMakeLists.txt:1")

    def test_long_file(self):
        self.put("core/rt/a.cpp", HEAD + "\n" * 400)
        self.found(self.check("length"), "core/rt/a.cpp")

    def test_name_of_a_test(self):
        self.put("tests/a_test.cpp", HEAD + "TEST(Job, AllErrorsAtOnce) {}\nTEST(Job, All_errors) {}\nTEST(Job, Ends) {}\n")
        self.found(self.check("names"), "tests/a_test.cpp:4", "AllErrorsAtOnce")

    def test_name_of_a_test_in_small_letters(self):
        self.put("tests/a_test.cpp", HEAD + "TEST_F(Job, all_errors) {}\n")
        self.found(self.check("names"), "tests/a_test.cpp:4")

    def test_invisible_character(self):
        self.put("docs/a.md", "no\u00a0break\n")
        self.found(self.check("characters"), "docs/a.md:1", "invisible")

    def test_foreign_letter_in_comment(self):
        self.put("core/rt/a.cpp", HEAD + "// \u00b5s\n")
        self.found(self.check("characters"), "core/rt/a.cpp:4", "ASCII")

    def test_foreign_letter_in_string(self):
        self.put("core/rt/a.cpp", HEAD + 'const char* k = "\u00b5s";\n')
        self.assertEqual(list(self.check("characters")), [])

    def test_white_space_at_end(self):
        self.put("core/rt/a.cpp", HEAD + "int a; \n")
        self.found(self.check("characters"), "core/rt/a.cpp:4", "white space")

    def test_no_newline_at_end(self):
        self.put("core/rt/a.cpp", HEAD + "int a;")
        self.found(self.check("characters"), "core/rt/a.cpp:4", "newline")

    def test_stale_changelog(self):
        self.put("CMakeLists.txt", "project(InduRoP VERSION 0.2.0)\n")
        self.put("CHANGELOG.md", "# Changelog\n\n## 0.1.0\n")
        self.found(self.check("changelog"), "0.1.0", "0.2.0")


class Classes(Sample):
    def check(self, body, cpps=(), allowed=None):
        self.put("core/rt/a.h", f"{HEAD}class A final : public B<int> {{\n{body}}};\n")
        for i, text in enumerate(cpps):
            self.put(f"core/rt/a{i}.cpp", f'{HEAD}#include "core/rt/a.h"\n\n{text}')
        return check_classes.check(self.root, allowed or {})

    def test_too_many_members(self):
        self.found(self.check("".join(f"  int a{i}_ = {i};\n" for i in range(26))), "core/rt/a.h:4", "A has 26 data members")

    def test_what_is_a_data_member(self):
        forms = """
 public:
  using F = void (*)(int);
  enum class Kind { One, Two };
  static constexpr int kMost = 3;
  friend class D;
  class E;
  struct Inner {
    int a, b;
  };
  bool operator<(const A& other) const noexcept { return a_ < other.a_; }
  A& operator=(const A&) = delete;
  int c(int x = 0, std::function<void(int)> f = {}) { int local{}; return local; }

 private:
  int a_ = 0, b_ = f(1, 2);
  std::map<int, std::pair<int, int>> c_{{1, {2, 3}}};
  std::function<void(int)> d_;
  void (*e_)(int) noexcept = nullptr;
  alignas(64) std::atomic<int> g_{0};
  char h_[3] = {1, 2, 3};
  struct {
    int x;
  } i_;
"""
        self.check(forms)
        line, files, data, functions = check_classes.measure(self.root)["core/rt/a.h", "A"]
        self.assertEqual((line, len(files), data, functions), (4, 0, 8, 2))
        self.assertEqual(check_classes.measure(self.root)["core/rt/a.h", "A::Inner"][2:], [0, 0])

    def test_plain_data_may_be_long(self):
        members = "".join(f"  int a{i} = {i};\n" for i in range(40))
        self.put("core/rt/a.h", f"{HEAD}struct A {{\n{members}}};\n")
        self.assertEqual(check_classes.check(self.root, {}), [])

    def test_too_many_functions(self):
        self.found(self.check("".join(f"  int a{i}() const;\n" for i in range(41))), "41 functions")
        self.found(self.check("".join(f"  A(int x{i}) : a_{{x{i}}}, b_(1) {{}}\n" for i in range(41))), "41 functions")

    def test_too_many_files(self):
        cpps = [f"std::map<int, int> A::f{i}() noexcept {{\n  return A::f(1);\n}}\n" for i in range(4)]
        self.found(self.check("  int a_;\n", cpps), "A has 4 files")

    def test_calls_and_classes_of_the_same_name_elsewhere(self):
        self.put("store/vars/a.h", f"{HEAD}class A {{\n  void f();\n}};\n")
        for i in range(4):
            self.put(f"store/vars/a{i}.cpp", f'{HEAD}#include "store/vars/a.h"\n\nvoid g() {{\n  A::f();\n}}\n')
        cpps = ["void A::f() {}\n", "void A::g() {}\n"]
        self.assertEqual(self.check("  int a_;\n", cpps), [])
        self.assertEqual(len(check_classes.measure(self.root)["core/rt/a.h", "A"][1]), 2)

    def test_the_list_can_only_shrink(self):
        members = "".join(f"  int a{i}_;\n" for i in range(27))
        entry = "core/rt/a.h A"
        self.assertEqual(self.check(members, (), {entry: ({"data members": 27}, "why")}), [])
        self.found(self.check(members, (), {entry: ({"data members": 26}, "why")}), "27 data members, more than 26")
        self.found(self.check(members, (), {entry: ({"data members": 28}, "why")}), "only 27", "write 27")
        self.found(self.check("  int a_;\n", (), {entry: ({"data members": 27}, "why")}), "only 1", "delete it")
        self.found(self.check("", (), {"core/rt/b.h B": ({"files": 4}, "why")}), "there is no core/rt/b.h B")

    def test_the_tree_is_measured(self):
        sizes = check_classes.measure(ROOT)
        self.assertGreater(len(sizes), 1000)
        self.assertGreater(max(len(size[1]) for size in sizes.values()), 1)


class Functions(Sample):
    BODY = "  a();\n" * 60

    def check(self, text):
        self.put("core/rt/a.cpp", HEAD + text)
        return check_functions.check(self.root)

    def test_retired_word(self):
        cases = {"a.tsx": ('const wish = 1;  // `anew`\n/* Nobody reads. */\nconst b = <p>Nobody reads</p>;\n', [1, 2, 3]),
                 "b.html": ("<!-- beside it -->\n", [1]), "c.py": ('"""What nobody reads."""\nlet_go = 1  # "nobody"\n', [1, 2]),
                 "core/rt/a.cpp": (HEAD + 'int a;  // nobody\nint b;  // `nobody`, "anew"\n', [4]), "d.cmake": ("# told\nset(let_go 1)\n", [1, 2]),
                 "docs/a.md": ("nobody\n", [1]), "docs/words.md": ("nobody\n", []), "e.sh": ("told\n", [1]), "f.glb": ("told\n", [1]), "g.st": ("told\n", [1])}
        for name, (text, _) in cases.items():
            self.put(name, text)
        found = [one.split(": ")[0] for one in check_text.words(self.root)]
        self.assertEqual(found, [f"{name}:{line}" for name, (_, lines) in cases.items() for line in lines])

    def test_retired_word_in_a_name_and_in_a_message(self):
        self.put("core/rt/a.cpp", HEAD + 'int let_go();\nint LetGo();\nauto text = "nobody reads";\nint outlet_gone;\n')
        self.put("cmake/a.cpp", HEAD + "int let_go();\n")  # not in a room of the product
        self.assertEqual([one.split(":")[0] for one in check_text.words(self.root)], ["core/rt/a.cpp"] * 3)

    def test_long_function(self):
        self.found(self.check(f"namespace a {{\nint b::c(int d) const {{\n{self.BODY}}}\n}}\n"), "core/rt/a.cpp:5", "b::c has 62 lines")

    def test_long_method_in_a_class(self):
        self.found(self.check(f"class A : public B {{\n  void c() override {{\n{self.BODY}  }}\n}};\n"), "c has 62 lines")

    def test_long_constructor(self):
        self.found(self.check(f"A::A(int a) : a_{{a}}, b_(a) {{\n{self.BODY}}}\n"), "62 lines")

    def test_long_test(self):
        self.found(self.check(f"TEST(A, b) {{\n{self.BODY}}}\n"), "62 lines")

    def test_braces_in_strings_and_comments(self):
        self.assertEqual(self.check("void a() {\n  b('{', \"{\", R\"({)\");  // {\n}\n" * 40), [])

    def test_long_table_and_long_class(self):
        self.assertEqual(self.check(f"const int a[] = {{\n{'  1,' * 70}}};\nstruct B {{\n{'  int a();' * 70}}};\n"), [])

    def test_excuse(self):
        self.assertEqual(self.check(f"// Long: one line for each key.\nvoid a() {{\n{self.BODY}}}\n"), [])


class Expressions(Sample):
    def check(self, text):
        self.put("core/rt/a.cpp", HEAD + text)
        return check_expressions.check(self.root)

    def test_choices_of_values(self):
        self.assertEqual(self.check("int a(bool b, bool c) {\n  const int d = b ? 1 : c ? 2 : 3;\n  e(b ? f() : g(), c ? 1 : 2);\n"
                                    "  d = T{} < b ? 1 : 2;\n  return b ? std::max(1, 2) : (c ? 3 : 4);\n}\n"), [])

    def test_nested_three_deep(self):
        self.found(self.check("int a = b ? 1 : c ? 2 : d ? 3 : 4;\n"), "core/rt/a.cpp:4", "3 deep")
        self.found(self.check("void a() {\n  b(c ? (d ? e ? 1 : 2 : 3) : 4);\n}\n"), "core/rt/a.cpp:5", "3 deep")

    def test_assignment_to_one(self):
        self.found(self.check("void a() {\n  (b ? c : d) += 1;\n}\n"), "core/rt/a.cpp:5", "assigns")

    def test_statement(self):
        self.found(self.check("void a() {\n  if (b) {\n    c ? d() : e();\n  }\n}\n"), "core/rt/a.cpp:6", "as a statement")


class Format(Sample):
    def test_badly_formatted(self):
        shutil.copy(ROOT / ".clang-format", self.root)
        self.put("core/rt/a.cpp", HEAD + "int   a ;\n")
        self.assertTrue(check_format.check(self.root))

    def test_well_formatted(self):
        shutil.copy(ROOT / ".clang-format", self.root)
        self.put("core/rt/a.cpp", HEAD + "int a;\n")
        self.assertEqual(check_format.check(self.root), [])


class Headers(Sample):
    def test_public_header_with_missing_include(self):
        self.put("include/indurop/a.h", HEAD + "#pragma once\nstd::size_t a();\n")
        found = check_headers.check(self.root, [])
        self.assertEqual(len(found), 2, found)  # both compilers

    def test_public_header_that_needs_internals(self):
        self.put("core/rt/b.h", HEAD + "#pragma once\n")
        self.put("include/indurop/a.h", HEAD + '#pragma once\n#include "core/rt/b.h"\n')
        self.assertEqual(len(check_headers.check(self.root, [])), 2)

    def test_header_without_guard(self):
        self.put("core/rt/a.h", HEAD + "struct A {};\n")
        self.found(check_headers.check(self.root, []), "core/rt/a.h", "redefinition")

    def test_a_header_that_passed_is_compiled_again_when_one_it_includes_changes(self):
        self.put("core/rt/b.h", HEAD + "#pragma once\nstruct B {};\n")
        self.put("core/rt/a.h", HEAD + '#pragma once\n#include "core/rt/b.h"\nB a();\n')
        self.assertEqual(check_headers.check(self.root, [], self.root), [])
        passed = [path for path in self.root.iterdir() if len(path.name) == 64]
        self.assertEqual(len(passed), 2)
        self.put("core/rt/b.h", HEAD + "#pragma once\nstruct C {};\n")
        self.found(check_headers.check(self.root, [], self.root), "core/rt/a.h")

    def test_own_header_not_first(self):
        self.put("core/rt/a.h", HEAD + "#pragma once\nstd::size_t a();\n")
        self.put("core/rt/a.cpp", HEAD + '#include <string>\n#include "core/rt/a.h"\n')
        self.found(check_headers.check(self.root, []), "core/rt/a.cpp", "first include")

    def test_good_header(self):
        self.put("include/indurop/a.h", HEAD + "#pragma once\n#include <string>\nstd::string a();\n")
        self.assertEqual(check_headers.check(self.root, []), [])


class Precompiled(Sample):
    def test_not_included(self):
        self.put("core/rt/a.h", HEAD + "#pragma once\n#include <string>\n")
        self.put("core/rt/a.cpp", HEAD + '#include "core/rt/a.h"\nstd::string text;  // std::map<int, int>\nstd::vector<int> list;\n')
        findings = check_precompiled.check(self.root)
        self.found(findings, "core/rt/a.cpp", "<vector>")
        self.assertEqual(len(findings), 1, findings)


class Symbols(Sample):
    def check(self, listed):
        self.put("a.cpp", 'extern "C" void one() {}\nextern "C" void two() {}\n')
        library = str(self.root / "liba.so")
        subprocess.run(["g++", "-shared", "-fPIC", "-o", library, str(self.root / "a.cpp")], check=True)
        self.put("list.txt", listed)
        return check_symbols.check(library, str(self.root / "list.txt"))

    def test_complete_list(self):
        self.assertEqual(self.check("# head\none\ntwo\n"), [])

    def test_unlisted_export(self):
        self.found(self.check("one\n"), "not listed: two")

    def test_lost_export(self):
        self.found(self.check("one\nthree\ntwo\n"), "no longer exported: three")


class Tick(Sample):
    def check(self, listed):
        self.put("a.cpp", 'extern "C" { void given(); void other(); void left_out(); }\n'
                          'extern "C" [[gnu::noinline]] void rare() { left_out(); }\n'
                          'static void middle() { given(); rare(); }\n'
                          'extern "C" void tick() { middle(); }\n'
                          'extern "C" void elsewhere() { other(); }\n')
        library = str(self.root / "liba.a")
        subprocess.run(["g++", "-O2", "-c", "-o", str(self.root / "a.o"), str(self.root / "a.cpp")], check=True)
        subprocess.run(["ar", "rc", library, str(self.root / "a.o")], check=True)
        self.put("list.txt", listed)
        return check_tick.check(str(self.root / "list.txt"), "this", [library])

    def test_complete_list(self):
        self.assertEqual(self.check("# head\nroot tick\nleaf rare\nservice given  a reason\n"), [])

    def test_service_that_is_not_listed(self):
        self.found(self.check("root tick\nservice given\n"), "left_out is not in", "reached by tick")

    def test_service_nobody_uses(self):
        self.found(self.check("root tick\nleaf rare\nservice given\nservice other\n"), "nothing on the tick path uses other")

    def test_service_of_a_system(self):
        self.assertEqual(self.check("root tick\nleaf rare\nservice/this given\nservice/that other\n"), [])
        self.found(self.check("root tick\nleaf rare\nservice/that given\n"), "given is not in")

    def test_root_that_is_gone(self):
        self.found(self.check("root tick\nroot tock\nleaf rare\nservice given\n"), "no function is called tock")


class Readme(Sample):
    def setUp(self):
        super().setUp()
        self.put("Makefile", "all demo: ## build\n")

    def check(self, typed, program=None):
        self.put("README.md", f"# Title\n\n```console\n$ {typed}\nsome output\n```\n")
        return check_readme.check(self.root, program)

    def test_target(self):
        self.assertEqual(self.check("make demo"), [])
        self.found(self.check("make dmeo"), "dmeo")

    def test_unknown_verb(self):
        self.put("indurop", "#!/bin/sh\necho '  check  looks at a file'\n")
        (self.root / "indurop").chmod(0o755)
        program = str(self.root / "indurop")
        self.assertEqual(self.check("indurop check module.xml", program), [])
        self.found(self.check("indurop chekc module.xml", program), "chekc")

    def test_missing_file(self):
        self.found(self.check("examples/none.sh"), "no such file")

    def test_broken_links(self):
        self.put("docs/a.md", "# One `x_y` more?\n[a](#one-x_y-more) [b](b.md#id) [c](b.md#c) [d](d.md) [e](https://e.org/)\n")
        self.put("docs/b.md", '<a id="id"></a>**Id**\n```sh\n# c\n```\n')
        self.assertEqual(check_readme.check(self.root, None),
                         ["docs/a.md: b.md has no heading #c", "docs/a.md: link to missing file d.md"])

    def test_missing_test(self):
        self.put("tests/unit/a_test.cpp", HEAD + "TEST_F(Store, Keeps_what_is_written) {\n}\n")
        self.put("docs/a.md", "`Store.Keeps_what_is_written`, `Store.size`, and `Store.Forgets_what_is_written`\n")
        self.found(check_readme.check(self.root, None), "docs/a.md", "Store.Forgets_what_is_written")

    def test_missing_source_file(self):
        self.put("store/vars/store.h", HEAD)
        self.put("docs/a.md", "`store/vars/store.h`, `store/vars/store`, `store/vars/`, `build/bin/`, `a/b`, and `store/vars/stroe.h`\n")
        self.found(check_readme.check(self.root, None), "docs/a.md", "store/vars/stroe.h")


class Commits(Sample):
    def test_subjects_as_they_should_be(self):
        self.assertEqual(check_commits.check([
            ("a", "robot: wait for drives to switch off before enabling"), ("b", "page, status: show what is missing"),
            ("c", "tools: pass the reason on"), ("d", "store/vars/retain: keep the old file")]), [])

    def test_subjects_that_are_not(self):
        for subject, what in ((f"robot: say {'x' * 72}", "the limit"), ("Drives are late", "not 'room: imperative'"),
                              ("docs: options of new verbs", "'options'"), ("docs: added a page", "'added'"),
                              ("docs: adding a page", "'adding'"), ("serve: HEAD has no body", "'HEAD'"),
                              ("docs: add a page.", "full stop")):
            self.found(check_commits.check([("a1b2", subject)]), "a1b2", what)

    def test_a_clone_that_ends_before(self):
        self.assertIsNone(check_commits.commits_of(self.root))


class Run(Sample):
    LOG = ("1/2 Test #1: Flaky ......***Failed    0.05 sec\nwhy\n    Test #1: Flaky ......   Passed    0.02 sec\n"
           "2/2 Test #2: Good ......   Passed    0.01 sec\n")

    def junit(self, *names):
        cases = "".join(f'<testcase name="{name}"><skipped message="x"/><system-out>needs root\n[  SKIPPED ] {name}\n'
                        "</system-out></testcase>" for name in names)
        self.put("r.xml", f'<testsuite><testcase name="Good"/>{cases}</testsuite>')
        return self.root / "r.xml"

    def test_skipped(self):
        self.found(check_run.check(self.junit("Lab.One"), "", ["Rights.*"]), "Lab.One", "needs root")

    def test_left_in_shared_memory(self):
        for node, pid in (("early", 0), ("ended", 999999999), ("runs", os.getpid())):
            self.put(f"shm/indurop.{node}.lock", f"{pid} 123\n")
        self.assertEqual(check_run.left(["indurop.early.lock"], self.root / "shm"), ["ended"])

    def test_skipped_with_leave(self):
        self.assertEqual(check_run.check(self.junit("Rights.One"), "", ["Rights.*"]), [])

    def test_failed(self):
        self.put("r.xml", '<testsuite><testcase name="Good"/><testcase name="Bad"><failure message="Timeout"/><system-out>'
                 + "\n".join(f"line {i}" for i in range(99)) + "\n</system-out></testcase></testsuite>")
        (name, lines), = check_run.failed(self.root / "r.xml")
        self.assertEqual((name, lines[0], lines[-1], len(lines)), ("Bad", "Timeout", "line 98", check_run.LAST_LINES + 1))

    def test_not_run(self):
        self.assertEqual(check_run.not_run(self.LOG + " 9/9 Test #9: pages ....***Not Run   0.00 sec\n"), ["pages"])

    def test_leave_without_a_reason(self):
        self.put("may.txt", "# head\nA.b  root\nC.d\n")
        self.assertEqual(check_run.allowed(self.root / "may.txt"), ["A.b"])

    def test_retried(self):
        self.assertEqual([(name, check_run.first_failure(self.LOG, name)) for name in check_run.retried(self.LOG)], [("Flaky", ["why"])])
        self.assertEqual(check_run.check(self.junit(), self.LOG, []), [])
        many = "".join(self.LOG.replace("Flaky", f"F{i}") for i in range(3))
        self.found(check_run.check(self.junit(), many, []), "F0", "F2")


if __name__ == "__main__":
    unittest.main()
