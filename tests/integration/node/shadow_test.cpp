// SPDX-License-Identifier: Apache-2.0
// indurop reload --shadow: a new version repeats the runs of the running one, and what it writes is compared. What is
// expected is computed by hand from the constants that differ.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "node_fixture.h"
#include "store/vars/node_lock.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

class Shadow : public NodeTest {
 protected:
  static std::string built(const std::string& file) { return std::filesystem::path(MODULE_DIR) / (file + ".so"); }
  const Module kOther{.file = "counter.so", .name = "other", .priority = 1};
  Program& start_counting(const std::string& file = "reload_same") {
    Program& program = start_and_wait({kOther, {.file = file + ".so", .name = "counter", .priority = 2}});
    EXPECT_TRUE(runs_reach("counter", 50));
    return program;
  }
  Outcome shadow(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"reload",   "counter", file,       "--node", node(),
                                    "--shadow", "1500ms",  "--health", "0s"};
    all.insert(all.end(), more.begin(), more.end());
    return indurop(all);
  }
  static bool has_file(const std::filesystem::path& folder, const std::string& name) {
    const std::filesystem::recursive_directory_iterator all(folder);
    return std::any_of(begin(all), end(all), [&name](const auto& one) { return one.path().filename() == name; });
  }
  // The variable of a report, and the report.
  static nlohmann::json variable(const nlohmann::json& report, const std::string& name) {
    for (const auto& one : report["variables"]) {
      if (one["name"] == name) {
        return one;
      }
    }
    ADD_FAILURE() << "no " << name << " in " << report.dump();
    return {};
  }
  void expect_untouched() {
    EXPECT_EQ(module("counter").version.load(), 1U);
    EXPECT_EQ(module("counter").faults.load(), 0U);
    EXPECT_EQ(module("counter").state.load(), ModuleState::Running);
    EXPECT_EQ(indurop({"nodes", "-o", "json"}).out.find(node() + "-shadow"), std::string::npos)
        << "its node is removed";
  }
};

TEST_F(Shadow, A_module_does_not_differ_from_itself) {
  start_counting();
  const Outcome done = shadow(built("reload_same"));
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "2 variables: equal");
  EXPECT_CONTAINS(done.out, "a run takes ");
  EXPECT_CONTAINS(done.err, "this version runs already");
  expect_untouched();
}

TEST_F(Shadow, A_version_that_writes_the_same_is_exchanged) {
  start_counting();
  const std::string copy = folder() / "copy.so";
  std::filesystem::copy_file(built("reload_same"), copy);
  std::ofstream(copy, std::ios::app) << "another version";
  const Outcome done = shadow(copy);
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "2 variables: equal");
  EXPECT_CONTAINS(done.err, "exchanged, with what it keeps");
  EXPECT_EQ(module("counter").version.load(), 2U);
}

// walked is the number of runs, times 1 or -1.
TEST_F(Shadow, Another_factor_gives_twice_the_number_of_runs) {
  start_counting();
  const Outcome refused = shadow(built("reload_other"), {"-o", "json"});
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_CONTAINS(refused.err, "not exchanged: nt::walked differs in ");
  const auto report = refused.json()["shadow"];
  const std::uint64_t runs = report["runs"];
  EXPECT_GT(runs, 500U);
  const auto walked = variable(report, "nt::walked");
  EXPECT_EQ(walked["compared"], runs);
  EXPECT_EQ(walked["differing"], runs);
  EXPECT_EQ(walked["first_tick"], report["first_tick"]);
  const std::int64_t first = std::stoll(walked["first_was"].get<std::string>());
  EXPECT_EQ(std::stoll(walked["first_is"].get<std::string>()), -first);
  EXPECT_EQ(walked["largest"], 2 * (first + static_cast<std::int64_t>(runs) - 1));
  EXPECT_EQ(variable(report, "nt::output")["differing"], 0);
  expect_untouched();
}

