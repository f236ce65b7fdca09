// SPDX-License-Identifier: Apache-2.0
// A plant of the test's own: a folder with a state directory, names of boards that are unique on this machine, a
// DDS domain, programs. All of it is gone when the test ends, and so is what the programs have started.

#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "store/vars/node_lock.h"
#include "store/vars/store.h"
#include "tests/support/dds_domain.h"
#include "tests/support/orphans.h"
#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace indurop::test {

class PlantTest : public ::testing::Test {
 protected:
  PlantTest() : folder_(std::filesystem::temp_directory_path() / ("indurop-plant-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "state");
    inherit_orphans();
  }
  ~PlantTest() override {
    for (const Program& program : programs_) {
      program.signal(SIGTERM);
    }
    for (Program& program : programs_) {
      (void)program.wait();
    }
    programs_.clear();
    // Nodes whose agent was killed, even before they had a store.
    EXPECT_TRUE(end_children());
    for (const std::string& node : vars::list_nodes()) {
      if (node.starts_with(board(""))) {
        EXPECT_TRUE(vars::remove_node(node).ok()) << node << " still runs";
      }
    }
    std::filesystem::remove_all(folder_);
  }

  // The name of a board and of its node. /dev/shm is everybody's, so it holds the test's pid.
  static std::string board(const std::string& name) { return "pt" + std::to_string(::getpid()) + "-" + name; }
  static int domain() { return dds_domain(); }
  static void kill_node(const std::string& node) {
    if (const pid_t pid = vars::running_node(node); pid > 0) {
      ::kill(pid, SIGKILL);
    }
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  Program& start(const std::vector<std::string>& command, Environment environment = {}) {
    environment.variables.insert(environment.variables.begin(), "INDUROP_STATE_DIR=" + path("state"));
    return programs_.emplace_back(command, environment);
  }

 private:
  std::filesystem::path folder_;
  std::list<Program> programs_;
};

}  // namespace indurop::test
