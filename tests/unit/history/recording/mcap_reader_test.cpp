// SPDX-License-Identifier: Apache-2.0
// Whatever happened to a recording, what is whole in it is read, and the rest is named.

#include "history/recording/mcap_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "history/recording/record_bytes.h"
#include "tests/unit/history/recording/recorded_file.h"

namespace indurop::recording {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Reader : public RecordedFile {
 protected:
  // A recording of `count` messages in chunks of some messages each. `ends`: where each chunk ends in the file; `kept`:
  // how many messages there are up to there.
  void record(int count, bool compress) {
    McapWriter to = writer({.chunk_bytes = 300, .compress = compress});
    ASSERT_TRUE(to.add_schema("t", "omgidl", "struct t {};").ok());
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(to.add_channel(1, "v" + std::to_string(i), "cdr", {}).ok());
    }
    begin = to.size();
    std::mt19937 random(4);
    for (int i = 0; i < count; ++i) {
      const std::uint64_t before = to.size();
      const std::uint64_t time = 1000 + static_cast<std::uint64_t>(i) * 10 + random() % 100;
      const Message message{1 + static_cast<int>(random() % 3), static_cast<std::uint32_t>(i), time, time - 5,
                            std::string(random() % 60, static_cast<char>('a' + i % 26))};
      put(to, message);
      if (to.size() != before) {
        ends.push_back(to.size());
        kept.push_back(written.size());
      }
      written.push_back(message);
    }
    ASSERT_TRUE(to.flush().ok());
    ends.push_back(to.size());
    kept.push_back(written.size());
    ASSERT_TRUE(to.attach({1, 2, "a.txt", "text/plain"}, bytes_of("attached")).ok());
    ASSERT_TRUE(to.metadata("m", {{"k", "v"}}).ok());
    ASSERT_TRUE(to.close().ok());
  }

  static std::vector<Message> in_time(std::vector<Message> messages) {
    std::stable_sort(messages.begin(), messages.end(),
                     [](const Message& a, const Message& b) { return std::get<2>(a) < std::get<2>(b); });
    return messages;
  }
  [[nodiscard]] std::vector<Message> first(std::size_t count) const {
    return in_time({written.begin(), written.begin() + static_cast<std::ptrdiff_t>(count)});
  }

  // Done twice, the byte is as before.
  void change(std::size_t at) const {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(static_cast<std::streamoff>(at));
    const int byte = file.get();
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(byte ^ 0x41));
  }

  void cut_everywhere() {
    const std::string whole = content();
    ASSERT_FALSE(ends.empty());
    for (std::size_t size = whole.size() - 1; size > 0; --size) {
      std::filesystem::resize_file(path, size);
      auto reader = McapReader::open(path);
      ASSERT_TRUE(reader.ok() || size < begin) << size;
      if (!reader) {
        ASSERT_THAT(reader.error().text, HasSubstr(path.string() + ": byte "));
        continue;
      }
      ASSERT_FALSE(reader->contents().has_summary);
      ASSERT_FALSE(reader->contents().damages.empty()) << size;
      // The message indexes behind a chunk may be cut, the chunk itself not.
      std::size_t chunks = 0;
      while (chunks < ends.size() && ends[chunks] <= size) {
        ++chunks;
      }
      const Found found = all(*reader);
      ASSERT_THAT(found.problems, IsEmpty()) << size;
      const std::vector<Message> least = first(chunks == 0 ? 0 : kept[chunks - 1]);
      const std::vector<Message> most = first(chunks < kept.size() ? kept[chunks] : written.size());
      ASSERT_TRUE(found.messages == least || found.messages == most) << size << " " << found.messages.size();
    }
  }

  std::uint64_t begin = 0;
  std::vector<std::uint64_t> ends;
  std::vector<std::size_t> kept;
  std::vector<Message> written;
};

TEST_F(Reader, Messages_come_in_the_order_of_time_whatever_their_chunk) {
  for (const bool compress : {false, true}) {
    written.clear();
    record(500, compress);
    auto reader = McapReader::open(path);
    ASSERT_TRUE(reader->contents().has_summary);
    EXPECT_EQ(all(*reader).messages, in_time(written));
    reader->seek(0);
    EXPECT_EQ(all(*reader).messages, in_time(written));
    const std::uint64_t from = 3456;
    reader->seek(from);
    std::vector<Message> later = in_time(written);
    std::erase_if(later, [](const Message& each) { return std::get<2>(each) < from; });
    EXPECT_EQ(all(*reader).messages, later);
    const std::uint64_t until = 4567;
    reader->seek(from);
    std::vector<std::uint64_t> times;
    EXPECT_THAT(reader->each([&](const McapMessage& one) { times.push_back(one.log_time_ns); }, until), IsEmpty());
    std::vector<std::uint64_t> between;
    for (const Message& one : later) {
      if (std::get<2>(one) <= until) {
        between.push_back(std::get<2>(one));
      }
    }
    EXPECT_EQ(times, between);
  }
}

TEST_F(Reader, A_file_cut_anywhere_gives_all_whole_chunks) {
  record(30, true);
  cut_everywhere();
}

