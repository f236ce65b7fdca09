// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/own_lead.h"

#include <gmock/gmock.h>

#include <cstddef>
#include <cstring>
#include <vector>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// This board, "control", and two others.
class LeadTest : public ::testing::Test {
 protected:
  LeadTest() : memory_(mirror_block_size(2, 0)), plant_(*new (memory_.data()) MirrorBlock{}) {
    plant_.peer_count = 2;
    std::strcpy(plant_.peers()[0].name, "backup");
    std::strcpy(plant_.peers()[1].name, "sensor");
    plant_.session.store(20);
    plant_.network.store(Network::Up);
  }
  void subscribe(std::size_t board, PeerState state, std::uint64_t session) {
    plant_.peers()[board].session.store(session);
    plant_.peers()[board].state.store(state);
  }

  alignas(MirrorBlock) std::vector<std::byte> memory_;
  MirrorBlock& plant_;
};

TEST_F(LeadTest, Without_rivals_it_is_ours_always) {
  subscribe(0, PeerState::Alive, 10);
  Lead sut(&plant_, {});
  EXPECT_FALSE(sut.update(5 * kSecond));
  EXPECT_TRUE(sut.ours());
  EXPECT_TRUE(Lead(nullptr, {"backup"}).ours()) << "no board of a plant";
}

TEST_F(LeadTest, Begins_only_after_it_has_had_time_to_hear_others) {
  plant_.network.store(Network::Connecting);
  Lead sut(&plant_, {"backup"});
  EXPECT_FALSE(sut.update(kSecond));
  EXPECT_FALSE(sut.update(5 * kSecond));
  plant_.network.store(Network::Up);
  EXPECT_FALSE(sut.update(6 * kSecond));
  EXPECT_FALSE(sut.update(6 * kSecond + Lead::kPatienceNs - 1));
  EXPECT_FALSE(sut.ours());
  EXPECT_TRUE(sut.update(6 * kSecond + Lead::kPatienceNs));
  EXPECT_TRUE(sut.ours());
}

TEST_F(LeadTest, Is_with_the_board_that_has_served_longest) {
  Lead sut(&plant_, {"backup"});
  subscribe(0, PeerState::Alive, 10);
  subscribe(1, PeerState::Alive, 5);
  EXPECT_FALSE(sut.update(kSecond));
  EXPECT_FALSE(sut.update(3 * kSecond));
  EXPECT_FALSE(sut.ours()) << "backup has it";
  subscribe(0, PeerState::Silent, 10);
  EXPECT_TRUE(sut.update(3 * kSecond + 1));
  EXPECT_TRUE(sut.ours()) << "sensor has been there for longer, but does not have the variable";
  subscribe(0, PeerState::Alive, 30);
  EXPECT_FALSE(sut.update(4 * kSecond)) << "a restarted board does not take the lead back";
  EXPECT_TRUE(sut.ours());
}

}  // namespace
}  // namespace indurop::mirror
