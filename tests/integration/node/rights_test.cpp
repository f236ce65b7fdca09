// SPDX-License-Identifier: Apache-2.0
// Without rights, without space, with files of another user: a node works as far as it can, and reports what is
// missing.

#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "node_fixture.h"

namespace indurop::test {
namespace {

class Rights : public NodeTest {
 protected:
  // The node as a user without real-time privileges. Empty: skip, for the reason in `why`.
  std::optional<Environment> without_rights(std::string& why) {
    Environment result = environment();
    if (::geteuid() != 0) {
      return result;
    }
    result.user = kUnprivileged;
    Program probe({"/usr/bin/test", "-x", NODE_PROGRAM, "-a", "-r", std::string(MODULE_DIR) + "/counter.so", "-a", "-w",
                   folder()},
                  result);
    if (probe.wait() != 0) {
      why = "an ordinary user may not read the build directory";
      return {};
    }
    return result;
  }
};

std::vector<Module> three() {
  return {{.file = "counter.so", .name = "a", .priority = 1},
          {.file = "process.exe", .name = "b", .type = "process", .period = "2ms", .priority = 2},
          {.file = "label.so", .name = "c", .period = "2ms", .priority = 3}};
}

TEST_F(Rights, An_ordinary_user_gets_the_order_and_a_message_about_what_is_missing) {
  std::string why;
  const auto unprivileged = without_rights(why);
  if (!unprivileged) {
    GTEST_SKIP() << why;
  }
  Program& sut = start_file(write("module.xml", xml(three())), {"--report", folder() / "r.json"}, *unprivileged);
  ASSERT_TRUE(wait_until_running(sut));
  for (const char* name : {"a", "b", "c"}) {
    ASSERT_TRUE(runs_reach(name, 100)) << name;
  }
  sut.signal(SIGTERM);
  ASSERT_EQ(sut.wait(), 0);
  const auto report = nlohmann::json::parse(std::ifstream(folder() / "r.json"));
  if (report["rt"]["fifo"] == true) {
    GTEST_SKIP() << "this user has real-time privileges";
  }
  EXPECT_CONTAINS(sut.err(), "NOT REAL TIME: SCHED_FIFO refused");
  EXPECT_EQ(order_violations(*run()), 0);
}

TEST_F(Rights, Required_and_not_obtained_is_exit_code_7) {
  std::string why;
  const auto unprivileged = without_rights(why);
  if (!unprivileged) {
    GTEST_SKIP() << why;
  }
  Program& sut = start_file(write("module.xml", xml(three())), {"--require-rt", "--duration", "10ms"}, *unprivileged);
  const int code = sut.wait();
  if (code == 0) {
    GTEST_SKIP() << "this user has real-time privileges";
  }
  EXPECT_EQ(code, 7);
  EXPECT_CONTAINS(sut.err(), "real-time privileges not obtained (--require-rt)");
}

TEST_F(Rights, Name_of_another_users_node_is_refused) {
  std::string why;
  const auto unprivileged = without_rights(why);
  if (::geteuid() != 0 || !unprivileged) {
    GTEST_SKIP() << "needs two users";
  }
  const std::string file = write("module.xml", xml({{.file = "counter.so", .name = "counter"}}));
  ASSERT_EQ(start_file(file, {"--duration", "10ms"}).finish().code, 0);
  const auto sut = start_file(file, {"--duration", "10ms"}, *unprivileged).finish();
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, "choose another name with --node");
}

TEST_F(Rights, Full_shared_memory_is_named_and_nothing_is_left) {
  Environment small = environment();
  small.prepare = [] { return mount_small("/dev/shm", "64k"); };
  const std::string file = write("module.xml", xml({{.file = "counter.so", .name = "counter"}}));
  Program sut({"/bin/sh", "-c", "\"$0\" \"$1\"; code=$?; ls -A /dev/shm; exit $code", NODE_PROGRAM, file}, small);
  const int code = sut.wait();
  if (code == Program::kNotPrepared) {
    GTEST_SKIP() << "this system does not permit a private /dev/shm";
  }
  EXPECT_EQ(code, 1);
  EXPECT_CONTAINS(sut.err(), "/dev/shm");
  EXPECT_CONTAINS(sut.err(), "indurop clean");
  EXPECT_EQ(sut.out(), "") << "left in /dev/shm";
}

TEST_F(Rights, Full_disk_for_the_report_is_an_error_after_the_run) {
  const auto disk = folder() / "disk";
  std::filesystem::create_directory(disk);
  Environment small = environment();
  small.prepare = [disk] {
    if (!mount_small(disk, "4k")) {
      return false;
    }
    std::ofstream(disk / "full") << std::string(4096, 'x');
    return true;
  };
  const std::string file = write("module.xml", xml({{.file = "counter.so", .name = "counter"}}));
  Program& sut = start_file(file, {"--duration", "20ms", "--report", disk / "r.json"}, small);
  const int code = sut.wait();
  if (code == Program::kNotPrepared) {
    GTEST_SKIP() << "this system does not permit a private disk";
  }
  EXPECT_EQ(code, 1);
  EXPECT_CONTAINS(sut.err(), "cannot write the report");
  EXPECT_CONTAINS(sut.err(), "No space left on device");
}

TEST_F(Rights, Folder_of_the_report_must_exist) {
  const auto sut =
      run_to_end({{.file = "counter.so"}}, {"--duration", "20ms", "--report", folder() / "absent" / "r.json"});
  EXPECT_EQ(sut.code, 1);
  EXPECT_CONTAINS(sut.err, "cannot write the report");
  EXPECT_CONTAINS(sut.err, "No such file or directory");
}

TEST_F(Rights, State_directory_that_cannot_be_written_does_not_stop_the_node_and_its_exit_code_says_so) {
  Environment environment = this->environment();
  environment.variables.emplace_back("INDUROP_STATE_DIR=/proc/nowhere");
  const std::string file = write("module.xml", xml({{.file = "counter.so", .name = "counter"}}));
  Program& sut = start_file(file, {"--duration", "20ms"}, environment);
  EXPECT_EQ(sut.wait(), 1);
  EXPECT_GT(run()->tick.load(), 0U);
  EXPECT_CONTAINS(sut.err(), "retained variables could not be saved");
}

}  // namespace
}  // namespace indurop::test
