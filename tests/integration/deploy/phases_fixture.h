// SPDX-License-Identifier: Apache-2.0
// Two boards with a committed deployment, and a next one that stops in a chosen phase.

#pragma once

#include <sstream>

#include "core/base/read_file.h"
#include "held_check.h"
#include "killed_fixture.h"

namespace indurop::test {

class Phases : public Killed {
 protected:
  Phases() { ::setenv("IRP_TEST_SLOW_UNTIL", path("go").c_str(), 1); }
  ~Phases() override { ::unsetenv("IRP_TEST_SLOW_UNTIL"); }
  // Lets the module of `deploy_until_healthy` start.
  void let_b_start() const { std::ofstream(path("go")) << "go\n"; }
  // Where a deployment's files lie on a board.
  [[nodiscard]] std::filesystem::path installed(const std::string& name, const std::string& deployment) const {
    return folder() / "state" / board(name) / "deployments" / deployment.substr(0, 16);
  }
  // Deploys `next_` until board a has some pieces of a large file, and stops the deployer there.
  Program& deploy_until_fetching() {
    std::ofstream(folder() / "other.so", std::ios::app) << std::string(24U << 20U, 'x');
    Program& deployer = start_indurop({"deploy", next_, "--health", "500ms"});
    EXPECT_TRUE(wait_until([&] { return fetched() > 100'000; }));
    deployer.signal(SIGSTOP);
    EXPECT_LT(fetched(), 24U << 20U) << "it was faster than this test";
    return deployer;
  }
  [[nodiscard]] std::uintmax_t fetched() const {
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder() / "state" / board("a") / "parts", error), end; at != end;
         at.increment(error)) {
      const std::uintmax_t size = at->file_size(error);
      if (!error && size > 0) {
        return size;
      }
    }
    return 0;
  }
  // Deploys `next_` until b checks, which lasts as long as it is held, and a waits for it.
  Program& deploy_until_checking() {
    Program& deployer = start_indurop({"deploy", next_, "--health", "500ms", "--timeout", "20s"});
    EXPECT_TRUE(wait_until([&] {
      return boards_are(
          [](const Json& a, const Json& b) { return a["phase"] == "prepared" && b["phase"] == "checking"; });
    }));
    return deployer;
  }
  // Deploys a plant until a does well and b, whose module does not start before it is let, does not yet. What differs
  // outside of modules makes both nodes start again: without that, the module would start while b checks.
  Program& deploy_until_healthy() {
    const std::string slow = manifest("slow.xml", {{"a", "other"}, {"b", "slow"}}, "<spin>off</spin>");
    Program& deployer = start_indurop({"deploy", slow, "--health", "300ms"});
    EXPECT_TRUE(wait_until([&] { return has_printed(deployer, board("a"), "healthy"); }));
    EXPECT_FALSE(has_printed(deployer, board("b"), "healthy"));
    return deployer;
  }
  // Deploys `next_` until a has committed it; whether b has is not known.
  Program& deploy_until_committed() {
    Program& deployer = start_indurop({"deploy", next_, "--health", "500ms", "-o", "json"});
    const std::string file = (folder() / "state" / board("a") / "committed.json").string();
    const auto before = base::read_file(file).value();
    EXPECT_TRUE(wait_until([&] { return base::read_file(file).value() != before; }));
    return deployer;
  }
  static bool has_printed(const Program& deployer, const std::string& name, const std::string& phase) {
    std::istringstream lines(deployer.err());
    for (std::string line; std::getline(lines, line);) {
      if (line.find(name) != std::string::npos && line.find(phase) != std::string::npos) {
        return true;
      }
    }
    return false;
  }
  // The one both boards run in the end, if it is neither the old one nor none.
  std::string new_one() {
    std::string id;
    EXPECT_TRUE(wait_until([&] {
      const Json one = report("a");
      id = one.is_object() ? one["deployment"].get<std::string>() : "";
      return !id.empty() && id != committed_ && runs("a", id) && runs("b", id);
    }));
    return id;
  }
  // When board b opens a file of a deployment, which it does in its check.
  HeldCheck b_check_{"/" + board("b") + "/deployments/", path("hold")};
};

}  // namespace indurop::test
