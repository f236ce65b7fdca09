// SPDX-License-Identifier: Apache-2.0
// kill -9 of a node at any instant: the next start just works, and its variables are what they should be.

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "node_fixture.h"

namespace indurop::test {
namespace {

const std::vector<Module> kCounter = {{.file = "counter.so", .name = "counter"}};

std::vector<Module> with_process() {
  return {{.file = "counter.so", .name = "counter"},
          {.file = "process.exe", .name = "process", .type = "process", .period = "5ms", .priority = 2}};
}

class KilledNode : public NodeTest {
 protected:
  // What counter.so saw when it started.
  static std::pair<unsigned, unsigned> seen_at_start(Program& program) {
    unsigned counted = 0;
    unsigned kept = 0;
    EXPECT_TRUE(program.prints("counter starts with"));
    EXPECT_EQ(std::sscanf(program.out().c_str(), "counter starts with counted %u, kept %u", &counted, &kept), 2);
    return {counted, kept};
  }
  void kill_all() {
    for (const auto& program : programs_) {
      program->kill();
    }
  }
};

TEST_F(KilledNode, At_any_instant_does_not_hinder_the_next_start) {
  std::mt19937 random(20);
  std::uniform_int_distribution<int> wait_us(0, 150'000);
  constexpr int kKills = 40;
  for (int i = 0; i < kKills; ++i) {
    Program& victim = start(with_process());
    std::this_thread::sleep_for(std::chrono::microseconds(wait_us(random)));
    victim.kill();
    EXPECT_THAT(victim.err(), ::testing::Not(::testing::HasSubstr("error"))) << "start " << i;
  }
  EXPECT_EQ(run_to_end(with_process(), {"--duration", "50ms"}).code, 0);
  EXPECT_EQ(module("counter").runs.load() + module("counter").skipped.load(), 50U);
}

TEST_F(KilledNode, While_it_stops_does_not_hinder_the_next_start) {
  std::mt19937 random(21);
  std::uniform_int_distribution<int> wait_us(0, 20'000);
  for (int i = 0; i < 8; ++i) {
    Program& victim = start_and_wait(with_process());
    victim.signal(SIGTERM);
    std::this_thread::sleep_for(std::chrono::microseconds(wait_us(random)));
    victim.kill();
  }
  EXPECT_EQ(run_to_end(with_process(), {"--duration", "20ms"}).code, 0);
}

TEST_F(KilledNode, Leaves_its_values_to_the_next_one) {
  Program& victim = start_and_wait(kCounter);
  ASSERT_TRUE(runs_reach("counter", 20));
  victim.kill();
  const auto left = value<std::uint32_t>("nt::counted");
  EXPECT_GE(left, 20U);
  const auto [counted, kept] = seen_at_start(start(kCounter));
  EXPECT_EQ(counted, left);
  EXPECT_EQ(kept, left);
}

TEST_F(KilledNode, That_stopped_in_good_order_before_leaves_only_retained_values) {
  Program& first = start_and_wait(kCounter);
  ASSERT_TRUE(runs_reach("counter", 20));
  first.signal(SIGTERM);
  ASSERT_EQ(first.wait(), 0);
  const auto left = value<std::uint32_t>("nt::kept");
  const auto [counted, kept] = seen_at_start(start(kCounter));
  EXPECT_EQ(counted, 0U);
  EXPECT_EQ(kept, left);
}

TEST_F(KilledNode, Retained_values_survive_the_loss_of_the_shared_memory) {
  Program& first = start_and_wait(kCounter);
  ASSERT_TRUE(runs_reach("counter", 20));
  first.signal(SIGTERM);
  ASSERT_EQ(first.wait(), 0);
  const auto left = value<std::uint32_t>("nt::kept");
  for (const std::string& file : files_left()) {
    std::filesystem::remove("/dev/shm/" + file);
  }
  const auto [counted, kept] = seen_at_start(start(kCounter));
  EXPECT_EQ(counted, 0U);
  EXPECT_EQ(kept, left);
}

TEST_F(KilledNode, Has_saved_its_retained_values_by_then) {
  Program& victim = start_and_wait(kCounter);
  const auto saved = folder() / "state" / node();
  ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(saved / "retain.a"); }));
  victim.kill();
  for (const std::string& file : files_left()) {
    std::filesystem::remove("/dev/shm/" + file);
  }
  const auto [counted, kept] = seen_at_start(start(kCounter));
  EXPECT_EQ(counted, 0U);
  EXPECT_GT(kept, 0U);
}

TEST_F(KilledNode, Takes_its_process_modules_along) {
  Program& victim = start_and_wait(
      {{.file = "counter.so", .name = "counter"},
       {.file = "process.exe", .name = "good", .type = "process", .priority = 2},
       {.file = "process.exe", .name = "deaf", .type = "process", .priority = 3, .more = "<argument>deaf</argument>"},
       {.file = "process.exe", .name = "never", .type = "process", .priority = 4, .more = "<argument>never</argument>"},
       {.file = "legacy.exe", .name = "legacy", .type = "process", .priority = 5, .more = "<signal>SIGUSR1</signal>"}});
  std::vector<pid_t> children;
  for (const char* name : {"good", "deaf", "never", "legacy"}) {
    children.push_back(module(name).pid.load());
    EXPECT_TRUE(alive(children.back())) << name;
  }
  victim.kill();
  for (const pid_t child : children) {
    EXPECT_TRUE(wait_until([child] { return !alive(child); }));
  }
}

TEST_F(KilledNode, Is_shown_as_such) {
  Program& victim = start_and_wait(kCounter);
  victim.kill();
  const auto status = indurop({"status", "-o", "json"});
  EXPECT_EQ(status.code, 6);
  const auto json = nlohmann::json::parse(status.out);
  EXPECT_EQ(json["running"], false);
  EXPECT_EQ(json["state"], "killed");
  EXPECT_EQ(indurop({"clean", "--node", node()}).code, 0);
  EXPECT_THAT(files_left(), ::testing::IsEmpty());
}

TEST_F(KilledNode, Does_not_hinder_one_with_other_variables) {
  Program& victim = start_and_wait({{.file = "layout_old.so", .name = "m"}});
  ASSERT_TRUE(runs_reach("m", 5));
  victim.kill();
  Program& sut = start_and_wait({{.file = "layout_new.so", .name = "m"}});
  EXPECT_TRUE(runs_reach("m", 5));
  sut.signal(SIGTERM);
  EXPECT_EQ(sut.wait(), 0);
}

TEST_F(KilledNode, Garbage_in_its_files_does_not_hinder_the_next_one) {
  Program& victim = start_and_wait(kCounter);
  victim.kill();
  for (const std::string& file : files_left()) {
    std::filesystem::remove("/dev/shm/" + file);
    std::ofstream("/dev/shm/" + file) << "this is not what it should be";
  }
  EXPECT_EQ(run_to_end(kCounter, {"--duration", "20ms"}).code, 0);
}

}  // namespace
}  // namespace indurop::test
