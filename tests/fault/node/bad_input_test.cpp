// SPDX-License-Identifier: Apache-2.0
// Configurations and files that cannot work: every one gets its message with file, line and column, exit code 4, and
// nothing is left in shared memory.

#include <fcntl.h>
#include <unistd.h>

#include <indurop/detail/abi.h>

#include <csignal>
#include <fstream>

#include "node_fixture.h"

namespace indurop::test {
namespace {

class BadInput : public NodeTest {
 protected:
  // Runs the node on a file with this text.
  Outcome run_text(const std::string& text) { return start_file(write("module.xml", text)).finish(); }

  void expect_refused(const Outcome& sut, const std::string& place, const std::string& text) {
    EXPECT_EQ(sut.code, 4);
    EXPECT_CONTAINS(sut.err, text);
    EXPECT_THAT(sut.err, ::testing::ContainsRegex("module\\.xml:" + place + ": error: "));
    EXPECT_THAT(files_left(), ::testing::IsEmpty());
  }
};

TEST_F(BadInput, Missing_module_file) {
  expect_refused(run_to_end({{.file = "countr.so"}}), "4:15", "did you mean 'counter.so'?");
}

TEST_F(BadInput, Module_of_another_abi) {
  expect_refused(run_to_end({{.file = "other_abi.so"}}), "4:15",
                 "is built for InduRoP ABI 4711, this is ABI " + std::to_string(abi::kVersion));
}

TEST_F(BadInput, Module_with_an_undefined_symbol) {
  expect_refused(run_to_end({{.file = "undefined.so"}}), "[0-9]+:[0-9]+", "function_without_body");
}

TEST_F(BadInput, A_node_starts_after_one_that_could_not_load_its_modules) {
  ASSERT_EQ(run_to_end({{.file = "undefined.so"}}).code, 4);
  EXPECT_EQ(run_to_end({{.file = "counter.so"}}, {"--duration", "10ms"}).code, 0);
}

TEST_F(BadInput, Library_without_a_run_function) {
  expect_refused(run_to_end({{.file = "no_run.so"}}), "4:15", "has no run function; write INDUROP_MODULE");
}

TEST_F(BadInput, Truncated_module) {
  std::ifstream from(std::string(MODULE_DIR) + "/counter.so", std::ios::binary);
  std::string bytes(3000, '\0');
  from.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  const std::string cut = write("cut.so", bytes);
  expect_refused(run_to_end({{.file = cut}}), "4:15", "is it a module, and completely built?");
}

TEST_F(BadInput, Text_instead_of_a_module) {
  const std::string text = write("text.so", "INPUT(counter.so)\n");
  expect_refused(run_to_end({{.file = text}}), "4:15", "cannot be used");
}

TEST_F(BadInput, Modules_with_different_layouts_of_a_variable) {
  const auto sut = run_to_end({{.file = "layout_old.so"}, {.file = "layout_new.so", .priority = 2}});
  expect_refused(sut, "[0-9]+:[0-9]+", "variable 'nt_layout::axis' differs between layout_old");
  EXPECT_CONTAINS(sut.err, "layout_new");
  EXPECT_CONTAINS(sut.err, "speed");
}

TEST_F(BadInput, No_configuration_file) {
  const auto sut = start_file((folder() / "absent.xml").string()).finish();
  EXPECT_EQ(sut.code, 4);
  EXPECT_CONTAINS(sut.err, "absent.xml");
  EXPECT_THAT(files_left(), ::testing::IsEmpty());
}

TEST_F(BadInput, Malformed_xml) {
  expect_refused(run_text("<root>\n  <module>\n    <filename>./a.so</module>\n</root>\n"), "3:[0-9]+", "filename");
}

TEST_F(BadInput, Empty_file) {
  const auto sut = run_text("");
  EXPECT_EQ(sut.code, 4);
  EXPECT_CONTAINS(sut.err, "module.xml");
  EXPECT_THAT(files_left(), ::testing::IsEmpty());
}

TEST_F(BadInput, Oversized_file) {
  std::string text = "<root>\n";
  while (text.size() < (std::size_t{20} << 20)) {
    text += "  <!-- and so on and on and on and on and on and on and on and on and on and on and on and on -->\n";
  }
  const auto sut = run_text(text + "</root>\n");
  EXPECT_EQ(sut.code, 4);
  EXPECT_CONTAINS(sut.err, "module.xml");
  EXPECT_THAT(files_left(), ::testing::IsEmpty());
}

TEST_F(BadInput, Endless_file) {
  const auto sut = start_file("/dev/zero").finish();
  EXPECT_EQ(sut.code, 4);
  EXPECT_CONTAINS(sut.err, "/dev/zero");
}

TEST_F(BadInput, Deeply_nested_elements) {
  std::string text;
  for (int i = 0; i < 200000; ++i) {
    text += "<a>";
  }
  EXPECT_EQ(run_text(text).code, 4);
}

TEST_F(BadInput, Period_zero) {
  expect_refused(run_to_end({{.file = "counter.so", .period = "0"}}), "7:13", "period");
}

TEST_F(BadInput, Duplicate_names) {
  const auto sut = run_to_end({{.file = "counter.so", .name = "twin"}, {.file = "label.so", .name = "twin"}});
  expect_refused(sut, "1[0-9]:11", "a second module named 'twin'");
}

TEST_F(BadInput, All_errors_at_once) {
  const auto files = run_to_end({{.file = "absent.so"}, {.file = "counter.so"}, {.file = "no_run.so"}});
  expect_refused(files, "4:15", "absent.so");
  EXPECT_CONTAINS(files.err, "no_run.so");
  const auto values = run_to_end({{.file = "counter.so", .period = "-5"}, {.file = "label.so", .type = "thred"}});
  expect_refused(values, "7:13", "'-5' is negative");
  EXPECT_CONTAINS(values.err, "'thred' is not a value of <moduletype>");
}

TEST_F(BadInput, Unknown_failsafe_variable) {
  expect_refused(run_to_end({{.file = "counter.so", .more = "<failsafe variable=\"nt::countd\">0</failsafe>"}}),
                 "9:[0-9]+", "nt::countd");
}

TEST_F(BadInput, Configuration_without_read_permission) {
  const std::string file = write("module.xml", xml({{.file = "counter.so"}}));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  Environment without_rights = environment();
  without_rights.user = unprivileged_instead_of_root();
  const auto sut = start_file(file, {}, without_rights).finish();
  if (sut.code == 126 || sut.code == 127) {
    GTEST_SKIP() << "the build directory is closed to others";
  }
  EXPECT_EQ(sut.code, 4);
  EXPECT_CONTAINS(sut.err, "module.xml");
  EXPECT_CONTAINS(sut.err, "not allowed to read");
}

TEST_F(BadInput, Process_module_that_is_not_executable) {
  const std::string copy = folder() / "process.exe";
  std::filesystem::copy_file(std::string(MODULE_DIR) + "/process.exe", copy);
  std::filesystem::permissions(copy, std::filesystem::perms::owner_read);
  expect_refused(run_to_end({{.file = copy, .type = "process"}}), "4:15", "chmod +x");
}

TEST_F(BadInput, Module_file_that_was_deleted_after_the_start_of_a_process) {
  const std::string copy = folder() / "process.exe";
  std::filesystem::copy_file(std::string(MODULE_DIR) + "/process.exe", copy);
  Program& sut = start_and_wait({{.file = copy,
                                  .name = "p",
                                  .type = "process",
                                  .more = "<argument>die</argument><argument>5</argument>"
                                          "<restart delay=\"10ms\" max=\"2\"/>"}});
  std::filesystem::remove(copy);
  EXPECT_TRUE(wait_until([&] { return module("p").state.load() == scheduler::ModuleState::Faulted; }));
  EXPECT_TRUE(sut.says("cannot run " + copy));
  EXPECT_TRUE(sut.says("module p"));
}

}  // namespace
}  // namespace indurop::test
