// SPDX-License-Identifier: Apache-2.0
// indurop reload --shadow: a new version repeats the runs of the running one, and what it writes is compared. What is
// expected is computed by hand from the constants that differ.

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "node_fixture.h"
#include "store/vars/node_lock.h"
#include "store/vars/store.h"

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
        Case{"no_run", 1, "no_run.so' has no run function"}, Case{"nowhere", 4, "nowhere.so: no such file"}}) {
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

TEST_F(Shadow, Misspelt_names_are_noticed) {
  start_counting();
  EXPECT_CONTAINS(indurop({"reload", "othr", "--shadow", "200ms", "--node", node()}).err, "Did you mean 'other'?");
}

class ShadowOfProcess : public Shadow {
 protected:
  void start_walking() {
    start_and_wait(
        {kOther,
         {.file = "rambler_process.exe", .name = "counter", .type = "process", .period = "2ms", .priority = 4}});
    ASSERT_TRUE(runs_reach("counter", 400));
  }
  Outcome shadow_of(const std::string& name, const std::vector<std::string>& more = {}) const {
    return shadow(std::filesystem::path(MODULE_DIR) / (name + ".exe"), more);
  }
};

TEST_F(ShadowOfProcess, Does_not_differ_from_itself) {
  start_walking();
  const Outcome done = shadow_of("rambler_process");
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "2 variables: equal");
  EXPECT_CONTAINS(done.err, "this version runs already");
  expect_untouched();
}

// It begins where the running process was, and goes 5 further in each run.
TEST_F(ShadowOfProcess, Differs_by_what_it_does_in_another_way) {
  start_walking();
  const pid_t before = module("counter").pid.load();
  const Outcome done = shadow_of("rambler_process_other", {"-o", "json"});
  EXPECT_EQ(done.code, 4) << done.err;
  const nlohmann::json report = done.json()["shadow"];
  const nlohmann::json walked = variable(report, "nt::walked");
  EXPECT_GT(report["runs"], 200);
  EXPECT_EQ(walked["differing"], report["runs"]);
  EXPECT_EQ(walked["largest"], 5 * report["runs"].get<double>());
  EXPECT_GT(report["now"]["median_ns"], 0);
  EXPECT_EQ(module("counter").pid.load(), before);
  expect_untouched();
  const Outcome accepted = shadow_of("rambler_process_other", {"--accept", "nt::* <= inf"});
  EXPECT_EQ(accepted.code, 0) << accepted.out << accepted.err;
  EXPECT_NE(module("counter").pid.load(), before);
}

TEST_F(ShadowOfProcess, That_keeps_it_in_another_way_needs_consent) {
  start_walking();
  const Outcome done = shadow_of("rambler_by_process", {"--lossy", "--accept", "nt::* <= inf"});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_EQ(module("counter").version.load(), 2U);
}

// Versions that use variables which the node does not have, or has with another type.
class ShadowOfOthers : public Shadow {
 protected:
  [[nodiscard]] std::uint64_t growths() const {
    const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
    return store ? store->header().growths.load() : UINT64_MAX;
  }
  void expect_no_new_variables() {
    expect_untouched();
    EXPECT_EQ(growths(), 0U);
    EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 1);
  }
  Program& start_moving() {
    Program& program = start_and_wait({kOther, {.file = "layout_old.so", .name = "counter", .priority = 2}});
    EXPECT_TRUE(runs_reach("counter", 300));
    return program;
  }
};

// Its outputs are those of the running version only if the new variables begin with their initial values, and each run
// finds what the one before it has left there.
TEST_F(ShadowOfOthers, New_variables_begin_with_initial_values_and_come_with_the_exchange) {
  start_counting();
  const Outcome dry = shadow(built("reload_gains_same"), {"--dry-run"});
  EXPECT_EQ(dry.code, 0) << dry.out << dry.err;
  EXPECT_CONTAINS(dry.out, "2 variables: equal");
  EXPECT_CONTAINS(dry.out,
                  "nt::gained, nt::pair and nt::limit are new in the shadow and began with initial values; nothing is "
                  "compared with them");
  expect_no_new_variables();
  const Outcome done = shadow(built("reload_gains_same"), {"-o", "json"});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  const auto report = done.json();
  const std::vector<std::string> all = {"nt::gained", "nt::pair", "nt::limit"};
  EXPECT_EQ(report["shadow"]["new"].get<std::vector<std::string>>(), all);
  EXPECT_GT(report["shadow"]["runs"], 500U);
  EXPECT_EQ(module("counter").version.load(), 2U);
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") > 11 + 20; }));
  EXPECT_EQ(growths(), 1U);
  const auto output = value<std::int32_t>("nt::output");
  EXPECT_GE(value<std::int64_t>("nt::walked"), output) << "they began with their initial values here, too";
}

