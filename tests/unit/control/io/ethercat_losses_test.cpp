// SPDX-License-Identifier: Apache-2.0
// What is said of frames that were lost, and how often.
#include "control/io/ethercat_losses.h"

#include <gmock/gmock.h>

namespace indurop::io {
namespace {

using std::chrono::seconds;

TEST(EthercatLosses, The_first_is_reported_at_once_and_more_every_ten_seconds) {
  EthercatLosses losses;
  EXPECT_EQ(losses.news(seconds(1)), "");
  losses.set({.sent = 10, .lost = 1});
  EXPECT_EQ(losses.news(seconds(2)), "1 frame late or lost");
  losses.set({.sent = 20, .lost = 3, .late = 1});
  EXPECT_EQ(losses.news(seconds(11)), "");
  EXPECT_EQ(losses.news(seconds(12)), "2 frames late or lost");
  EXPECT_EQ(losses.news(seconds(30)), "");
}

TEST(EthercatLosses, What_the_interface_does_not_take_is_lost) {
  EthercatLosses losses;
  losses.set({.sent = 10, .not_sent = 4});
  EXPECT_EQ(losses.news(seconds(1)), "4 frames late or lost");
}

TEST(EthercatLosses, The_total_has_every_counter) {
  EthercatLosses losses;
  losses.set({.sent = 1000, .lost = 3, .late = 2, .duplicates = 4, .foreign = 5, .not_sent = 6});
  EXPECT_EQ(losses.total(),
            "1000 frames sent: 2 came back late, 1 were lost, 4 doubled, 5 not ours, 6 not taken by the interface");
}

}  // namespace
}  // namespace indurop::io
