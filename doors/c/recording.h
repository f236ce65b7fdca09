// SPDX-License-Identifier: Apache-2.0
// A recording as a C program sees it: variables found by name, which have numbers, and their samples in order of time.

#pragma once

#include <indurop/c.h>
#include <indurop/result.h>

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "doors/c/describe.h"
#include "doors/c/failure.h"
#include "history/recording/mcap_reader.h"

namespace indurop::c {

// A variable of a recording, or a part of one, that was found.
struct RecordedItem {
  Texts texts;
  schema::Place place;
};

struct Sample {
  std::int64_t time_ns = 0;
  std::uint32_t which = 0;  // index of the variable among the selected ones
  std::span<const std::uint8_t> value;
};

}  // namespace indurop::c

struct irp_recording {
 public:
  static indurop::Result<irp_recording*, indurop::c::Failure> open(const std::string& path);

  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  [[nodiscard]] const indurop::recording::Contents& contents() const noexcept { return reader_.contents(); }
  [[nodiscard]] const std::deque<std::string>& damages() const noexcept { return damages_; }

  indurop::Result<std::uint32_t, indurop::c::Failure> find(const std::string& name);
  indurop::Result<const indurop::c::RecordedItem*, indurop::c::Failure> found(std::uint32_t id) const;

  struct Period {
    std::int64_t from_ns = 0;
    std::int64_t to_ns = 0;
  };
  indurop::Result<void, indurop::c::Failure> select(std::span<const std::uint32_t> ids, Period period, bool repeats);
  [[nodiscard]] std::size_t longest_value() const noexcept;  // bytes, of those that are selected
  // Returns false after the last sample. The value is valid until the next call.
  bool next(indurop::c::Sample& to);

 private:
  // A channel of the file.
  struct Channel {
    const indurop::schema::Variable* variable = nullptr;
    std::vector<std::uint32_t> selected;  // indices of the columns that are parts of it
  };
  struct Column {
    const indurop::c::RecordedItem* item = nullptr;
    std::vector<std::uint8_t> value;  // the last one; empty: none yet
  };

  explicit irp_recording(indurop::recording::McapReader reader) : reader_(std::move(reader)) {}
  void find_variables();
  void add_channel(std::uint16_t id, const indurop::recording::McapChannel& about);
  void add_damage(std::string text);
  bool next_message();

  indurop::recording::McapReader reader_;
  std::map<std::string, indurop::schema::Schema> boards_;  // variables by the prefix of their topics: "", "sensor/"
  std::map<std::uint16_t, Channel> channels_;
  std::vector<std::string> names_;
  std::deque<std::string> damages_;             // elements stay where they are
  std::deque<indurop::c::RecordedItem> found_;  // by id; likewise
  std::map<std::string, std::uint32_t> ids_;
  std::vector<Column> columns_;
  Period period_;
  bool repeats_ = false;
  const Channel* message_ = nullptr;  // the channel of the message that is being given out
  std::size_t next_column_ = 0;       // of that channel
  std::int64_t time_ns_ = 0;
  std::vector<std::uint8_t> value_;  // the variable of that message
};
