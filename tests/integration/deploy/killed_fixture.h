// SPDX-License-Identifier: Apache-2.0
// Two boards with a committed deployment and a next one, for tests that kill a process on the way from one to the
// other.

#pragma once

#include <sys/stat.h>

#include <functional>

#include "agents_fixture.h"

namespace indurop::test {

class Killed : public AgentsTest {
 protected:
  void SetUp() override {
    // A process module that is a script: a check has to open it, see phases_test.cpp.
    std::ofstream(folder() / "nap.sh") << "#!/bin/sh\nexec sleep 1000\n";
    ::chmod(path("nap.sh").c_str(), 0755);
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(plant("v1.xml", "steady"));
    ASSERT_EQ(done.code, 0) << done.err;
    committed_ = done.json()["deployment"];
    next_ = plant("v2.xml", "other");
  }
  [[nodiscard]] std::string plant(const std::string& file, const std::string& module_of_a) const {
    return manifest(file, {{"a", module_of_a}, {"b", "steady"}},
                    "<module><filename>./nap.sh</filename><moduletype>process</moduletype>"
                    "<operationtype>non-real</operationtype></module>");
  }
  // Both boards, in one look.
  bool boards_are(const std::function<bool(const Json& a, const Json& b)>& so) {
    const Json all = indurop({"boards", "--wait", "300ms", "-o", "json"}).json();
    Json a;
    Json b;
    if (all.is_object()) {
      for (const Json& one : all["boards"]) {
        Json& known = one["board"] == board("a") ? a : b;
        known = one;
      }
    }
    return a.is_object() && b.is_object() && so(a, b);
  }
  bool in_phase(const std::string& name, const std::string& phase) {
    return boards_are(
        [&](const Json& a, const Json& b) { return (a["board"] == board(name) ? a : b)["phase"] == phase; });
  }
  // As if its power was lost.
  void lose(const std::string& name) {
    stop_agent(name, SIGKILL);
    kill_node(board(name));
  }
  bool both_run(const std::string& deployment) {
    const auto runs_it = [&](const Json& one) {
      return one["state"] == "running" && one["deployment"] == deployment && one["phase"] == "steady";
    };
    return wait_until(
        [&] { return boards_are([&](const Json& a, const Json& b) { return runs_it(a) && runs_it(b); }); });
  }
  bool both_run_the_committed() { return both_run(committed_); }
  std::string committed_;
  std::string next_;
};

}  // namespace indurop::test
