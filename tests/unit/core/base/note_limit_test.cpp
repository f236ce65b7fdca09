// SPDX-License-Identifier: Apache-2.0
#include "core/base/note_limit.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace indurop::base {
namespace {

TEST(NoteLimit, A_flood_fills_one_window_and_the_next_entry_has_the_number_of_the_others) {
  NoteLimit limit;
  std::uint64_t entries = 0;
  std::uint64_t refusals = 0;
  const auto refuse = [&](std::int64_t now_ns) {
    const std::uint64_t count = limit.count(now_ns);
    entries += count > 0 ? 1 : 0;
    refusals += count;
  };
  for (std::int64_t i = 0; i < 10'000; ++i) {
    refuse(1 + i);
  }
  EXPECT_EQ(entries, NoteLimit::kMostNotes);
  refuse(NoteLimit::kWindowNs + 2);
  EXPECT_EQ(entries, NoteLimit::kMostNotes + 1);
  EXPECT_EQ(refusals, 10'001U) << "none is lost";
}

}  // namespace
}  // namespace indurop::base
