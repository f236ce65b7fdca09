// SPDX-License-Identifier: Apache-2.0
#include "core/base/web_socket_frames.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace indurop::base {
namespace {

using std::string_literals::operator""s;
using Message = std::pair<FrameKind, std::string>;

// A frame of a client, written another way than the server's own are.
std::string frame(unsigned first, const std::string& data, bool masked = true) {
  std::string bytes(1, static_cast<char>(first));
  const unsigned mark = masked ? 0x80 : 0;
  if (data.size() < 126) {
    bytes += static_cast<char>(mark | data.size());
  } else if (data.size() < 65536) {
    bytes +=
        {static_cast<char>(mark | 126), static_cast<char>(data.size() / 256), static_cast<char>(data.size() % 256)};
  } else {
    bytes += static_cast<char>(mark | 127);
    for (int shift = 56; shift >= 0; shift -= 8) {
      bytes += static_cast<char>((static_cast<std::uint64_t>(data.size()) >> shift) % 256);
    }
  }
  const std::string key = "\x01\xfe\x37\x80";
  bytes += masked ? key : "";
  for (std::size_t i = 0; i < data.size(); ++i) {
    bytes += static_cast<char>(masked ? data[i] ^ key[i % 4] : data[i]);
  }
  return bytes;
}

int feed(FrameReader& reader, const std::string& bytes, std::vector<Message>& taken, std::size_t piece) {
  int code = 0;
  for (std::size_t at = 0; at < bytes.size() && code == 0; at += piece) {
    code = reader.feed(bytes.substr(at, piece), [&taken](FrameKind kind, const std::string& data) {
      taken.emplace_back(kind, data);
      return 0;
    });
  }
  return code;
}

int code_of(const std::string& bytes, std::size_t most = 1000) {
  FrameReader reader(FrameSender::Client, most);
  std::vector<Message> taken;
  return feed(reader, bytes, taken, bytes.size());
}

TEST(Frames, Give_the_same_messages_in_whatever_parts_they_come) {
  const std::string large(70000, 'x');
  const std::string bytes = frame(0x81, "hello") + frame(0x01, "one ") + frame(0x89, "ping") + frame(0x00, "") +
                            frame(0x80, "two") + frame(0x81, "") + frame(0x81, large) + frame(0x8a, "") +
                            frame(0x81, std::string(126, 'y')) + frame(0x88, "\x03\xe8");
  const std::vector<Message> expected{{FrameKind::Text, "hello"},
                                      {FrameKind::Ping, "ping"},
                                      {FrameKind::Text, "one two"},
                                      {FrameKind::Text, ""},
                                      {FrameKind::Text, large},
                                      {FrameKind::Pong, ""},
                                      {FrameKind::Text, std::string(126, 'y')},
                                      {FrameKind::Close, "\x03\xe8"}};
  for (const std::size_t piece : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{4096}, bytes.size()}) {
    FrameReader reader(FrameSender::Client, 100000);
    std::vector<Message> taken;
    EXPECT_EQ(feed(reader, bytes, taken, piece), 0);
    EXPECT_EQ(taken, expected) << piece;
  }
}

TEST(Frames, Without_a_mask_are_a_fault_of_the_protocol) {
  for (const unsigned first : {0x81U, 0x01U, 0x89U, 0x88U}) {
    EXPECT_EQ(code_of(frame(first, "x", false)), close_code::kProtocol) << first;
    EXPECT_EQ(code_of(frame(first, "", false)), close_code::kProtocol) << first;
  }
}

TEST(Frames, That_are_none_are_faults_of_the_protocol) {
  for (const unsigned first : {0x83U, 0x8bU, 0x8fU, 0xc1U, 0xa1U, 0x91U, 0x80U, 0x09U, 0x08U}) {
    EXPECT_EQ(code_of(frame(first, "x")), close_code::kProtocol) << first;
  }
  EXPECT_EQ(code_of(frame(0x89, std::string(126, 'x'))), close_code::kProtocol) << "a ping of more than 125 bytes";
  EXPECT_EQ(code_of(frame(0x01, "a") + frame(0x81, "b")), close_code::kProtocol) << "another message within one";
  EXPECT_EQ(code_of(std::string("\x81\xfe\x00\x05", 4) + "keyshello"), close_code::kProtocol)
      << "a length that is too long";
  EXPECT_EQ(code_of(frame(0x82, "x")), close_code::kNotUnderstood);
}

