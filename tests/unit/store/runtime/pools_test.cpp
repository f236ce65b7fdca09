// SPDX-License-Identifier: Apache-2.0
// Pools as modules use them: bound to the node's, without a node, after a fault, and after the node has replaced them.

#include <gtest/gtest.h>
#include <indurop/indurop.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hosted.h"
#include "pools.glb.h"
#include "store/pools/pool.h"
#include "tests/unit/allocations.h"

namespace {

using indurop::testing::Hosted;
using indurop::testing::TestNode;
using knu::Vision::camera;
namespace pools = indurop::pools;
namespace runtime = indurop::runtime;
namespace schema = indurop::schema;

const schema::Pool& declared(const schema::Schema& of, const std::string& name) {
  for (const schema::Pool& pool : of.pools) {
    if (pool.name == name) {
      return pool;
    }
  }
  throw std::runtime_error(name);
}

pools::Pool make(const std::string& node, const std::string& name) {
  const schema::Schema all = indurop::testing::sample_schema();
  const schema::Pool& pool = declared(all, name);
  return pools::Pool::create(node, {pool.name, pool.type_hash, pool.type.element_size, pool.type.dims[0]}).value();
}

// A node with its pools, and this process as its own.
class Pools : public testing::Test {
 protected:
  ~Pools() override {
    hosted_.reset();
    camera_.remove();
    unused_.remove();
  }
  static std::uint64_t publish(std::uint64_t value) {
    auto draft = camera.take();
    if (!draft) {
      return 0;
    }
    draft->value = value;
    return draft.publish();
  }
  TestNode node_;
  pools::Pool camera_ = make(node_.name(), "knu::Vision::camera");
  pools::Pool unused_ = make(node_.name(), "knu::Vision::unused");
  std::unique_ptr<Hosted> hosted_ = std::make_unique<Hosted>(node_);
};

TEST(PoolsWithoutNode, Have_no_chunks) {
  EXPECT_FALSE(camera.take());
  EXPECT_FALSE(camera.latest());
  EXPECT_FALSE(camera.next());
}

TEST(PoolsWithoutNode, Of_a_node_that_lacks_them_are_a_problem) {
  TestNode node;
  const Hosted hosted(node);
  ASSERT_EQ(hosted.problems.size(), 1U) << "one for each pool that is used";
  EXPECT_EQ(hosted.problems[0].find("pool knu::Vision::camera: node '" + node.name() + "' does not have it"), 0U)
      << hosted.problems[0];
}

TEST_F(Pools, Show_readers_the_memory_that_was_written) {
  EXPECT_TRUE(hosted_->problems.empty());
  auto draft = camera.take();
  ASSERT_TRUE(draft);
  const void* const written = &draft->pixels;
  draft->pixels[7] = 9;
  EXPECT_EQ(draft.publish(), 1U);
  EXPECT_FALSE(draft);
  const auto frame = camera.latest();
  ASSERT_TRUE(frame);
  EXPECT_EQ(static_cast<const void*>(&frame->pixels), written);
  EXPECT_EQ(frame->pixels[7], 9);
  EXPECT_EQ(frame.number(), 1U);
  EXPECT_GE(frame.age().count(), 0);
}

TEST_F(Pools, Get_back_what_goes_out_of_scope) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(camera.take()) << "a draft that is not published is free again";
  }
  publish(1);
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(camera.latest());
    EXPECT_NE(publish(2), 0U);
  }
  auto first = camera.latest();
  auto moved = std::move(first);
  moved.release();
  EXPECT_FALSE(moved);
  EXPECT_EQ(camera_.usage().users.at(0).holds, 0U);
}

TEST_F(Pools, Give_each_chunk_once_and_count_those_that_were_missed) {
  publish(1);
  EXPECT_EQ(camera.next()->value, 1U);
  EXPECT_FALSE(camera.next());
  for (std::uint64_t i = 2; i <= 9; ++i) {
    publish(i);
  }
  EXPECT_EQ(camera.next()->value, 7U);
  EXPECT_EQ(camera.next()->value, 8U);
  EXPECT_EQ(camera.next()->value, 9U);
  EXPECT_FALSE(camera.next());
  EXPECT_EQ(camera_.usage().missed, 5U);
}

TEST_F(Pools, Count_a_writer_that_finds_no_chunk) {
  publish(1);
  const auto held = camera.latest();
  publish(2);
  const auto also_held = camera.latest();
  auto draft = camera.take();
  EXPECT_TRUE(draft);
  EXPECT_FALSE(camera.take());
  EXPECT_EQ(camera_.usage().without_a_chunk, 1U);
}

TEST_F(Pools, Are_used_only_if_the_code_does) {
  EXPECT_EQ(camera_.usage().users.size(), 1U);
  EXPECT_EQ(unused_.usage().users.size(), 0U);
}

TEST_F(Pools, Are_free_after_a_fault_and_ignore_what_it_left) {
  publish(1);
  auto held = camera.latest();
  auto draft = camera.take();
  runtime::release_chunks_of(runtime::kNoModule);
  EXPECT_EQ(camera_.usage().free, 2U);
  EXPECT_EQ(draft.publish(), 0U);
  held.release();
  EXPECT_EQ(camera_.usage().free, 2U);
  EXPECT_EQ(publish(2), 2U);
}

TEST_F(Pools, Are_out_of_reach_of_a_version_that_does_not_run) {
  publish(1);
  runtime::bind_apart(&camera);
  EXPECT_FALSE(camera.latest());
  runtime::bind_back(&camera);
  EXPECT_TRUE(camera.latest());
}

TEST_F(Pools, Allocate_nothing) {
  if (INDUROP_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "the sanitizer's allocator is in use";
  }
  const std::uint64_t before = g_allocations;
  for (int i = 0; i < 1000; ++i) {
    publish(1);
    const auto latest = camera.latest();
    const auto next = camera.next();
    const auto unwanted = camera.take();
  }
  EXPECT_EQ(g_allocations, before);
}

// A program that is no module: it searches for a pool that was replaced when it uses it.
TEST(PoolsOfPrograms, Are_found_again_after_the_node_has_replaced_them) {
  TestNode node;
  auto pool = std::make_unique<pools::Pool>(make(node.name(), "knu::Vision::camera"));
  ASSERT_EQ(irp::attach(node.name().c_str()), 0);
  auto draft = camera.take();
  ASSERT_TRUE(draft);
  pool->remove();
  EXPECT_FALSE(camera.latest());
  pool = std::make_unique<pools::Pool>(make(node.name(), "knu::Vision::camera"));
  EXPECT_TRUE(indurop::testing::wait_until([] { return static_cast<bool>(camera.take()); }));
  draft->value = 5;  // the old memory is still there
  (void)draft.publish();
  EXPECT_FALSE(camera.latest()) << "what was published in the old pool is not in the new one";
  pool->remove();
  runtime::detach_process();
}

}  // namespace
