// SPDX-License-Identifier: Apache-2.0
// stop, reset, clean, run, new.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "fixture.h"

namespace indurop::test {
namespace {

namespace fs = std::filesystem;

TEST_F(WithNode, Stop_ends_the_node_and_waits_for_it) {
  const auto sut = indurop({"stop"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_THAT(sut.err, HasSubstr("stopped after"));
  EXPECT_EQ(node_->wait(), 0);
  const auto again = indurop({"stop"});
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(again.err, HasSubstr("does not run"));
}

TEST_F(CommandLine, Stop_gives_up_on_a_node_that_does_not_listen) {
  Program node(fake_node("deaf", {"ignore-term"}), background());
  ASSERT_TRUE(node.prints("ready"));
  const auto sut = indurop({"stop", "--node", "deaf", "--timeout", "100ms"});
  EXPECT_EQ(sut.code, 6);
  EXPECT_THAT(sut.err, HasSubstr("kill -9 " + std::to_string(node.pid())));
}

TEST_F(WithNode, Reset_asks_for_a_confirmation_and_refuses_without_a_terminal) {
  EXPECT_EQ(indurop({"set", "gain=3", "starts=9"}).code, 0);
  const auto sut = indurop({"reset", "--cold"});
  EXPECT_EQ(sut.code, 2);
  EXPECT_THAT(sut.err, HasSubstr("--yes"));
  EXPECT_EQ(indurop({"get", "starts"}).out, "9\n");
  EXPECT_EQ(indurop({"reset", "--cold", "--warm", "--yes"}).code, 2);
}

TEST_F(WithNode, Warm_reset_keeps_retained_values_and_cold_does_not) {
  EXPECT_EQ(indurop({"set", "gain=3", "starts=9"}).code, 0);
  EXPECT_EQ(indurop({"reset", "--warm", "--yes"}).code, 0);
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
  EXPECT_EQ(indurop({"get", "starts"}).out, "9\n");
  EXPECT_EQ(indurop({"reset", "--cold", "--yes"}).code, 0);
  EXPECT_EQ(indurop({"get", "starts"}).out, "5\n");
}

TEST_F(WithNode, Cold_reset_removes_the_retain_files) {
  kill_node();
  const fs::path folder = scratch() / "state" / "local";
  fs::create_directories(folder);
  put((folder / "retain.a").string(), "old");
  put((folder / "retain.b").string(), "older");
  EXPECT_EQ(indurop({"reset", "--warm", "--yes"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "retain.a"));
  EXPECT_EQ(indurop({"reset", "--cold", "--yes"}).code, 0);
  EXPECT_FALSE(fs::exists(folder / "retain.a"));
  EXPECT_FALSE(fs::exists(folder / "retain.b"));
}

TEST_F(WithNode, Cold_reset_works_on_retain_files_alone) {
  kill_node();
  ASSERT_EQ(indurop({"clean"}).code, 0);
  const fs::path folder = scratch() / "state" / "local";
  fs::create_directories(folder);
  put((folder / "retain.a").string(), "old");
  EXPECT_EQ(indurop({"reset", "--cold", "--yes", "--node", "local"}).code, 0);
  EXPECT_FALSE(fs::exists(folder / "retain.a"));
}

TEST_F(WithNode, Clean_never_touches_a_running_node) {
  const auto named = indurop({"clean", "--node", "local"});
  EXPECT_EQ(named.code, 1);
  EXPECT_THAT(named.err, HasSubstr("stop it first"));
  Program other(fake_node("other"), background());
  ASSERT_TRUE(other.prints("ready"));
  other.signal(SIGKILL);
  ASSERT_EQ(other.wait(), 128 + SIGKILL);
  const auto all = indurop({"clean", "--all"});
  EXPECT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("'other'"));
  EXPECT_EQ(indurop({"nodes", "--names"}).out, "local\n");
  EXPECT_EQ(indurop({"get", "gain"}).out, "1\n");
}

TEST_F(CommandLine, Clean_with_nothing_to_remove_is_content) {
  const auto sut = indurop({"clean"});
  EXPECT_EQ(sut.code, 0);
  EXPECT_THAT(sut.err, HasSubstr("nothing to remove"));
}

TEST_F(CommandLine, Run_detached_returns_when_the_node_runs) {
  const std::string config = std::string(PLC_EXAMPLE) + "/module.xml";
  const auto sut = indurop({"run", config, "--detach", "--duration", "60s"});
  EXPECT_EQ(sut.code, 0) << sut.err;
  EXPECT_THAT(sut.err, HasSubstr("node 'local' runs"));
  EXPECT_THAT(indurop({"status"}).out, StartsWith("local  running"));
  const fs::path log = scratch() / "state" / "local" / "node.log";
  const auto size = fs::file_size(log);
  const auto again = indurop({"run", config, "--detach"});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("indurop stop --node local"));
  EXPECT_GE(fs::file_size(log), size) << "the running node's messages are kept";
  EXPECT_EQ(indurop({"stop"}).code, 0);
}

TEST_F(CommandLine, Run_detached_tells_why_the_node_does_not_run) {
  const std::string config = (scratch() / "broken.xml").string();
  put(config, "<root>");
  const auto sut = indurop({"run", config, "--detach"});
  EXPECT_EQ(sut.code, 4);
  EXPECT_THAT(sut.err, HasSubstr("broken.xml:1:"));
  EXPECT_EQ(indurop({"run", TWO_BOARDS "/plant.xml", "--local", "--detach"}).code, 2);
}

TEST_F(CommandLine, Run_hands_arguments_and_exit_code_through) {
  const fs::path folder = scratch() / "bin";
  fs::create_directories(folder);
  const std::string program = (folder / "indurop-node").string();
  put(program, "#!/bin/sh\necho \"$@\"\nexit 4\n");
  fs::permissions(program, fs::perms::owner_all);
  const fs::path copy = folder / "indurop";
  fs::copy_file(INDUROP_PROGRAM, copy, fs::copy_options::overwrite_existing);
  const std::string config = (scratch() / "a b.xml").string();
  put(config, "<root/>");
  Program sut({copy.string(), "run", config, "--duration", "5s", "-q"}, background());
  EXPECT_TRUE(sut.prints("--duration 5000000000ns --quiet -- " + config + "\n")) << sut.out();
  EXPECT_EQ(sut.wait(), 4);
}

TEST_F(CommandLine, New_makes_a_project_and_never_overwrites) {
  const std::string folder = (scratch() / "cell7").string();
  const auto sut = indurop({"new", folder});
  EXPECT_EQ(sut.code, 0) << sut.err;
  for (const char* file :
       {"CMakeLists.txt", "Makefile", "cell7.glb", "module.xml", "README.md", "src/wave.cpp", "src/monitor.cpp"}) {
    EXPECT_TRUE(fs::exists(fs::path(folder) / file)) << file;
  }
  EXPECT_EQ(indurop({"check", folder + "/module.xml"}).code, 4);  // the modules are not built yet
  EXPECT_EQ(indurop({"plan", folder + "/module.xml"}).code, 0);
  const auto again = indurop({"new", folder});
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(again.err, HasSubstr("nothing was written"));
}

TEST_F(CommandLine, Test_builds_runs_and_tells_what_failed) {
  const fs::path folder = scratch() / "tested";
  EXPECT_EQ(indurop({"test", scratch().string()}).code, 2) << "no project";
  fs::create_directories(folder);
  const auto project = [&](const std::string& tests) {
    std::ofstream(folder / "CMakeLists.txt")
        << "cmake_minimum_required(VERSION 3.25)\nproject(tested LANGUAGES NONE)\nenable_testing()\n" + tests;
    return indurop({"test", folder.string()});
  };
  const auto nothing = project("");
  EXPECT_EQ(nothing.code, 4) << nothing.out << nothing.err;
  const auto good = project("add_test(NAME good COMMAND ${CMAKE_COMMAND} -E true)\n");
  EXPECT_EQ(good.code, 0) << good.out << good.err;
  EXPECT_THAT(good.err, HasSubstr("all tests passed"));
  const auto bad = project(
      "add_test(NAME good COMMAND ${CMAKE_COMMAND} -E true)\nadd_test(NAME bad COMMAND ${CMAKE_COMMAND} -E false)\n");
  EXPECT_EQ(bad.code, 4) << bad.out << bad.err;
  std::ifstream junit(folder / "build/tests.xml");
  const std::string text(std::istreambuf_iterator<char>(junit), {});
  EXPECT_THAT(text, HasSubstr("<failure"));
  EXPECT_THAT(text, HasSubstr("name=\"bad\""));
  const auto chosen = indurop({"test", folder.string(), "--select", "good", "--junit", (scratch() / "j.xml").string()});
  EXPECT_EQ(chosen.code, 0) << chosen.err;
  EXPECT_TRUE(fs::exists(scratch() / "j.xml"));
  EXPECT_EQ(indurop({"test", folder.string(), "--lcov", (scratch() / "c.info").string()}).code, 1) << "nothing counts";
  EXPECT_EQ(project("error here\n").code, 1);
}

TEST_F(CommandLine, New_calls_the_namespace_like_the_project_if_it_can) {
  for (const auto& [name, space] : {std::pair("five", "five"), std::pair("cell-7", "cell_7"),
                                    std::pair("class", "class_project"), std::pair("wave", "wave_project")}) {
    ASSERT_EQ(indurop({"new", (scratch() / name).string()}).code, 0) << name;
    std::ifstream glb(scratch() / name / (std::string(space) + ".glb"));
    const std::string text(std::istreambuf_iterator<char>(glb), {});
    EXPECT_THAT(text, HasSubstr("\nnamespace " + std::string(space) + ";\n"));
  }
}

TEST_F(CommandLine, New_refuses_names_that_make_trouble) {
  for (const char* name : {"", "7up", "a b", "x;y", "-x", "sp\xc3\xa4t", "."}) {
    EXPECT_EQ(indurop({"new", name}).code, 2) << name;
  }
}

}  // namespace
}  // namespace indurop::test
