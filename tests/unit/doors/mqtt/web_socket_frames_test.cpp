// SPDX-License-Identifier: Apache-2.0
// Frames of RFC 6455: its own examples (section 5.7), in pieces, and what a server may not send.

#include <gtest/gtest.h>

#include <random>

#include "doors/mqtt/serve/web_socket.h"

namespace indurop::mqtt {
namespace {

using Kind = FrameParser::Kind;
using std::string_literals::operator""s;

std::vector<FrameParser::Message> parse(const std::string& bytes, std::size_t step) {
  FrameParser sut;
  std::vector<FrameParser::Message> all;
  for (std::size_t at = 0; at < bytes.size(); at += step) {
    EXPECT_TRUE(sut.feed(std::string_view(bytes).substr(at, step), all));
  }
  return all;
}

TEST(WebSocketFrames, Are_those_of_the_standard_in_whatever_pieces) {
  const std::string bytes = "\x81\x05Hello"s + "\x01\x03Hel"s + "\x89\x05Hello"s + "\x80\x02lo"s + "\x82\x7e\x01\x00"s +
                            std::string(256, 'x') + "\x82\x7f\0\0\0\0\0\x01\0\0"s + std::string(65536, 'y') +
                            "\x88\x02\x03\xe8"s;
  for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{1000}, bytes.size()}) {
    const auto all = parse(bytes, step);
    ASSERT_EQ(all.size(), 6U) << step;
    EXPECT_EQ(all[0].bytes, "Hello");
    EXPECT_EQ(all[1].kind, Kind::Ping);  // between two fragments
    EXPECT_EQ(all[2].bytes, "Hello");
    EXPECT_EQ(all[2].kind, Kind::Text);
    EXPECT_EQ(all[3].bytes, std::string(256, 'x'));
    EXPECT_EQ(all[3].kind, Kind::Binary);
    EXPECT_EQ(all[4].bytes.size(), 65536U);
    EXPECT_EQ(all[5].kind, Kind::Close);
  }
}

TEST(WebSocketFrames, Of_a_server_have_no_mask_and_a_known_kind) {
  for (const std::string& wrong :
       {"\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58"s, "\x83\x01x"s, "\x80\x01x"s, "\x01\x01x\x81\x01x"s,
        "\x82\x7f\x7f\xff\xff\xff\xff\xff\xff\xff"s, "\x02\x01x\x80\x7f\xff\xff\xff\xff\xff\xff\xff\xff"s}) {
    FrameParser sut;
    std::vector<FrameParser::Message> all;
    EXPECT_FALSE(sut.feed(wrong, all)) << testing::PrintToString(wrong);
  }
}

TEST(WebSocketFrames, Of_the_client_are_masked) {
  const std::string frame = client_frame(1, "Hello");
  ASSERT_EQ(frame.size(), 11U);
  EXPECT_EQ(frame.substr(0, 2), "\x81\x85");
  std::string text;
  for (std::size_t i = 0; i < 5; ++i) {
    text += static_cast<char>(frame[6 + i] ^ frame[2 + i % 4]);
  }
  EXPECT_EQ(text, "Hello");
  EXPECT_EQ(client_frame(1, std::string(126, 'x')).substr(0, 4), "\x81\xfe\x00\x7e"s);
  EXPECT_EQ(client_frame(1, std::string(65536, 'x')).substr(0, 10), "\x81\xff\0\0\0\0\0\x01\0\0"s);
}

TEST(WebSocketFrames, Random_bytes_do_no_harm) {
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random() % 64, '\0');
    for (char& c : bytes) {
      c = static_cast<char>(random());
    }
    FrameParser sut;
    std::vector<FrameParser::Message> all;
    (void)sut.feed(bytes, all);
    EXPECT_LE(all.size(), bytes.size());
  }
}

}  // namespace
}  // namespace indurop::mqtt
