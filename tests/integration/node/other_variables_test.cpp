// SPDX-License-Identifier: Apache-2.0
// indurop reload: versions that bring variables that the node does not have, or declare them in another way.

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/rt/clock.h"
#include "core/schema/leaf.h"
#include "core/schema/schema.h"
#include "reload_fixture.h"
#include "store/vars/shm_file.h"
#include "store/vars/store.h"

namespace indurop::test {
namespace {

using scheduler::ModuleState;

TEST_F(Reload, New_variables_appear_and_all_tools_see_them) {
  start_counting();
  EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 1);
  Program watching({INDUROP_PROGRAM, "watch", "nt::output", "-o", "json", "--hz", "50"}, environment());
  ASSERT_TRUE(watching.prints("nt::output"));
  Outcome done = reload({"counter", built("gains"), "--dry-run"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_CONTAINS(done.out, "new       nt::gained, nt::pair, nt::limit (shared, initial values)");
  EXPECT_EQ(indurop({"get", "nt::gained", "--node", node()}).code, 1) << "nothing has changed";
  done = reload({"counter", built("gains"), "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.out << done.err;
  expect_all_counted();
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") > 60; }));
  const std::size_t watched = watching.out().size();
  EXPECT_TRUE(wait_until([&] { return watching.out().size() > watched + 200; })) << watching.err();
  EXPECT_EQ(value<double>("nt::limit"), 2.5);
  EXPECT_EQ(indurop({"set", "nt::limit", "3", "--node", node()}).code, 0);
  EXPECT_EQ(indurop({"set", "nt::limit", "11", "--node", node()}).code, 1);
  EXPECT_EQ(indurop({"force", "nt::gained", "5", "--node", node()}).code, 0);
  EXPECT_CONTAINS(indurop({"get", "nt::gained", "--node", node()}).out, "5");
  EXPECT_CONTAINS(indurop({"status", "--node", node()}).out, "nt::gained");
  EXPECT_EQ(indurop({"unforce", "nt::gained", "--node", node()}).code, 0);
  EXPECT_CONTAINS(indurop({"vars", "--node", node()}).out, "nt::pair");
  EXPECT_CONTAINS(indurop({"scope", "nt::gained", "--node", node()}).err, "nt::gained appeared while the node runs");
  EXPECT_EQ(module("counter").faults.load(), 0U);
}

TEST_F(Reload, New_variables_stay_when_the_previous_version_runs_again) {
  start_counting();
  ASSERT_EQ(reload({"counter", built("gains"), "--health", "0s"}).code, 0);
  ASSERT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") > 60; }));
  ASSERT_EQ(reload({"counter", "--back"}).code, 0);
  const auto gained = value<std::int64_t>("nt::gained");
  ASSERT_TRUE(runs_reach("counter", module("counter").runs.load() + 20));
  EXPECT_EQ(value<std::int64_t>("nt::gained"), gained);
  expect_all_counted();
  ASSERT_EQ(reload({"counter", built("gains"), "--health", "0s"}).code, 0);
  EXPECT_TRUE(wait_until([&] { return value<std::int64_t>("nt::gained") > gained + 20; })) << "its value has stayed";
  expect_all_counted();
}

TEST_F(Reload, A_node_that_is_killed_after_its_store_has_grown_starts_with_its_values) {
  Program& first = start_counting();
  ASSERT_EQ(reload({"counter", built("gains"), "--health", "0s"}).code, 0);
  ASSERT_EQ(indurop({"set", "nt::sum", "4.5", "--node", node()}).code, 0);
  first.signal(SIGKILL);
  (void)first.wait();
  EXPECT_GT(value<std::int64_t>("nt::gained"), 11) << "values outlive the node";
  start_counting("gains");
  EXPECT_EQ(value<double>("nt::sum"), 4.5);
  EXPECT_GT(value<std::int64_t>("nt::gained"), 11);
}

// A module that counts its runs in a field of a shared variable, in versions that declare this in other ways.
class OtherTypes : public Reload {
 protected:
  static Module axis(const std::string& name, int priority = 2) {
    return {.file = "layout_old.so", .name = name, .priority = priority};
  }
  static std::string layout(const std::string& version) {
    return std::filesystem::path(MODULE_DIR) / ("layout_" + version + ".so");
  }
  std::int64_t moved() const {
    const auto json = indurop({"get", "nt_layout::axis.x", "--node", node(), "-o", "json"}).json();
    return json.is_discarded() ? -1 : json["values"][0]["value"].get<std::int64_t>();
  }
  // No run was lost but these.
  void expect_all_moved(std::int64_t lost = 0) {
    EXPECT_TRUE(wait_until([&] {
      const auto before = static_cast<std::int64_t>(module("layout").runs.load());
      const std::int64_t now = moved() + lost;
      return before <= now && now <= static_cast<std::int64_t>(module("layout").runs.load());
    })) << moved()
        << " of " << module("layout").runs.load();
  }
};

TEST_F(OtherTypes, Are_carried_by_name_and_back) {
  start_and_wait({kOther, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 100));
  for (int round = 0; round < 3; ++round) {
    Outcome done = reload({"layout", layout("wide"), "--health", "0s"});
    EXPECT_EQ(done.code, 0) << done.out << done.err;
    EXPECT_CONTAINS(done.out, "converted nt_layout::axis.speed, nt_layout::axis.x (shared, of another type now)");
    EXPECT_CONTAINS(done.out, "new       nt_layout::axis.more (shared, initial values)");
    expect_all_moved();
    EXPECT_CONTAINS(indurop({"get", "nt_layout::axis", "--node", node()}).out, "more");
    const std::string why = indurop({"explain", "nt_layout::axis", "--node", node()}).out;
    EXPECT_EQ(why.find("leaves nt_layout::axis as it is"), std::string::npos) << "its new values are not on the tape";
    EXPECT_EQ(indurop({"get", "nt_layout::axis_before", "--node", node()}).code, 0);
    done = reload({"layout", "--back"});
    EXPECT_EQ(done.code, 0) << done.err;
    expect_all_moved();
  }
  EXPECT_EQ(module("layout").faults.load(), 0U);
}

// The count only grows: a value of the former layout after a later one, or half of one, would show.
TEST_F(OtherTypes, Readers_see_a_count_that_never_goes_back_while_its_type_changes) {
  start_and_wait({kOther, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 50));
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> reads{0};
  std::atomic<std::uint64_t> wrong{0};
  std::atomic<std::uint64_t> follows{0};
  std::thread reader([&] {
    std::int64_t last = 0;
    while (!done.load()) {
      const auto store = vars::Store::attach(node(), vars::Mode::ReadOnly);
      const auto place = store ? schema::find_place(store->schema(), "nt_layout::axis.x")
                               : Result<schema::Place, schema::Failure>(schema::Failure{});
      const auto* entry = place ? store->find(place->variable->name_hash()) : nullptr;
      while (entry != nullptr && !done.load() && !store->grown()) {
        std::array<std::uint8_t, sizeof(std::int64_t)> bytes{};
        const std::span<std::uint8_t> part(bytes.data(), place->type.element_size);
        if (!store->read(*entry, place->offset, part)) {
          break;  // it has moved
        }
        const std::int64_t now = *schema::as_number<std::int64_t>(place->type.base, bytes.data());
        wrong += now < last ? 1U : 0U;
        last = now;
        ++reads;
      }
      ++follows;
    }
  });
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(reload({"layout", layout("wide"), "--health", "0s"}).code, 0);
    EXPECT_EQ(reload({"layout", "--back"}).code, 0);
  }
  done = true;
  reader.join();
  EXPECT_EQ(wrong.load(), 0U);
  EXPECT_GT(reads.load(), 1000U);
  EXPECT_GE(follows.load(), 20U);
  expect_all_moved();
}

TEST_F(OtherTypes, Are_refused_with_the_field_where_a_module_that_stays_uses_the_former_one) {
  start_and_wait({axis("stays", 1), axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 10));
  const Outcome done = reload({"layout", layout("wide")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.err, "variable nt_layout::axis has another layout in this node: field");
  EXPECT_CONTAINS(done.err, "module stays, which stays, uses its layout");
  EXPECT_EQ(indurop({"get", "nt_layout::axis_before", "--node", node()}).code, 1);
}

TEST_F(OtherTypes, Are_refused_where_the_configuration_says_that_a_module_uses_the_variable) {
  Module named = kOther;
  named.more = "<access><read>nt_layout::axis</read></access>";
  start_and_wait({named, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 10));
  const Outcome done = reload({"layout", layout("wide")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.err, ", which stays, uses its layout");
}

TEST_F(OtherTypes, Are_refused_for_variables_with_fail_safe_values) {
  Module guarded = axis("layout");
  guarded.more += "<failsafe variable=\"nt_layout::axis.x\">0</failsafe>";
  start_and_wait({kOther, guarded});
  ASSERT_TRUE(runs_reach("layout", 10));
  EXPECT_CONTAINS(reload({"layout", layout("wide")}).err, "has a fail-safe value for it");
}

TEST_F(OtherTypes, Are_refused_for_forced_variables) {
  start_and_wait({kOther, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 10));
  ASSERT_EQ(indurop({"force", "nt_layout::axis.x", "5", "--node", node()}).code, 0);
  EXPECT_CONTAINS(reload({"layout", layout("wide")}).err, "it is forced");
  ASSERT_EQ(indurop({"unforce", "nt_layout::axis.x", "--node", node()}).code, 0);
  EXPECT_EQ(reload({"layout", layout("wide"), "--health", "0s"}).code, 0);
}

TEST_F(OtherTypes, Are_refused_if_the_variable_is_forced_while_the_exchange_waits) {
  Module slow = axis("layout");
  slow.period = "5s";
  start_and_wait({kOther, slow});
  ASSERT_TRUE(runs_reach("layout", 1));
  const auto size = [this] {
    const auto file = vars::ShmFile::open(vars::block_file(node()), vars::Mode::ReadOnly);
    return file ? file->size() : 0;
  };
  const std::size_t before = size();
  Program reloading({INDUROP_PROGRAM, "reload", "layout", layout("wide"), "--health", "0s", "--node", node()},
                    environment());
  ASSERT_TRUE(wait_until([&] { return size() > before; })) << "the new version has been loaded";
  ASSERT_EQ(indurop({"force", "nt_layout::axis.x", "5", "--node", node()}).code, 0);
  EXPECT_NE(reloading.wait(), 0);
  EXPECT_CONTAINS(reloading.err(), "release it (indurop unforce)");
}

// The module adds 1 in each run. Most of the values come after the copying in a gap between two runs.
TEST_F(OtherTypes, No_value_that_a_tool_has_set_is_lost) {
  constexpr std::int32_t kStep = 1000;
  Module slow = axis("layout");
  slow.period = "100ms";
  start_and_wait({kOther, slow});
  ASSERT_TRUE(runs_reach("layout", 1));
  std::int32_t set = 0;
  for (int round = 0; round < 5; ++round) {
    auto store = vars::Store::attach(node(), vars::Mode::ReadWrite);
    ASSERT_TRUE(store.ok());
    const auto* const entry = store->find(abi::fnv1a64("nt_layout::axis", 15));
    ASSERT_NE(entry, nullptr);
    Program reloading({INDUROP_PROGRAM, "reload", "layout", layout("wide"), "--health", "0s", "--node", node()},
                      environment());
    const auto writes = [&](std::int32_t value) {
      std::array<std::uint8_t, sizeof value> bytes{};
      std::memcpy(bytes.data(), &value, sizeof value);
      return store->write(*entry, 0, bytes).ok();
    };
    while (reloading.running() && writes(set + kStep)) {
      set += kStep;
      rt::sleep_until(rt::MonoClock::now() + std::chrono::milliseconds(15));
    }
    EXPECT_EQ(reloading.wait(), 0) << reloading.err();
    EXPECT_GE(moved(), set);
    ASSERT_EQ(reload({"layout", "--back"}).code, 0);
  }
}

// Also of parts of it that begin with another version, and of parts that were joined.
TEST_F(OtherTypes, A_replay_repeats_the_runs_of_those_versions_that_declare_what_its_configuration_does) {
  const std::string all = folder() / "all.mcap";
  Program& program = start_and_wait({kOther, axis("layout")}, {"--record", all});
  const auto& record = module("layout");
  std::vector<std::uint64_t> first;  // ticks of the versions
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"layout", layout("wide"), "--health", "0s"},
                                             {"layout", "--back"},
                                             {"layout", layout("wide"), "--health", "0s"}}) {
    ASSERT_TRUE(runs_reach("layout", record.runs.load() + 1200)) << "with keyframes";
    ASSERT_EQ(reload(words).code, 0);
    first.push_back(record.version_tick.load());
  }
  ASSERT_TRUE(runs_reach("layout", record.runs.load() + 100));
  program.signal(SIGINT);
  ASSERT_EQ(program.wait(), 128 + SIGINT);
  const auto replays = [this](const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"replay", file, "--node", node() + "-r"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome done = indurop(words);
    EXPECT_CONTAINS(done.out, " values: equal") << done.err;
    EXPECT_FALSE(contains(done.err, "damaged")) << done.err;
    return done;
  };
  const auto at = [](std::uint64_t tick) { return std::to_string(tick) + "ms"; };
  const Outcome whole = replays(all);
  EXPECT_EQ(whole.code, 1);
  EXPECT_CONTAINS(whole.err, "declares nt_layout::axis in another way than this configuration");
  EXPECT_EQ(replays(all, {"--to", std::to_string(first[0] - 1)}).code, 0);
  EXPECT_EQ(replays(all, {"--from", std::to_string(first[1] + 1000), "--to", std::to_string(first[2] - 1)}).code, 0);
  const std::string parts[] = {folder() / "a.mcap", folder() / "b.mcap", folder() / "both.mcap"};
  ASSERT_EQ(indurop({"recording", "cut", all, "--to", at(first[0] + 500), "-o", parts[0]}).code, 0);
  ASSERT_EQ(indurop({"recording", "cut", all, "--from", at(first[0] + 500), "-o", parts[1]}).code, 0);
  EXPECT_EQ(replays(parts[0]).code, 1);
  EXPECT_EQ(replays(parts[1]).code, 1);
  ASSERT_EQ(indurop({"recording", "join", parts[0], parts[1], "-o", parts[2]}).code, 0);
  EXPECT_EQ(replays(parts[2]).code, 1);
}

TEST_F(OtherTypes, A_value_that_does_not_fit_is_lost_only_with_consent) {
  start_and_wait({kOther, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 300));
  Outcome done = reload({"layout", layout("narrow")});
  EXPECT_EQ(done.code, 4) << done.err;
  EXPECT_CONTAINS(done.out, "is no value of uint8_t");
  EXPECT_CONTAINS(done.err, "--lossy");
  expect_all_moved();
  done = reload({"layout", layout("narrow"), "--lossy", "--health", "0s"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_TRUE(wait_until([&] { return moved() >= 0 && moved() < 256; }));
}

TEST_F(OtherTypes, A_version_that_throws_is_replaced_with_the_values_before_that_run) {
  start_and_wait({kOther, axis("layout")});
  ASSERT_TRUE(runs_reach("layout", 100));
  const Outcome done = reload({"layout", layout("throws"), "--health", "20s"});
  EXPECT_EQ(done.code, 5) << done.out << done.err;
  EXPECT_CONTAINS(done.err, "the previous version runs again: the new one faulted in tick");
  EXPECT_EQ(module("layout").state.load(), ModuleState::Running);
  expect_all_moved(1);
  const std::int64_t now = moved();
  EXPECT_TRUE(wait_until([&] { return moved() > now + 20; }));
}

}  // namespace
}  // namespace indurop::test
