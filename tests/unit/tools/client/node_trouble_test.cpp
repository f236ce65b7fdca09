// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/node_trouble.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

using testing::Optional;

constexpr std::int64_t kPeriod = 1'000'000;

MirrorView synchronised() {
  MirrorView view;
  view.clock_synchronised = true;
  return view;
}

PeerView peer_behind(std::int64_t ns, std::int64_t bound) {
  PeerView peer;
  peer.name = "b";
  peer.clock_known = true;
  peer.clock_synchronised = true;
  peer.clock_offset_ns = ns;
  peer.clock_bound_ns = bound;
  return peer;
}

TEST(ClocksApart, Are_named_when_they_surely_differ_by_more_than_a_tenth_of_the_period) {
  EXPECT_THAT(clocks_apart(synchronised(), peer_behind(120'001, 20'000), kPeriod),
              Optional(std::string("the clock of board b is 120 us behind this one (+-20.0 us) although both are "
                                   "synchronized: check PTP or NTP")));
  EXPECT_THAT(clocks_apart(synchronised(), peer_behind(-2'500'000, 20'000), kPeriod),
              Optional(testing::HasSubstr("2.50 ms ahead of this one")));
  EXPECT_EQ(clocks_apart(synchronised(), peer_behind(120'000, 20'000), kPeriod), std::nullopt);
}

TEST(ClocksApart, Are_not_named_unless_both_are_said_to_be_synchronized) {
  EXPECT_EQ(clocks_apart(MirrorView(), peer_behind(kPeriod, 0), kPeriod), std::nullopt);
  PeerView free = peer_behind(kPeriod, 0);
  free.clock_synchronised = false;
  EXPECT_EQ(clocks_apart(synchronised(), free, kPeriod), std::nullopt);
  PeerView unknown = peer_behind(kPeriod, 0);
  unknown.clock_known = false;
  EXPECT_EQ(clocks_apart(synchronised(), unknown, kPeriod), std::nullopt);
  EXPECT_EQ(clocks_apart(synchronised(), peer_behind(kPeriod, 0), 0), std::nullopt);
}

}  // namespace
}  // namespace indurop::tools
