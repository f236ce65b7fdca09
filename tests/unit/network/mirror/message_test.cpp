// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/simulated/message.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace indurop::mirror {
namespace {

char* text(std::string& of) {
  return of.data();
}

TEST(SimulatedMessage, Carries_a_frame_whole) {
  std::vector<std::uint8_t> data = {1, 2, 3};
  indurop_wire_Frame frame{};
  frame.part = 3;
  frame.layout = 4;
  frame.session = 5;
  frame.update = 6;
  frame.update_sum = 7;
  frame.tick = 8;
  frame.source_time_ns = 9;
  frame.data._length = 3;
  frame.data._buffer = data.data();
  bool came = false;
  EXPECT_TRUE(with_frame(to_bytes(frame), [&](const indurop_wire_Frame& sut) {
    came = true;
    EXPECT_EQ(sut.part, 3U);
    EXPECT_EQ(sut.layout, 4U);
    EXPECT_EQ(sut.session, 5U);
    EXPECT_EQ(sut.update, 6U);
    EXPECT_EQ(sut.update_sum, 7U);
    EXPECT_EQ(sut.tick, 8U);
    EXPECT_EQ(sut.source_time_ns, 9);
    EXPECT_EQ(std::vector<std::uint8_t>(sut.data._buffer, sut.data._buffer + sut.data._length), data);
  }));
  EXPECT_TRUE(came);
}

TEST(SimulatedMessage, Carries_a_catalogue_and_a_beacon_whole) {
  std::string board = "sensor";
  std::string release = "1";
  std::string schema = "{}";
  std::string name = "a::b";
  indurop_wire_CatalogueEntry entry{text(name), 1, 2, 3, 4, 2};
  indurop_wire_Catalogue catalogue{};
  catalogue.board = text(board);
  catalogue.release = text(release);
  catalogue.session = 5;
  catalogue.layout = 6;
  catalogue.entries._length = 1;
  catalogue.entries._buffer = &entry;
  catalogue.schema = text(schema);
  EXPECT_TRUE(with_catalogue(to_bytes(catalogue), [&](const indurop_wire_Catalogue& sut) {
    EXPECT_EQ(sut.board, board);
    EXPECT_EQ(sut.schema, schema);
    EXPECT_EQ(sut.session, 5U);
    ASSERT_EQ(sut.entries._length, 1U);
    EXPECT_EQ(sut.entries._buffer[0].name, name);
    EXPECT_EQ(sut.entries._buffer[0].size, 4U);
    EXPECT_EQ(sut.entries._buffer[0].stream, 2U);
  }));
  indurop_wire_Heard heard{text(name), -7};
  indurop_wire_Beacon beacon{};
  beacon.board = text(board);
  beacon.epoch_ns = 8;
  beacon.synchronised = true;
  beacon.heard._length = 1;
  beacon.heard._buffer = &heard;
  EXPECT_TRUE(with_beacon(to_bytes(beacon), [&](const indurop_wire_Beacon& sut) {
    EXPECT_EQ(sut.board, board);
    EXPECT_EQ(sut.epoch_ns, 8);
    EXPECT_TRUE(sut.synchronised);
    ASSERT_EQ(sut.heard._length, 1U);
    EXPECT_EQ(sut.heard._buffer[0].board, name);
    EXPECT_EQ(sut.heard._buffer[0].delay_ns, -7);
  }));
}

TEST(SimulatedMessage, Cut_off_anywhere_is_none) {
  std::vector<std::uint8_t> data = {1, 2, 3};
  indurop_wire_Frame frame{};
  frame.data._length = 3;
  frame.data._buffer = data.data();
  const std::vector<std::uint8_t> whole = to_bytes(frame);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::span<const std::uint8_t> part(whole.data(), length);
    EXPECT_FALSE(with_frame(part, [](const indurop_wire_Frame&) { ADD_FAILURE(); })) << length;
  }
}

}  // namespace
}  // namespace indurop::mirror
