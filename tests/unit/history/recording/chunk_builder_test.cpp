// SPDX-License-Identifier: Apache-2.0
#include "history/recording/chunk_builder.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "history/recording/records.h"

namespace indurop::recording {
namespace {

McapMessage message(std::uint16_t channel, std::uint64_t time_ns, const std::vector<std::uint8_t>& cdr) {
  return {channel, 0, time_ns, time_ns, {View(cdr)}};
}

TEST(ChunkBuilder, Has_the_offsets_of_the_example_in_its_header) {
  const std::vector<std::uint8_t> gain(4 + 8);
  const std::vector<std::uint8_t> tick(4 + 4);
  ChunkBuilder chunk;
  chunk.add(message(1, 100, gain));
  chunk.add(message(2, 150, tick));
  chunk.add(message(1, 200, gain));
  using Entries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  EXPECT_EQ(chunk.index_of(1).entries, (Entries{{100, 0}, {200, 82}}));
  EXPECT_EQ(chunk.index_of(2).entries, (Entries{{150, 43}}));
  EXPECT_EQ(chunk.records().size(), 125U);
  EXPECT_EQ(chunk.start_ns(), 100U);
  EXPECT_EQ(chunk.end_ns(), 200U);
}

}  // namespace
}  // namespace indurop::recording
