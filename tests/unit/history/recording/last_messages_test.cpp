// SPDX-License-Identifier: Apache-2.0
// The last messages before a time are those that a reader of the whole file sees last, and chunks that cannot hold one
// are not read.

#include "history/recording/last_messages.h"

#include <algorithm>
#include <fstream>
#include <random>

#include "tests/unit/history/recording/recorded_file.h"

namespace indurop::recording {
namespace {

class LastMessages : public RecordedFile {
 protected:
  // Messages of five channels, of which one is rare; the parts of keys are sequence % 3.
  std::vector<Message> record(std::uint32_t seed) {
    McapWriter to = writer({.chunk_bytes = 400});
    EXPECT_TRUE(to.add_schema("t", "omgidl", "struct t {};").ok());
    for (int i = 0; i < 5; ++i) {
      EXPECT_TRUE(to.add_channel(1, "v" + std::to_string(i), "cdr", {}).ok());
    }
    std::mt19937 random(seed);
    std::vector<Message> all;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const std::uint64_t time = 1000 + i * 10 + random() % 300;  // chunks overlap
      const int channel = i % 97 == 5 ? 5 : 1 + static_cast<int>(random() % 4);
      all.emplace_back(channel, random() % 1000, time, time, std::to_string(i));
      put(to, all.back());
    }
    EXPECT_TRUE(to.close().ok());
    std::stable_sort(all.begin(), all.end(),
                     [](const Message& a, const Message& b) { return std::get<2>(a) < std::get<2>(b); });
    return all;
  }
  static std::uint32_t part_of(std::uint32_t sequence) { return sequence % 3; }
};

TEST_F(LastMessages, Are_those_that_a_reader_of_the_whole_file_sees_last) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const std::vector<Message> all = record(seed);
    const auto reader = McapReader::open(path);
    ASSERT_TRUE(reader.ok());
    std::mt19937 random(seed);
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t before = 900 + random() % 5000;
      std::set<MessageKey> wanted;
      for (int i = 0; i < 6; ++i) {
        const auto part = static_cast<std::uint32_t>(random() % 4);
        wanted.insert({static_cast<std::uint16_t>(1 + random() % 5), part == 3 ? kAnyPart : part});
      }
      std::map<MessageKey, std::string> expected;
      for (const auto& [channel, sequence, time, publish, text] : all) {
        for (const std::uint32_t part : {part_of(sequence), kAnyPart}) {
          if (const MessageKey key(static_cast<std::uint16_t>(channel), part); time < before && wanted.contains(key)) {
            expected[key] = text;
          }
        }
      }
      std::map<MessageKey, std::string> found;
      for (const auto& [key, message] : last_messages(*reader, before, wanted, &part_of)) {
        found[key] = {message.bytes.begin(), message.bytes.end()};
      }
      EXPECT_EQ(found, expected) << seed << " " << before;
    }
  }
}

TEST_F(LastMessages, Do_not_need_the_chunks_of_other_channels) {
  const std::vector<Message> all = record(7);
  const auto whole = McapReader::open(path);
  ASSERT_TRUE(whole.ok());
  std::string bytes = content();
  std::size_t damaged = 0;
  for (const Segment& segment : whole->segments()) {
    if (std::ranges::find(segment.channels, 5) == segment.channels.end()) {
      bytes[segment.offset + segment.length - 1] = static_cast<char>(bytes[segment.offset + segment.length - 1] ^ 0x55);
      ++damaged;
    }
  }
  EXPECT_GT(damaged, 10U);
  put_content(bytes);
  const auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  const auto found = last_messages(*reader, UINT64_MAX, {{5, kAnyPart}}, &part_of);
  const auto last = std::find_if(all.rbegin(), all.rend(), [](const Message& one) { return std::get<0>(one) == 5; });
  ASSERT_EQ(found.size(), 1U);
  const Bytes& text = found.begin()->second.bytes;
  EXPECT_EQ(std::string(text.begin(), text.end()), std::get<4>(*last));
}

}  // namespace
}  // namespace indurop::recording
