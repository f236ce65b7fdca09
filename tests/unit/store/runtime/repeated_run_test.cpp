// SPDX-License-Identifier: Apache-2.0
// A run that is repeated gets its recorded inputs, whatever the values are now.
#include <gtest/gtest.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include <array>

#include "hosted.h"
#include "store/runtime/host.h"

namespace indurop::testing {
namespace {

using namespace knu::Robot;

class RepeatedRun : public ::testing::Test {
 protected:
  static void repeat(std::span<const tape::ReplayedAnswer> answers) { runtime::set_answers(answers); }
  ~RepeatedRun() override { repeat({}); }
  TestNode node_;
  Hosted hosted_{node_};
};

TEST_F(RepeatedRun, Reads_again_whether_values_were_together) {
  const std::array<tape::ReplayedAnswer, 2> answers{{{0, {}}, {1, {}}}};
  tick = 5;
  repeat(answers);
  const auto apart = snapshot(tick, joints);
  const auto together = snapshot(tick, joints);
  EXPECT_FALSE(apart.coherent());
  EXPECT_EQ(apart.get<0>(), 5U) << "values are read all the same";
  EXPECT_TRUE(together.coherent());
  const auto beyond = snapshot(tick, joints);
  EXPECT_TRUE(beyond.coherent()) << "no recorded input is left";
}

TEST_F(RepeatedRun, Reads_again_whether_it_was_to_end) {
  const std::array<tape::ReplayedAnswer, 2> answers{{{0, {}}, {1, {}}}};
  repeat(answers);
  EXPECT_FALSE(irp::stop_requested());
  EXPECT_TRUE(irp::stop_requested());
  EXPECT_FALSE(irp::stop_requested());
}

TEST_F(RepeatedRun, Reads_again_whether_there_was_a_node) {
  const std::array<tape::ReplayedAnswer, 1> answers{{{-static_cast<int>(Errc::NotFound), {}}}};
  channel::Handle handle;
  repeat(answers);
  EXPECT_EQ(channel::connect(handle, node_.name().c_str()), -static_cast<int>(Errc::NotFound));
  EXPECT_EQ(channel::connect(handle, node_.name().c_str()), 0);
}

}  // namespace
}  // namespace indurop::testing
