// SPDX-License-Identifier: Apache-2.0
// The turning table of examples/two_boards under board names and a DDS domain of this test's own.

#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "mirror/frames/mirror_block.h"
#include "program.h"
#include "scheduler/run_block.h"
#include "tests/support/dds_domain.h"
#include "vars/run_file.h"
#include "vars/shm_file.h"
#include "vars/store.h"

namespace indurop::test {

class PlantTest : public ::testing::Test {
 protected:
  PlantTest() : folder_(std::filesystem::temp_directory_path() / ("indurop-plant-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~PlantTest() override {
    for (const auto& program : programs_) {
      program->signal(SIGTERM);
    }
    for (const auto& program : programs_) {
      (void)program->wait();
    }
    for (const char* board : {"sensor", "control", "backup"}) {
      EXPECT_TRUE(wait_until([&] { return vars::remove_node(node(board)).ok(); })) << board << " does not end";
    }
    std::filesystem::remove_all(folder_);
  }

  static std::string node(const std::string& board) { return "pt" + std::to_string(::getpid()) + "-" + board; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  static std::string board(const std::string& name, const std::string& module, const std::string& more = "") {
    const std::string text = module.empty() ? ""
                                            : "<module><filename>" TWO_BOARDS "/" + module +
                                                  ".so</filename><moduletype>thread</moduletype><operationtype>periodic"
                                                  "</operationtype><period>1ms</period><priority>1</priority>" +
                                                  more + "</module>";
    return "<board name=\"" + node(name) + "\">" + text + "</board>";
  }
  std::string write(const std::string& boards) {
    const std::string file = folder_ / "plant.xml";
    std::ofstream(file) << "<plant name=\"pt\"><domain>" << dds_domain()
                        << "</domain><external>off</external><lease>200ms</lease>" << boards << "</plant>";
    return file;
  }
  std::string two_boards() { return write(board("sensor", "table") + board("control", "controller")); }

  Program& start(std::vector<std::string> command) {
    Environment environment;
    environment.variables = {"INDUROP_STATE_DIR=" + (folder_ / "state").string()};
    programs_.push_back(std::make_unique<Program>(command, environment));
    return *programs_.back();
  }
  Program& indurop(std::vector<std::string> words) {
    words.insert(words.begin(), INDUROP_PROGRAM);
    return start(std::move(words));
  }

  // A number of a variable as one board has it; 0 while the board does not run.
  template <class Number = std::uint64_t>
  static Number number(const std::string& board, const std::string& variable, std::uint32_t offset = 0) {
    const auto store = vars::Store::attach(node(board), vars::Mode::ReadOnly);
    const auto* entry = store ? store.value().find(abi::fnv1a64(variable.data(), variable.size())) : nullptr;
    std::uint8_t bytes[8] = {};
    if (entry == nullptr || !store.value().read(*entry, offset, bytes)) {
      return 0;
    }
    Number result = 0;
    std::memcpy(&result, bytes, sizeof result);
    return result;
  }
  double speed(const std::string& board) { return number<double>(board, "cell::encoder", 8); }
  double torque(const std::string& board) { return number<double>(board, "cell::torque"); }
  // The controller keeps the table at 2 rad/s, for which it needs 0.04 Nm.
  bool controlled() {
    return std::abs(speed("sensor") - 2) < 0.01 && std::abs(speed("control") - 2) < 0.01 && torque("sensor") > 0.03;
  }

  [[nodiscard]] static pid_t pid_of(const std::string& board) {
    const auto file =
        vars::RunFile::open(node(board), vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
    return file ? static_cast<const scheduler::RunBlock*>(file.value().data())->node_pid.load() : 0;
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::unique_ptr<Program>> programs_;
};

}  // namespace indurop::test
