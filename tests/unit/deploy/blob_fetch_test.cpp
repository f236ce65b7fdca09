// SPDX-License-Identifier: Apache-2.0
// Pieces of a file: asked for in a window, kept in order, asked for again.

#include "deploy/transaction/blob_fetch.h"

#include <gtest/gtest.h>

namespace indurop::deploy {
namespace {

constexpr std::uint64_t kWindow = BlobFetch::kWindow;

rt::MonoTime at(std::int64_t ns) {
  return rt::mono_time(ns);
}

TEST(BlobFetch, A_small_file_is_asked_for_once) {
  BlobFetch sut(100, 0);
  const auto range = sut.ask(at(0));
  ASSERT_TRUE(range);
  EXPECT_EQ(range->offset, 0U);
  EXPECT_EQ(range->length, 100U);
  EXPECT_TRUE(range->restart);
  EXPECT_FALSE(sut.ask(at(1)));
  EXPECT_TRUE(sut.take(0, 60, at(1)));
  EXPECT_FALSE(sut.ask(at(2)));
  EXPECT_TRUE(sut.take(60, 40, at(2)));
  EXPECT_TRUE(sut.complete());
  EXPECT_FALSE(sut.ask(at(3)));
}

TEST(BlobFetch, The_window_moves_on_when_half_of_it_has_come) {
  BlobFetch sut(10 * kWindow, 0);
  ASSERT_EQ(sut.ask(at(0))->length, kWindow);
  ASSERT_TRUE(sut.take(0, kWindow / 2 - 1, at(0)));
  EXPECT_FALSE(sut.ask(at(0)));
  ASSERT_TRUE(sut.take(kWindow / 2 - 1, 1, at(0)));
  const auto more = sut.ask(at(0));
  ASSERT_TRUE(more);
  EXPECT_EQ(more->offset, kWindow);
  EXPECT_EQ(more->length, kWindow / 2);
  EXPECT_FALSE(more->restart);
}

TEST(BlobFetch, No_more_is_under_way_than_there_is_room_for) {
  BlobFetch sut(1000, 0, 100);
  EXPECT_EQ(sut.ask(at(0))->length, 100U);
  ASSERT_TRUE(sut.take(0, 60, at(0)));
  const auto more = sut.ask(at(0));
  ASSERT_TRUE(more);
  EXPECT_EQ(more->offset, 100U);
  EXPECT_EQ(more->length, 60U);
}

TEST(BlobFetch, What_is_there_already_is_not_asked_for) {
  BlobFetch sut(100, 30);
  EXPECT_EQ(sut.ask(at(0))->offset, 30U);
  EXPECT_TRUE(BlobFetch(100, 100).complete());
  EXPECT_TRUE(BlobFetch(0, 0).complete());
}

TEST(BlobFetch, Pieces_out_of_order_or_too_long_are_dropped) {
  BlobFetch sut(100, 0);
  (void)sut.ask(at(0));
  EXPECT_FALSE(sut.take(10, 10, at(0)));
  EXPECT_FALSE(sut.take(0, 101, at(0)));
  EXPECT_FALSE(sut.take(0, 0, at(0)));
  EXPECT_TRUE(sut.take(0, 50, at(0)));
  EXPECT_FALSE(sut.take(0, 50, at(0)));
  EXPECT_EQ(sut.have(), 50U);
}

TEST(BlobFetch, Silence_asks_again_from_where_it_is) {
  BlobFetch sut(100, 0);
  (void)sut.ask(at(0));
  ASSERT_TRUE(sut.take(0, 40, at(10)));
  EXPECT_FALSE(sut.ask(at(10 + BlobFetch::kPatience.count())));
  const auto again = sut.ask(at(11 + BlobFetch::kPatience.count()));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->offset, 40U);
  EXPECT_EQ(again->length, 60U);
  EXPECT_TRUE(again->restart);
  EXPECT_FALSE(sut.ask(at(12 + BlobFetch::kPatience.count())));
}

}  // namespace
}  // namespace indurop::deploy
