// SPDX-License-Identifier: Apache-2.0
// Texts in pieces: complete, begun again, missing, and too long.

#include "deploy/link/text_pieces.h"

#include <gtest/gtest.h>

#include <string>

namespace indurop::deploy {
namespace {

constexpr std::size_t kMost = 3 * DeployLink::kChunk;

BlobChunk piece(std::uint64_t offset, std::size_t size, char content) {
  BlobChunk chunk;
  chunk.offset = offset;
  chunk.data.assign(size, static_cast<std::uint8_t>(content));
  return chunk;
}

TEST(TextPieces, Are_whole_with_one_that_is_not_full) {
  TextPieces sut(kMost);
  EXPECT_TRUE(sut.take(piece(0, DeployLink::kChunk, 'a')));
  EXPECT_FALSE(sut.done());
  EXPECT_FALSE(sut.take(piece(5, 1, 'x'))) << "not the next one";
  EXPECT_TRUE(sut.take(piece(DeployLink::kChunk, 0, 'b')));
  EXPECT_TRUE(sut.whole());
  EXPECT_EQ(sut.text(), std::string(DeployLink::kChunk, 'a'));
}

TEST(TextPieces, Begin_again_until_they_are_whole) {
  TextPieces sut(kMost);
  EXPECT_TRUE(sut.take(piece(0, DeployLink::kChunk, 'a')));
  EXPECT_TRUE(sut.take(piece(0, 3, 'b')));
  EXPECT_EQ(sut.text(), "bbb");
  EXPECT_FALSE(sut.take(piece(0, 2, 'c'))) << "a late answer to an earlier request";
  EXPECT_TRUE(sut.whole());
  EXPECT_EQ(sut.text(), "bbb");
}

TEST(TextPieces, Are_done_but_not_whole_if_there_is_no_such_text) {
  TextPieces sut(kMost);
  BlobChunk none = piece(0, 0, 'a');
  none.missing = true;
  EXPECT_TRUE(sut.take(none));
  EXPECT_TRUE(sut.done());
  EXPECT_FALSE(sut.whole());
}

TEST(TextPieces, Are_not_taken_beyond_a_size) {
  TextPieces sut(kMost);
  for (std::uint64_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(sut.take(piece(i * DeployLink::kChunk, DeployLink::kChunk, 'a')));
  }
  EXPECT_FALSE(sut.take(piece(3 * DeployLink::kChunk, 1, 'a')));
  EXPECT_FALSE(sut.done());
}

}  // namespace
}  // namespace indurop::deploy
