// SPDX-License-Identifier: Apache-2.0
// Nodes start and are killed at random instants, sometimes with another layout, while modules write: every start just
// works, modules find the current block on their own, and values survive.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "core/rt/clock.h"
#include "fault.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"
#include "tests/support/wait_until.h"

namespace indurop::vars {
namespace {

using indurop::test::Forked;
using test::array_type;
using test::bytes_of;
using test::hash;
using test::scalar_type;
using test::TestNode;
using test::variable;

struct Score {
  std::atomic<bool> stop;
  std::atomic<std::uint64_t> starts;
  std::atomic<std::uint64_t> fresh;
  std::atomic<std::uint64_t> adopted;
  std::atomic<std::uint64_t> carried_over;
  std::atomic<std::uint64_t> failures;
  std::atomic<std::uint64_t> writes;
  std::atomic<std::uint64_t> attached_again;
  std::atomic<std::uint64_t> surprises;  // a module met an error it should never meet
};

schema::Schema layout(bool other) {
  schema::Schema schema;
  schema.variables.push_back(variable("count", scalar_type(schema::Base::UInt64)));
  schema.variables.push_back(variable("joints", array_type(schema::Base::Double, 600)));
  if (other) {
    schema.variables.push_back(variable("extra", array_type(schema::Base::Int32, 5)));
  }
  return schema;
}

int run_node(const TestNode& node, Score& score, bool other) {
  pid_t holder = 0;
  const auto lock = NodeLock::acquire(node.name(), holder);
  auto store = lock.ok() ? Store::create(node.name(), layout(other)) : Result<Store>(lock.error());
  const auto run = store.ok() ? RunFile::create(node.name(), 20'000) : Result<RunFile>(store.error());
  if (!run.ok()) {
    score.failures.fetch_add(1);
    return 1;
  }
  score.starts.fetch_add(1);
  switch (store->origin()) {
    case Origin::Fresh:
      score.fresh.fetch_add(1);
      break;
    case Origin::Adopted:
      score.adopted.fetch_add(1);
      break;
    case Origin::CarriedOver:
    case Origin::Attached:
      score.carried_over.fetch_add(1);
      break;
  }
  while (!score.stop) {
    store->beat(rt::MonoClock::now());
  }
  return 0;
}

int run_module(const TestNode& node, Score& score) {
  while (!score.stop) {
    auto store = Store::attach(node.name(), Mode::ReadWrite);
    if (!store.ok()) {
      const Errc code = store.error().code;
      score.surprises.fetch_add(code == Errc::NotFound || code == Errc::Busy ? 0 : 1);
      continue;
    }
    score.attached_again.fetch_add(1);
    const DirectoryEntry& joints = *store->find(hash("joints"));
    for (std::uint32_t i = 0; !score.stop && !store->retired(); i = (i + 1) % 600) {
      const Status status = store->write(joints, i * 8, bytes_of(1.0));
      score.writes.fetch_add(status.ok() ? 1 : 0);
    }
  }
  return 0;
}

TEST(KilledNodes, Every_start_works_and_values_survive) {
  const TestNode node("killed-nodes");
  const test::Shared<Score> score;
  {
    auto store = Store::create(node.name(), layout(false));
    ASSERT_TRUE(store.ok());
    ASSERT_TRUE(store->write(*store->find(hash("count")), 0, bytes_of<std::uint64_t>(4711)).ok());
  }
  Forked module([&] { return run_module(node, *score); });
  std::mt19937 random(3);
  bool other = false;
  for (const test::Duration duration; !duration.over();) {
    other = random() % 4 == 0 ? !other : other;
    Forked starting([&] { return run_node(node, *score, other); });
    test::wait_a_random_moment(random, 3000);
    starting.kill_and_wait();
  }
  const std::uint64_t before = score->starts;
  Forked final_node([&] { return run_node(node, *score, other); });
  EXPECT_TRUE(indurop::test::wait_until([&] { return score->starts > before; }));
  const std::uint64_t attached = score->writes;
  EXPECT_TRUE(indurop::test::wait_until([&] { return score->writes > attached; })) << "the module goes on writing";
  score->stop = true;
  EXPECT_EQ(final_node.wait(), 0);
  EXPECT_EQ(module.wait(), 0);
  EXPECT_EQ(score->failures, 0U);
  EXPECT_EQ(score->surprises, 0U);
  EXPECT_EQ(score->fresh, 0U);

  const auto store = Store::attach(node.name(), Mode::ReadOnly);
  ASSERT_TRUE(store.ok());
  std::vector<std::uint8_t> count(8);
  ASSERT_TRUE(store->read(*store->find(hash("count")), 0, count).ok());
  EXPECT_EQ(count, bytes_of<std::uint64_t>(4711));
  std::vector<std::uint8_t> joints(4800);
  ASSERT_TRUE(store->read(*store->find(hash("joints")), 0, joints).ok());
  for (std::size_t i = 0; i < joints.size(); i += 8) {
    double value = 0;
    std::memcpy(&value, joints.data() + i, 8);
    ASSERT_TRUE(value == 0.0 || value == 1.0);
  }
  EXPECT_FALSE(std::filesystem::exists(node.path() + ".tmp"));
  std::printf("%llu starts, %llu adopted, %llu carried over, %llu writes, %llu attachments\n",
              static_cast<unsigned long long>(score->starts), static_cast<unsigned long long>(score->adopted),
              static_cast<unsigned long long>(score->carried_over), static_cast<unsigned long long>(score->writes),
              static_cast<unsigned long long>(score->attached_again));
}

TEST(KilledNodes, Name_is_free_again_after_every_kill) {
  const TestNode node("name");
  const test::Shared<Score> score;
  const auto start_and_end = [&] {
    while (!score->stop) {
      pid_t holder = 0;
      score->starts.fetch_add(NodeLock::acquire(node.name(), holder).ok() ? 1 : 0);
    }
    return 0;
  };
  Forked steady(start_and_end);
  std::mt19937 random(4);
  for (const test::Duration duration; !duration.over();) {
    Forked starting(start_and_end);
    test::wait_a_random_moment(random, 2000);
    starting.kill_and_wait();
  }
  const std::uint64_t before = score->starts;
  EXPECT_TRUE(indurop::test::wait_until([&] { return score->starts > before; }));
  score->stop = true;
  EXPECT_EQ(steady.wait(), 0);
}

}  // namespace
}  // namespace indurop::vars
