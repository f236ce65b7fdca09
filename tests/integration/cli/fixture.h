// SPDX-License-Identifier: Apache-2.0
// Fixture of all tests of the command line: each test has an empty /dev/shm of its own.

#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "sandbox.h"

namespace indurop::test {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!enter_sandbox()) {
      GTEST_SKIP() << "this system does not allow a private /dev/shm (user namespaces)";
    }
  }
  static void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
};

// One fake node named "local", ready.
class WithNode : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (!IsSkipped()) {
      node_ = std::make_unique<Program>(fake_node("local"), background());
      ASSERT_TRUE(node_->prints("ready")) << node_->out();
    }
  }
  void kill_node() {
    node_->signal(SIGKILL);
    ASSERT_EQ(node_->wait(), 128 + SIGKILL);
  }

  std::unique_ptr<Program> node_;
};

}  // namespace indurop::test
