// SPDX-License-Identifier: Apache-2.0
// Two boards with a plant, and releases of the platform for them: the programs of this build under other versions.

#pragma once

#include <fstream>
#include <functional>

#include "agents_fixture.h"

namespace indurop::test {

class PlatformTest : public AgentsTest {
 protected:
  void SetUp() override {
    file_ = manifest("v1.xml", {{"a", "steady"}, {"b", "steady"}});
    start_agent("a");
    start_agent("b");
    const Outcome done = deploy(file_);
    ASSERT_EQ(done.code, 0) << done.err;
    deployment_ = done.json()["deployment"];
  }

  // A copy of the programs, to be changed.
  [[nodiscard]] std::string installation(const std::string& name) const {
    std::filesystem::copy(RELEASE_FOLDER, folder() / name, std::filesystem::copy_options::recursive);
    return path(name);
  }
  // Packs a release and returns the file.
  std::string packed(const std::string& version, const std::string& prefix = RELEASE_FOLDER,
                     const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{
        "platform", "pack", prefix, "--release-version", version, "-o", path(version + ".release")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome done = indurop_here(words);
    EXPECT_EQ(done.code, 0) << done.err;
    return path(version + ".release");
  }
  Program& start_update(const std::string& file, const std::vector<std::string>& more = {},
                        const std::vector<std::string>& before = {}) {
    std::vector<std::string> words{"platform", "deploy", file, "--health", "500ms", "--timeout", "10s", "-o", "json"};
    words.insert(words.end(), more.begin(), more.end());
    return start_indurop(words, before);
  }
  Outcome update(const std::string& file, const std::vector<std::string>& more = {},
                 const std::vector<std::string>& before = {}) {
    return start_update(file, more, before).finish();
  }
  // What the boards say of their platform, by board; without those that are not heard.
  std::map<std::string, Json> platform(const std::vector<std::string>& before = {}) {
    std::map<std::string, Json> all;
    const Json said = indurop({"platform", "status", "--wait", "1s", "-o", "json"}, before).json();
    if (said.is_object()) {
      for (const Json& one : said["boards"]) {
        all[one["board"]] = one;
      }
    }
    return all;
  }
  bool boards_are(const std::function<bool(const Json& a, const Json& b)>& so,
                  const std::vector<std::string>& before = {}) {
    auto all = platform(before);
    return all.contains(board("a")) && all.contains(board("b")) && so(all[board("a")], all[board("b")]);
  }
  // A board that is not heard for a moment is in no phase.
  bool in_phase(const std::string& name, const std::string& phase, const std::vector<std::string>& before = {}) {
    return wait_until([&] {
      const Json one = platform(before)[board(name)];
      return one.is_object() && one.value("phase", "") == phase;
    });
  }
  // A board that has begun to go back says so while its node still runs the release that it leaves.
  static bool runs_release(const Json& one, const std::string& version) {
    const bool leaves = one.value("message", "").starts_with("going back from release " + version + " ");
    return one["release"] == version && one["state"] == "running" && one["phase"] == "steady" && !leaves;
  }
  // Returns true once both boards run this release, and their plant with it.
  bool both_run(const std::string& version, const std::vector<std::string>& before = {}) {
    return wait_until(
        [&] {
          return boards_are(
              [&](const Json& a, const Json& b) { return runs_release(a, version) && runs_release(b, version); },
              before);
        },
        kLong);
  }
  // Returns the release that both boards run in the end, of which they may not agree yet.
  std::string common_release() {
    std::string common;
    EXPECT_TRUE(wait_until(
        [&] {
          return boards_are([&](const Json& a, const Json& b) {
            common = a["release"];
            return runs_release(a, common) && runs_release(b, common);
          });
        },
        kLong))
        << agent("a").err() << agent("b").err();
    return common;
  }
  // The agent is killed and started again, as a service manager does; its node lives on unless its power was lost.
  void restart(const std::string& name, bool power_lost = false) {
    stop_agent(name, SIGKILL);
    if (power_lost) {
      kill_node(board(name));
    }
    start_agent(name);
  }
  // Program of the board's node.
  static std::string node_program(const std::string& name) {
    std::error_code error;
    const auto link = "/proc/" + std::to_string(vars::running_node(board(name))) + "/exe";
    return std::filesystem::read_symlink(link, error).string();
  }
  [[nodiscard]] std::filesystem::path platform_folder(const std::string& name) const {
    return folder() / "state" / board(name) / "platform";
  }

  static constexpr std::chrono::seconds kLong{80};
  static constexpr const char* kInstalled = INDUROP_VERSION;
  std::string file_;
  std::string deployment_;
};

}  // namespace indurop::test
