// SPDX-License-Identifier: Apache-2.0
// Recordings for tests: a file that is away afterwards, its bytes, and all that a reader finds in it.

#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

#include "history/recording/mcap_reader.h"
#include "history/recording/mcap_writer.h"

namespace indurop::recording {

class RecordedFile : public testing::Test {
 protected:
  RecordedFile() { std::filesystem::create_directories(folder); }
  ~RecordedFile() override { std::filesystem::remove_all(folder); }

  // channel, sequence, log time, publish time, bytes
  using Message = std::tuple<int, std::uint32_t, std::uint64_t, std::uint64_t, std::string>;
  struct Found {
    std::vector<Message> messages;
    std::vector<std::string> problems;
  };

  McapWriter writer(const McapOptions& options) const {
    std::filesystem::remove(path);
    auto made = McapWriter::create(path, options);
    EXPECT_TRUE(made.ok());
    return std::move(*made);
  }

  static Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

  static void put(McapWriter& to, const Message& message) {
    const auto& [channel, sequence, log, publish, text] = message;
    const auto written = to.write(static_cast<std::uint16_t>(channel), log, publish, sequence, bytes_of(text));
    ASSERT_TRUE(written.ok()) << written.error().text;
  }

  static Found all(McapReader& reader) {
    Found out;
    while (true) {
      auto next = reader.next();
      if (!next) {
        out.problems.push_back(next.error().text);
      } else if (*next) {
        const McapMessage& m = **next;
        out.messages.emplace_back(m.channel, m.sequence, m.log_time_ns, m.publish_time_ns,
                                  std::string(m.data.view.begin(), m.data.view.end()));
      } else {
        return out;
      }
    }
  }

  [[nodiscard]] std::string content() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put_content(std::string_view bytes) const {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }

  // In memory: a disk takes its time for thousands of small changes.
  const std::filesystem::path folder =
      (std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                 : std::filesystem::temp_directory_path()) /
      ("recording_test_" + std::to_string(::getpid()));
  const std::filesystem::path path = folder / "run.mcap";
};

}  // namespace indurop::recording
