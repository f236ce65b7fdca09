// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/peer_beacons.h"

#include <gtest/gtest.h>

#include <chrono>

namespace indurop::mirror {
namespace {

using namespace std::chrono_literals;

TEST(Beacons, Come_twice_a_second_in_small_plants) {
  EXPECT_EQ(Beacons::interval(1), 500ms);
  EXPECT_EQ(Beacons::interval(16), 500ms);
}

TEST(Beacons, With_estimates_of_all_the_others_are_heard_32_times_a_second_at_most) {
  for (std::size_t others = 1; others < 1000; ++others) {
    EXPECT_LE(static_cast<double>(others) / std::chrono::duration<double>(Beacons::interval(others)).count(), 32.0001);
  }
}

}  // namespace
}  // namespace indurop::mirror