TEST_F(Shadow, Differences_are_accepted_up_to_their_limit) {
  start_counting();
  EXPECT_EQ(shadow(built("reload_other"), {"--accept", "walked < 10"}).code, 4);
  EXPECT_EQ(module("counter").version.load(), 1U);
  const Outcome done = shadow(built("reload_other"), {"--accept", "output == 0, walked <= inf"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(module("counter").version.load(), 2U);
  EXPECT_CONTAINS(shadow(built("reload_same"), {"--accept", "nowhere < 1"}).err, "is for no variable that it writes");
  EXPECT_EQ(shadow(built("reload_same"), {"--accept", "walked > 1"}).code, 2);
}

// It goes on with its own sum, so that each run adds the difference of the constants.
TEST_F(Shadow, What_it_wrote_itself_is_its_own_and_what_others_write_is_not) {
  start_and_wait({kOther, {.file = "adder.so", .name = "counter", .priority = 2}});
  ASSERT_TRUE(runs_reach("counter", 50));
  const auto report = shadow(built("adder_more"), {"-o", "json"}).json()["shadow"];
  const double runs = report["runs"];
  EXPECT_GT(runs, 500);
  EXPECT_EQ(variable(report, "nt::sum")["differing"], runs);
  EXPECT_EQ(variable(report, "nt::sum")["largest"], 0.5 * runs);
  EXPECT_EQ(variable(report, "nt::answers")["differing"], 0);
  expect_untouched();
}

// A value that another writer sets is an input: from then on both begin with it.
TEST_F(Shadow, A_value_that_is_set_meanwhile_counts_for_both) {
  start_and_wait({kOther, {.file = "adder.so", .name = "counter", .priority = 2}});
  ASSERT_TRUE(runs_reach("counter", 50));
  const std::filesystem::path recordings = folder() / "recordings";
  std::filesystem::create_directory(recordings);
  Environment where = environment();
  where.variables.push_back("TMPDIR=" + recordings.string());
  Program sut(
      {INDUROP_PROGRAM, "reload", "counter", built("adder_more"), "--node", node(), "--shadow", "3s", "-o", "json"},
      where);
  ASSERT_TRUE(wait_until([&] { return has_file(recordings, "runs.mcap"); }));
  const std::uint64_t before = module("counter").runs.load();
  ASSERT_TRUE(runs_reach("counter", before + 500));
  ASSERT_EQ(indurop({"set", "sum", "1e6", "--node", node()}).code, 0);
  const Outcome done = sut.finish();
  EXPECT_EQ(done.code, 4) << done.err;
  const auto report = done.json()["shadow"];
  const auto sum = variable(report, "nt::sum");
  EXPECT_EQ(sum["differing"], report["runs"]);
  EXPECT_LT(sum["largest"], 0.5 * report["runs"].get<double>());
  EXPECT_GT(sum["largest"], 0);
}

TEST_F(Shadow, A_version_that_faults_crashes_or_never_returns_does_no_harm) {
  SKIP_CRASHES_UNDER_TSAN();
  start_counting();
  struct Case {
    std::string file;
    int code;
    std::string text;
  };
  for (const Case& one :
       {Case{"reload_throws", 4, "it faults: exception: out of ink"}, Case{"reload_loops", 4, "it faults: "},
        Case{"reload_bad_start", 1, "no ink"}, Case{"reload_dies", 1, "it ended its process (Aborted)"},
        Case{"no_run", 1, "run function"}}) {
    const Outcome done = shadow(built(one.file));
    EXPECT_EQ(done.code, one.code) << one.file << done.out << done.err;
    EXPECT_CONTAINS(done.err, one.text);
    expect_untouched();
  }
}

TEST_F(Shadow, What_a_killed_client_has_started_ends_with_it) {
  SKIP_CRASHES_UNDER_TSAN();
  start_counting();
  const auto shadow_runs = [&] { return vars::running_node(node() + "-shadow") != 0; };
  Program client({INDUROP_PROGRAM, "reload", "counter", built("reload_loops"), "--node", node(), "--shadow", "1s"},
                 environment());
  ASSERT_TRUE(wait_until(shadow_runs));
  client.kill();
  EXPECT_TRUE(wait_until([&] { return !shadow_runs(); }));
  EXPECT_EQ(shadow(built("reload_same")).code, 0);
  expect_untouched();
}

TEST_F(Shadow, Initial_values_need_consent) {
  start_counting("reload_fresh");
  const Outcome refused = shadow(built("reload_same"));
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_CONTAINS(refused.err, "what the running version keeps is not known");
  const Outcome lossy = shadow(built("reload_same"), {"--lossy", "-o", "json"});
  EXPECT_EQ(lossy.code, 4) << lossy.err;
  EXPECT_EQ(variable(lossy.json()["shadow"], "nt::output")["first_is"], "1");
}

TEST_F(Shadow, Modules_that_cannot_be_exchanged_say_so) {
  start_and_wait({kOther,
                  {.file = "process.exe",
                   .name = "process",
                   .type = "process",
                   .period = "2ms",
                   .priority = 4,
                   .more = "<argument>count</argument>"}});
  const Outcome process = indurop({"reload", "process", "--shadow", "200ms", "--node", node()});
  EXPECT_EQ(process.code, 1) << process.err;
  EXPECT_CONTAINS(process.err, "it is a process");
  EXPECT_CONTAINS(indurop({"reload", "othr", "--shadow", "200ms", "--node", node()}).err, "Did you mean 'other'?");
}

}  // namespace
}  // namespace indurop::test
