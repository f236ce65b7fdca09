// SPDX-License-Identifier: Apache-2.0
// Data that are kept: in order, each at least once, whatever ends the program, within the room that is allowed.

#include "doors/mqtt/sparkplug/backlog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace indurop::mqtt {
namespace {

namespace fs = std::filesystem;

class BacklogTest : public testing::Test {
 protected:
  BacklogTest() : folder_(fs::path(testing::TempDir()) / ("backlog_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~BacklogTest() override { fs::remove_all(folder_); }

  Backlog open(std::uint64_t most = 64U << 20U) {
    Backlog backlog = std::move(Backlog::open(folder_, most)).value();
    Payload names;
    Metric& metric = names.metrics.emplace_back();
    metric.name = "press/oil";
    metric.alias = 5;
    backlog.set_names("cell", names);
    return backlog;
  }
  // Data with this number as time and value.
  static Payload data(std::uint64_t number) {
    Payload payload;
    payload.timestamp_ms = number;
    Metric& metric = payload.metrics.emplace_back();
    metric.alias = 5;
    metric.value = number;
    return payload;
  }
  static void add(Backlog& backlog, std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t i = from; i < to; ++i) {
      EXPECT_EQ(backlog.add("cell", data(i)), "");
    }
  }
  // Reads everything, `commit`: and confirms it.
  static std::vector<std::uint64_t> read_all(Backlog& backlog, bool commit, std::uint64_t bytes = 1000) {
    std::vector<std::uint64_t> all;
    for (auto batch = backlog.read(bytes); !batch.empty(); batch = backlog.read(bytes)) {
      for (const auto& one : batch) {
        EXPECT_EQ(one.board, "cell");
        const Metric& metric = one.payload.metrics.at(0);
        EXPECT_EQ(metric.name, "press/oil");
        EXPECT_TRUE(metric.is_historical && !metric.alias);
        EXPECT_EQ(metric.timestamp_ms, one.payload.timestamp_ms);
        EXPECT_EQ(std::get<std::uint64_t>(metric.value), one.payload.timestamp_ms);
        all.push_back(*one.payload.timestamp_ms);
      }
      if (commit) {
        backlog.commit(batch.back().end);
      }
    }
    return all;
  }
  static std::vector<std::uint64_t> numbers(std::uint64_t from, std::uint64_t to) {
    std::vector<std::uint64_t> all;
    for (std::uint64_t i = from; i < to; ++i) {
      all.push_back(i);
    }
    return all;
  }
  [[nodiscard]] std::uint64_t bytes_on_disk() const {
    std::uint64_t all = 0;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      all += entry.file_size();
    }
    return all;
  }

  fs::path folder_;
};

TEST_F(BacklogTest, Returns_everything_in_order_and_leaves_nothing_behind) {
  Backlog sut = open();
  EXPECT_TRUE(sut.is_empty());
  add(sut, 0, 1000);
  EXPECT_FALSE(sut.is_empty());
  EXPECT_EQ(read_all(sut, true), numbers(0, 1000));
  EXPECT_TRUE(sut.is_empty());
  EXPECT_TRUE(fs::is_empty(folder_));
  add(sut, 1000, 1010);
  EXPECT_EQ(read_all(sut, true), numbers(1000, 1010));
}

TEST_F(BacklogTest, What_was_not_confirmed_is_read_again) {
  Backlog sut = open();
  add(sut, 0, 100);
  const auto batch = sut.read(1000);
  sut.commit(batch.at(9).end);
  EXPECT_FALSE(read_all(sut, false).empty());
  sut.rewind();
  EXPECT_EQ(read_all(sut, true), numbers(10, 100));
}

TEST_F(BacklogTest, Outlives_the_program_with_what_was_confirmed) {
  {
    Backlog first = open();
    add(first, 0, 100);
    first.commit(first.read(1000).at(9).end);
  }
  Backlog sut = open();
  add(sut, 100, 200);  // in another file, whose aliases may mean something else
  EXPECT_EQ(read_all(sut, true), numbers(10, 200));
  EXPECT_TRUE(sut.is_empty());
}

TEST_F(BacklogTest, Killed_at_any_byte_it_returns_what_was_complete) {
  {
    Backlog first = open();
    add(first, 0, 20);
  }
  const fs::path file = fs::directory_iterator(folder_)->path();
  std::ifstream in(file, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::size_t before = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    Backlog sut = open();
    const auto read = read_all(sut, true);
    EXPECT_EQ(read, numbers(0, read.size())) << size;
    EXPECT_GE(read.size(), before);
    before = read.size();
    add(sut, 20, 22);
    EXPECT_EQ(read_all(sut, true), numbers(20, 22)) << size;
  }
  EXPECT_EQ(before, 20U);
}

TEST_F(BacklogTest, A_damaged_record_ends_its_file) {
  {
    Backlog first = open();
    add(first, 0, 20);
  }
  const fs::path file = fs::directory_iterator(folder_)->path();
  const auto size = fs::file_size(file);
  std::fstream(file, std::ios::binary | std::ios::in | std::ios::out).seekp(static_cast<std::streamoff>(size / 2))
      << '\x7f';
  Backlog sut = open();
  const auto read = read_all(sut, true);
  EXPECT_EQ(read, numbers(0, read.size()));
  EXPECT_LT(read.size(), 20U);
  EXPECT_FALSE(read.empty());
}

TEST_F(BacklogTest, Keeps_the_newest_within_its_room) {
  constexpr std::uint64_t kRoom = std::uint64_t{1} << 20U;
  Backlog sut = open(kRoom);
  add(sut, 0, 100'000);
  EXPECT_LE(bytes_on_disk(), kRoom + kRoom / 16);
  EXPECT_GT(sut.lost_bytes(), 0U);
  const auto read = read_all(sut, true, 100'000);
  EXPECT_GT(read.size(), 10'000U);
  EXPECT_EQ(read, numbers(100'000 - read.size(), 100'000)) << "no gap up to the last one";
}

TEST_F(BacklogTest, Room_is_made_while_it_is_read) {
  constexpr std::uint64_t kRoom = std::uint64_t{1} << 20U;
  Backlog sut = open(kRoom);
  add(sut, 0, 5'000);
  const auto batch = sut.read(1000);
  add(sut, 5'000, 100'000);
  sut.commit(batch.back().end);  // of a file that is gone
  const auto rest = read_all(sut, true, 100'000);
  EXPECT_EQ(rest, numbers(100'000 - rest.size(), 100'000));
}

TEST_F(BacklogTest, Says_why_it_cannot_keep_anything) {
  Backlog sut = open();
  fs::remove_all(folder_);
  EXPECT_THAT(sut.add("cell", data(1)), testing::HasSubstr("cannot write"));
  std::ofstream(folder_.string()) << "a file";
  EXPECT_FALSE(Backlog::open(folder_, 1).ok());
}

}  // namespace
}  // namespace indurop::mqtt