TEST(Frames, Have_a_limit_in_one_and_in_many_parts) {
  EXPECT_EQ(code_of(frame(0x81, std::string(1000, 'x'))), 0);
  EXPECT_EQ(code_of(frame(0x81, std::string(1001, 'x'))), close_code::kTooLarge);
  EXPECT_EQ(code_of(frame(0x01, std::string(999, 'x')) + frame(0x80, "xx")), close_code::kTooLarge);
  EXPECT_EQ(code_of(std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff", 10) + "keys"), close_code::kTooLarge);
}

TEST(Frames, Of_the_server_are_read_back_by_a_client) {
  for (const std::size_t size : {0U, 1U, 125U, 126U, 65535U, 65536U}) {
    const std::string expected = frame(0x81, std::string(size, 'x'), false);
    EXPECT_EQ(frame_header(FrameKind::Text, size) + std::string(size, 'x'), expected) << size;
  }
  EXPECT_EQ(close_frame(1002), frame(0x88, "\x03\xea", false));
  EXPECT_EQ(close_frame(0), frame(0x88, "", false));
}

std::vector<Message> from_server(const std::string& bytes, std::size_t piece, int& code) {
  FrameReader reader(FrameSender::Server, std::size_t{64} << 20U);
  std::vector<Message> taken;
  code = feed(reader, bytes, taken, piece);
  return taken;
}

// The examples of RFC 6455, 5.7.
TEST(FramesOfServers, Are_those_of_the_standard_in_whatever_pieces) {
  const std::string bytes = "\x81\x05Hello"s + "\x01\x03Hel"s + "\x89\x05Hello"s + "\x80\x02lo"s + "\x82\x7e\x01\x00"s +
                            std::string(256, 'x') + "\x82\x7f\0\0\0\0\0\x01\0\0"s + std::string(65536, 'y') +
                            "\x88\x02\x03\xe8"s;
  const std::vector<Message> expected{{FrameKind::Text, "Hello"},
                                      {FrameKind::Ping, "Hello"},  // between two fragments
                                      {FrameKind::Text, "Hello"},
                                      {FrameKind::Binary, std::string(256, 'x')},
                                      {FrameKind::Binary, std::string(65536, 'y')},
                                      {FrameKind::Close, "\x03\xe8"}};
  for (const std::size_t piece : {std::size_t{1}, std::size_t{3}, std::size_t{1000}, bytes.size()}) {
    int code = 0;
    EXPECT_EQ(from_server(bytes, piece, code), expected) << piece;
    EXPECT_EQ(code, 0);
  }
}

TEST(FramesOfServers, Have_no_mask_and_a_known_kind) {
  for (const std::string& wrong :
       {"\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58"s, "\x83\x01x"s, "\x80\x01x"s, "\x01\x01x\x81\x01x"s,
        "\x82\x7f\x7f\xff\xff\xff\xff\xff\xff\xff"s, "\x02\x01x\x80\x7f\xff\xff\xff\xff\xff\xff\xff\xff"s}) {
    int code = 0;
    (void)from_server(wrong, wrong.size(), code);
    EXPECT_NE(code, 0) << testing::PrintToString(wrong);
  }
}

TEST(Frames, Of_a_client_are_masked) {
  EXPECT_EQ(masked_frame(FrameKind::Text, "Hello", {0x37, 0xfa, 0x21, 0x3d}),
            "\x81\x85\x37\xfa\x21\x3d\x7f\x9f\x4d\x51\x58"s);
  EXPECT_EQ(masked_frame(FrameKind::Text, std::string(126, 'x'), {}).substr(0, 4), "\x81\xfe\x00\x7e"s);
  EXPECT_EQ(masked_frame(FrameKind::Text, std::string(65536, 'x'), {}).substr(0, 10), "\x81\xff\0\0\0\0\0\x01\0\0"s);
}

TEST(Frames, Any_bytes_are_survived) {
  std::mt19937 random(1);  // NOLINT: the same each time
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    for (auto length = random() % 60; length > 0; --length) {
      bytes += static_cast<char>(random() % 3 == 0 ? 0x80 | random() % 3 : random());
    }
    int code = 0;
    EXPECT_LE(from_server(bytes, bytes.size(), code).size(), bytes.size());
    code = code_of(bytes, 20);
    EXPECT_TRUE(code == 0 || code == 1002 || code == 1003 || code == 1009) << code;
  }
}

}  // namespace
}  // namespace indurop::base
