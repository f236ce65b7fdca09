// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/status_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

using testing::HasSubstr;

MirrorView view_with(std::uint32_t count) {
  MirrorView view;
  view.plant = "line";
  view.board = "a";
  view.outgoing = view.parts = count;
  view.frames = count;
  PeerView peer;
  peer.name = "b";
  peer.wanted = count;
  peer.frames = count;
  peer.lost_updates = count;
  view.peers.push_back(peer);
  return view;
}

TEST(StatusLines, One_thing_is_not_many) {
  const Output output(ColorWhen::Never);
  const auto one = mirror_lines(view_with(1), output);
  EXPECT_THAT(one[0], HasSubstr("sends 1 variable in 1 frame of up to 1300 bytes, 1 frame so far"));
  EXPECT_THAT(one[1], HasSubstr("1 variable from it"));
  EXPECT_THAT(one[1], HasSubstr("1 frame, 1 update lost"));
  const auto two = mirror_lines(view_with(2), output);
  EXPECT_THAT(two[0], HasSubstr("sends 2 variables in 2 frames of up to 1300 bytes, 2 frames so far"));
  EXPECT_THAT(two[1], HasSubstr("2 variables from it"));
  EXPECT_THAT(two[1], HasSubstr("2 frames, 2 updates lost"));
}

}  // namespace
}  // namespace indurop::tools
