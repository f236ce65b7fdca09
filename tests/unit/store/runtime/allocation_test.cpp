// SPDX-License-Identifier: Apache-2.0
// What real-time modules call allocates nothing, in no thread of the process.

#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include "hosted.h"
#include "tests/unit/allocations.h"

INDUROP_IMPLEMENT(knu::Robot::add, [](double a, double b) { return a + b; })

namespace {

using namespace knu::Robot;
using indurop::testing::Hosted;
using indurop::testing::TestNode;

// Allocations of ten thousand repetitions, after a first one.
template <class Body>
std::uint64_t allocations_of(Body body) {
  body();
  const std::uint64_t before = g_allocations;
  for (int i = 0; i < 10'000; ++i) {
    body();
  }
  return g_allocations - before;
}

class Allocations : public ::testing::Test {
 protected:
  TestNode node_;
  Hosted hosted_{node_};
};

TEST_F(Allocations, Are_counted_at_all) {
  if (INDUROP_COUNTS_ALLOCATIONS == 0) {
    GTEST_SKIP() << "the sanitizer's allocator is in use";
  }
  EXPECT_GE(allocations_of([] { std::free(std::malloc(100)); }), 10'000U);
}

TEST_F(Allocations, Do_not_happen_in_access_to_variables) {
  EXPECT_EQ(allocations_of([] {
              tick = tick + 10;
              tick += 1;
              INDUROP_TYPEOF(joints)::value_type v = joints[0];
              v.x += tick;
              joints[0] = v;
              joints[1].y = 2;
              label = "arm";
              const auto together = snapshot(tick, joints, label);
              auto all = lock(joints);
              all[3].z = together.get<1>()[3].x;
            }),
            0U);
}

TEST_F(Allocations, Do_not_happen_in_printf) {
  EXPECT_EQ(allocations_of([this] {
              irp::printf("%u %s %12.3lf %p %x\n", tick, label, 1e200, &node_, ~0ULL);
              node_.run().rings()[0].tail = node_.run().rings()[0].head.load();
            }),
            0U);
  EXPECT_GT(node_.module(0).lost_messages, 0U) << "a full ring is included";
}

TEST_F(Allocations, Do_not_happen_in_access_by_a_known_name) {
  channel::Handle handle;
  ASSERT_EQ(connect(handle, node_.name().c_str()), 0);
  EXPECT_EQ(allocations_of([&handle] {
              double y = 0;
              (void)read(handle, "joints[1].y", sizeof y, &y);
              (void)write(handle, "knu::Robot::joints[1].y", sizeof y, &y);
            }),
            0U);
}

TEST_F(Allocations, Do_not_happen_in_calls) {
  ASSERT_TRUE(indurop::runtime::start_function_servers(0, -1));
  ASSERT_TRUE(indurop::testing::wait_until([] { return add(1, 1).ok(); }));
  EXPECT_EQ(allocations_of([] { EXPECT_EQ(double{add(1, 2)}, 3.0); }), 0U);
  EXPECT_EQ(allocations_of([] { EXPECT_FALSE(count().ok()); }), 0U);
}

TEST_F(Allocations, Do_not_happen_in_questions_about_the_schedule) {
  EXPECT_EQ(allocations_of([] {
              (void)irp::period();
              (void)irp::tick();
              (void)irp::release_ns();
              (void)irp::now_ns();
            }),
            0U);
}

}  // namespace
