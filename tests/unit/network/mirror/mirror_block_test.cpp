// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/mirror_block.h"

#include <gmock/gmock.h>

#include <atomic>
#include <memory>
#include <span>
#include <thread>
#include <vector>

namespace indurop::mirror {
namespace {

TEST(Shared_text, Keeps_what_was_set_last_and_cuts_what_is_too_long) {
  const auto sut = std::make_unique<base::SharedText>();
  sut->set("one");
  sut->set("two");
  EXPECT_EQ(sut->get(), "two");
  sut->set(std::string(1000, 'x'));
  EXPECT_EQ(sut->get(), std::string(base::kSharedText - 1, 'x'));
  sut->set("");
  EXPECT_EQ(sut->get(), "");
}

TEST(Shared_text, Readers_never_see_a_mixture) {
  const auto sut = std::make_unique<base::SharedText>();
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

class BlockInMemory : public ::testing::Test {
 protected:
  BlockInMemory() : memory_(mirror_block_size(2, 3) / sizeof(std::uint64_t)) {
    block().magic.store(kMirrorMagic);
    block().abi = kMirrorAbi;
    block().peer_count = 2;
    block().incoming = 3;
  }
  MirrorBlock& block() { return *reinterpret_cast<MirrorBlock*>(memory_.data()); }
  std::span<const std::byte> bytes() { return std::as_bytes(std::span(memory_)); }

 private:
  std::vector<std::uint64_t> memory_;
};

TEST_F(BlockInMemory, Is_found_when_it_is_complete) {
  EXPECT_EQ(mirror_block_in(bytes()), &block());
}

TEST_F(BlockInMemory, Is_not_one_of_another_version_or_unfinished) {
  block().abi = kMirrorAbi + 1;
  EXPECT_EQ(mirror_block_in(bytes()), nullptr);
  block().abi = kMirrorAbi;
  block().magic.store(0);
  EXPECT_EQ(mirror_block_in(bytes()), nullptr);
}

TEST_F(BlockInMemory, Is_not_one_that_is_cut_off) {
  EXPECT_EQ(mirror_block_in(bytes().first(bytes().size() - sizeof(IncomingRecord))), nullptr);
  EXPECT_EQ(mirror_block_in(bytes().first(sizeof(MirrorBlock) - 1)), nullptr);
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