TEST_F(ShadowOfOthers, New_variables_need_no_acceptance_and_other_differences_do) {
  start_counting();
  const Outcome refused = shadow(built("reload_gains"));
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_CONTAINS(refused.err, "not exchanged: nt::walked differs in ");
  EXPECT_FALSE(contains(refused.err, "gained")) << refused.err;
  EXPECT_CONTAINS(refused.out, "nt::limit are new in the shadow");
  expect_no_new_variables();
  const Outcome done = shadow(built("reload_gains"), {"--accept", "walked <= inf, gained < 1"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "new       nt::gained, nt::pair, nt::limit (shared, initial values)");
  EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 0);
}

TEST_F(ShadowOfOthers, A_shadow_that_is_killed_leaves_nothing_and_the_next_one_has_initial_values) {
  SKIP_CRASHES_UNDER_TSAN();
  start_counting();
  const auto runs = [&] { return vars::running_node(node() + "-shadow"); };
  for (const bool whole : {false, true}) {
    Program client(
        {INDUROP_PROGRAM, "reload", "counter", built("reload_gains_loops"), "--node", node(), "--shadow", "1500ms"},
        environment());
    ASSERT_TRUE(wait_until([&] { return runs() != 0; }));
    if (whole) {
      client.kill();
    } else {
      ASSERT_EQ(::kill(runs(), SIGKILL), 0);
      EXPECT_EQ(client.wait(), 1);
      EXPECT_CONTAINS(client.err(), "not exchanged: as a shadow of the running version, it was ended");
    }
    EXPECT_TRUE(wait_until([&] { return runs() == 0; }));
    EXPECT_EQ(growths(), 0U);
    EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 1);
  }
  const Outcome done = shadow(built("reload_gains_same"));
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "2 variables: equal");
  EXPECT_EQ(growths(), 1U);
}

TEST_F(ShadowOfOthers, Other_types_are_compared_as_the_node_has_them) {
  start_moving();
  const Outcome done = shadow(built("layout_wide"));
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  EXPECT_CONTAINS(done.out, "1 variable: equal");
  EXPECT_CONTAINS(done.out, "compared as the types that the node has: nt_layout::axis.speed and nt_layout::axis.x");
  EXPECT_CONTAINS(done.out, "nt_layout::axis.more is new in the shadow");
  EXPECT_CONTAINS(done.out, "converted nt_layout::axis.speed, nt_layout::axis.x");
  EXPECT_EQ(module("counter").version.load(), 2U);
  EXPECT_EQ(module("counter").faults.load(), 0U);
}

// The module adds 1 to what others have set.
TEST_F(ShadowOfOthers, What_others_write_meanwhile_is_converted) {
  start_moving();
  const std::filesystem::path recordings = folder() / "recordings";
  std::filesystem::create_directory(recordings);
  Environment where = environment();
  where.variables.push_back("TMPDIR=" + recordings.string());
  Program sut({INDUROP_PROGRAM, "reload", "counter", built("layout_wide"), "--node", node(), "--shadow", "3s",
               "--dry-run", "-o", "json"},
              where);
  ASSERT_TRUE(wait_until([&] { return has_file(recordings, "runs.mcap"); }));
  for (const char* number : {"1000000", "-70000", "41"}) {
    ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 300));
    ASSERT_EQ(indurop({"set", "nt_layout::axis.x", number, "--node", node()}).code, 0);
  }
  const Outcome done = sut.finish();
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  const auto axis = variable(done.json()["shadow"], "nt_layout::axis");
  EXPECT_EQ(axis["differing"], 0) << axis.dump();
  EXPECT_GT(axis["compared"], 900);
}

TEST_F(ShadowOfOthers, Values_that_the_new_type_does_not_have_differ) {
  start_moving();
  const Outcome done = shadow(built("layout_narrow"));
  EXPECT_EQ(done.code, 4) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "not exchanged: nt_layout::axis differs in ");
  EXPECT_CONTAINS(shadow(built("layout_narrow"), {"--accept", "axis <= inf"}).err, "--lossy");
  EXPECT_EQ(module("counter").version.load(), 1U);
}

}  // namespace
}  // namespace indurop::test