TEST_F(Reader, An_uncompressed_file_cut_anywhere_gives_all_whole_chunks) {
  record(20, false);
  cut_everywhere();
}

TEST_F(Reader, A_byte_changed_anywhere_is_noticed_or_does_no_harm) {
  record(30, true);
  const std::string whole = content();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    change(at);
    auto reader = McapReader::open(path);
    if (reader) {
      const Found found = all(*reader);
      const bool reported = !found.problems.empty() || !reader->contents().damages.empty();
      ASSERT_TRUE(reported || found.messages == in_time(written)) << at;
      for (const McapAttachmentIndex& each : reader->contents().attachments) {
        const auto bytes = reader->attachment(each);
        ASSERT_TRUE(reported || !bytes.ok() || *bytes == bytes_of("attached")) << at;
      }
      for (const McapMetadataIndex& each : reader->contents().metadata) {
        (void)reader->metadata(each);
      }
    }
    change(at);
  }
}

TEST_F(Reader, A_damaged_chunk_is_named_and_passed_over) {
  record(60, false);
  std::string bytes = content();
  const std::size_t place = bytes.find("aaaaaaa");
  ASSERT_NE(place, std::string::npos);
  bytes[place] = 'b';
  put_content(bytes);
  auto reader = McapReader::open(path);
  const Found found = all(*reader);
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_THAT(found.problems[0], HasSubstr(path.string() + ": byte " + std::to_string(begin)));
  EXPECT_THAT(found.problems[0], HasSubstr("a damaged chunk: its CRC is"));
  EXPECT_EQ(found.messages, in_time({written.begin() + static_cast<std::ptrdiff_t>(kept[0]), written.end()}));
  // The same without a summary.
  put_content(bytes.substr(0, ends.back()));
  reader = McapReader::open(path);
  EXPECT_EQ(reader->contents().damages.size(), 2U);
  EXPECT_THAT(reader->contents().damages[0].text, HasSubstr("a damaged chunk: its CRC is"));
  EXPECT_EQ(all(*reader).messages.size(), written.size() - kept[0]);
}

TEST_F(Reader, Messages_outside_of_chunks_and_other_writers_orders_are_read) {
  Bytes file(kMagic.begin(), kMagic.end());
  append_record(file, McapHeader{"", "another writer"});
  append_record(file, McapChannel{9, 0, "x", "json", {}});
  const Bytes data = bytes_of("{}");
  for (const std::uint64_t time : {30U, 10U, 20U}) {
    append_record(file, McapMessage{9, 0, time, time, {data}});
  }
  Bytes records;
  append_record(records, McapSchema{4, "s", "jsonschema", "{}"});
  append_record(records, McapChannel{8, 4, "y", "json", {}});
  append_record(records, McapMessage{8, 0, 15, 15, {data}});
  append_record(file, McapChunk{15, 15, records.size(), 0, "", {records}});
  const Bytes unknown{0x90, 3, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3};
  file.insert(file.end(), unknown.begin(), unknown.end());
  append_record(file, McapDataEnd{});
  append_record(file, McapFooter{});
  file.insert(file.end(), kMagic.begin(), kMagic.end());
  put_content({reinterpret_cast<const char*>(file.data()), file.size()});

  auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  EXPECT_THAT(reader->contents().damages, IsEmpty());
  EXPECT_EQ(reader->contents().channels.size(), 2U);
  const Found found = all(*reader);
  EXPECT_THAT(found.problems, IsEmpty());
  std::vector<std::uint64_t> times;
  for (const Message& message : found.messages) {
    times.push_back(std::get<2>(message));
  }
  EXPECT_THAT(times, ElementsAre(10, 15, 20, 30));
}

TEST_F(Reader, Chunks_that_others_compressed_are_read) {
  for (const auto& [name, times] : {std::pair("lz4.mcap", std::vector<std::uint64_t>{10, 20, 30}),
                                    std::pair("no_crc.mcap", std::vector<std::uint64_t>{10, 10, 20, 20, 30, 30})}) {
    auto reader = McapReader::open(std::filesystem::path(RECORDING_CORPUS) / name);
    ASSERT_TRUE(reader.ok()) << reader.error().text;
    EXPECT_THAT(reader->contents().damages, IsEmpty());
    std::vector<std::uint64_t> found;
    for (const Message& message : all(*reader).messages) {
      found.push_back(std::get<2>(message));
      EXPECT_EQ(std::get<4>(message), "{}");
    }
    EXPECT_EQ(found, times) << name;
  }
}

TEST_F(Reader, What_is_no_recording_is_refused) {
  EXPECT_THAT(McapReader::open(folder / "no.mcap").error().text, HasSubstr("No such file or directory"));
  EXPECT_THAT(McapReader::open(folder).error().text, HasSubstr("it is a directory"));
  put_content("");
  EXPECT_THAT(McapReader::open(path).error().text, HasSubstr("byte 0: this is not a recording"));
  put_content("#include <something that is long enough>");
  EXPECT_THAT(McapReader::open(path).error().text, HasSubstr("byte 0: this is not a recording"));
}

}  // namespace
}  // namespace indurop::recording
