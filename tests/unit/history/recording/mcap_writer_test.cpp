// SPDX-License-Identifier: Apache-2.0
// What a recording holds at every moment of its making.

#include "history/recording/mcap_writer.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <string>

#include "history/recording/crc32.h"
#include "tests/unit/history/recording/recorded_file.h"

namespace indurop::recording {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// The file grows no further than this while it lives.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    (void)std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

class Writer : public RecordedFile {
 protected:
  static void declare(McapWriter& to) {
    ASSERT_EQ(*to.add_schema("a::t", "omgidl", "struct t {};"), 1);
    ASSERT_EQ(*to.add_channel(1, "a::v", "cdr", {{"unit", "mm"}}), 1);
    ASSERT_EQ(*to.add_channel(0, "a::w", "cdr", {}), 2);
  }
};

TEST(Crc32, Is_that_of_zip) {
  const std::string text = "The quick brown fox jumps over the lazy dog";
  const Bytes bytes(text.begin(), text.end());
  EXPECT_EQ(crc32(bytes), 0x414FA339U);
  EXPECT_EQ(crc32(View(bytes).subspan(11), crc32(View(bytes).first(11))), 0x414FA339U);
  EXPECT_EQ(crc32({}), 0U);
}

TEST_F(Writer, Syncing_changes_nothing_and_may_still_go_on_at_the_end) {
  McapWriter sut = writer({});
  declare(sut);
  for (std::uint32_t i = 0; i < 50; ++i) {
    put(sut, {1, i, i, i, "one"});
    ASSERT_TRUE(sut.flush().ok());
    ASSERT_TRUE(sut.begin_sync().ok());
  }
  ASSERT_TRUE(sut.close().ok());
  auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(all(*reader).messages.size(), 50U);
}

TEST_F(Writer, A_closed_file_says_what_it_holds) {
  McapWriter sut = writer({});
  declare(sut);
  ASSERT_TRUE(sut.attach({5, 6, "module.xml", "application/xml"}, bytes_of("<module/>")).ok());
  put(sut, {1, 7, 100, 90, "one"});
  put(sut, {2, 8, 50, 40, "two"});
  ASSERT_TRUE(sut.metadata("board", {{"name", "left"}, {"release", "1.0"}}).ok());
  ASSERT_TRUE(sut.close().ok());

  auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  const Contents& contents = reader->contents();
  EXPECT_TRUE(contents.has_summary);
  EXPECT_TRUE(contents.damages.empty());
  EXPECT_EQ(contents.header.profile, "indurop");
  EXPECT_EQ(contents.schemas.at(1), (McapSchema{1, "a::t", "omgidl", "struct t {};"}));
  EXPECT_EQ(contents.channels.at(1), (McapChannel{1, 1, "a::v", "cdr", {{"unit", "mm"}}}));
  ASSERT_EQ(contents.attachments.size(), 1U);
  EXPECT_EQ(contents.attachments[0].name, "module.xml");
  EXPECT_EQ(*reader->attachment(contents.attachments[0]), bytes_of("<module/>"));
  ASSERT_EQ(contents.metadata.size(), 1U);
  EXPECT_EQ(reader->metadata(contents.metadata[0])->values.at("name"), "left");
  EXPECT_EQ(all(*reader).messages, (std::vector<Message>{{2, 8, 50, 40, "two"}, {1, 7, 100, 90, "one"}}));
}

TEST_F(Writer, A_chunk_is_in_the_file_when_it_is_old_or_large_enough) {
  McapWriter sut = writer({.chunk_bytes = 1000, .chunk_time = 1s});
  declare(sut);
  const std::uint64_t begin = sut.size();
  put(sut, {1, 1, 10, 10, "first"});
  put(sut, {1, 2, 10 + 999'999'999, 0, "same chunk"});
  EXPECT_EQ(sut.size(), begin);
  put(sut, {1, 3, 10 + 1'000'000'000, 0, "next chunk"});
  const std::uint64_t one = sut.size();
  EXPECT_GT(one, begin);
  put(sut, {1, 4, 10 + 1'000'000'000, 0, std::string(1000, 'x')});
  EXPECT_EQ(sut.size(), one);
  put(sut, {1, 5, 10 + 1'000'000'000, 0, "third chunk"});
  EXPECT_GT(sut.size(), one);

  // Nobody closed the file: that of a killed program.
  auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  EXPECT_FALSE(reader->contents().has_summary);
  ASSERT_EQ(reader->contents().damages.size(), 1U);
  EXPECT_THAT(reader->contents().damages[0].text, HasSubstr("the file was not closed"));
  EXPECT_EQ(all(*reader).messages.size(), 4U);
  ASSERT_TRUE(sut.flush().ok());
  auto later = McapReader::open(path);
  EXPECT_EQ(all(*later).messages.size(), 5U);
}

TEST_F(Writer, A_full_disk_is_reported_and_nothing_is_lost_when_there_is_space_again) {
  McapWriter sut = writer({.chunk_bytes = 500, .compress = false});
  declare(sut);
  put(sut, {1, 1, 1, 1, std::string(600, 'a')});
  {
    const SmallDisk disk(sut.size() + 300);
    for (int i = 0; i < 3; ++i) {
      const auto written = sut.write(1, 2, 2, 2, bytes_of("b"));
      ASSERT_FALSE(written.ok());
      EXPECT_EQ(written.error().text, "cannot write " + path.string() + ": File too large");
    }
    EXPECT_FALSE(sut.attach({0, 0, "a", "b"}, Bytes(1000)).ok());
    EXPECT_FALSE(sut.metadata("a", {{"b", std::string(1000, 'c')}}).ok());
    EXPECT_FALSE(sut.add_schema("s", "omgidl", std::string(1000, 'c')).ok());
    EXPECT_FALSE(sut.add_channel(0, std::string(1000, 'c'), "cdr", {}).ok());
    EXPECT_FALSE(sut.close().ok());
    EXPECT_EQ(std::filesystem::file_size(path), sut.size());
  }
  put(sut, {1, 2, 2, 2, "b"});
  ASSERT_TRUE(sut.close().ok());
  auto reader = McapReader::open(path);
  ASSERT_TRUE(reader->contents().has_summary);
  EXPECT_EQ(reader->contents().channels.size(), 2U);
  EXPECT_TRUE(reader->contents().attachments.empty());
  EXPECT_EQ(all(*reader).messages.size(), 2U);
}

TEST_F(Writer, What_it_cannot_write_is_refused) {
  McapWriter sut = writer({});
  EXPECT_EQ(McapWriter::create(path, {}).error().text,
            path.string() + " exists already; remove it, or give another name");
  EXPECT_THAT(McapWriter::create(folder / "no" / "run.mcap", {}).error().text, HasSubstr("No such file or directory"));
  EXPECT_THAT(sut.write(1, 0, 0, 0, {}).error().text, HasSubstr("there is no channel 1"));
  EXPECT_THAT(sut.add_channel(1, "t", "cdr", {}).error().text, HasSubstr("there is no schema 1"));
  declare(sut);
  EXPECT_FALSE(sut.write(3, 0, 0, 0, {}).ok());
  EXPECT_THAT(sut.write(1, 0, 0, 0, Bytes(kMaxMessageBytes + 1)).error().text, HasSubstr("too large"));
}

}  // namespace
}  // namespace indurop::recording
