// SPDX-License-Identifier: Apache-2.0
// The optional <indurop/fmt.h>.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <indurop/fmt.h>

#include <indurop/generated.h>

namespace {

using namespace knu::Robot;

TEST(Fmt, Formats_shapes_and_values) {
  joints = std::array<joints_t, 10>{joints_t{}, {1, 2.5, -3}};
  tick = 5;
  label = "arm";
  EXPECT_EQ(fmt::format("{} {:04} {}", tick, tick, joints[1]), "5 0005 {x: 1, y: 2.5, z: -3}");
  EXPECT_EQ(fmt::format("{:.2f}", joints[1].y), "2.50");
  EXPECT_EQ(fmt::format("{:>5}|{}", label, label.get()), "  arm|arm");
  EXPECT_EQ(fmt::format("{}", joints[1].get()), "{x: 1, y: 2.5, z: -3}");
  EXPECT_EQ(fmt::format("{}", joints).substr(0, 46), "[{x: 0, y: 0, z: 0}, {x: 1, y: 2.5, z: -3}, {x");
}

}  // namespace
