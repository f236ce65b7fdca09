// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_block.h"

#include <gmock/gmock.h>

#include <atomic>
#include <memory>
#include <thread>

namespace indurop::mirror {
namespace {

TEST(Shared_text, Keeps_what_was_set_last_and_cuts_what_is_too_long) {
  const auto sut = std::make_unique<SharedText>();
  sut->set("one");
  sut->set("two");
  EXPECT_EQ(sut->get(), "two");
  sut->set(std::string(1000, 'x'));
  EXPECT_EQ(sut->get(), std::string(kProblemText - 1, 'x'));
  sut->set("");
  EXPECT_EQ(sut->get(), "");
}

TEST(Shared_text, Readers_never_see_a_mixture) {
  const auto sut = std::make_unique<SharedText>();
  const std::string a(100, 'a');
  const std::string b(200, 'b');
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    while (!stop) {
      sut->set(a);
      sut->set(b);
    }
  });
  for (int i = 0; i < 20'000; ++i) {
    const std::string seen = sut->get();
    if (!seen.empty() && seen != a && seen != b) {
      ADD_FAILURE() << seen;
      break;
    }
  }
  stop = true;
  writer.join();
}

TEST(Peer_state, Every_state_has_a_word) {
  EXPECT_STREQ(to_text(PeerState::Absent), "absent");
  EXPECT_STREQ(to_text(PeerState::Alive), "alive");
  EXPECT_STREQ(to_text(PeerState::Mismatched), "mismatched");
  EXPECT_STREQ(to_text(PeerState::Silent), "silent");
  EXPECT_STREQ(to_text(static_cast<PeerState>(77)), "unknown");
}

}  // namespace
}  // namespace indurop::mirror
