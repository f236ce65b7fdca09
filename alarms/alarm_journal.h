// SPDX-License-Identifier: Apache-2.0
// The history of a node's alarms in its state folder: lines of JSON that are only appended to. It is all there is: who
// reads it from the beginning knows how every alarm stands, also after a kill or a loss of power.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "alarms/alarm_book.h"
#include "base/descriptor.h"

namespace indurop::alarms {

class AlarmJournal {
 public:
  explicit AlarmJournal(const std::string& node);
  AlarmJournal(std::filesystem::path folder, std::size_t most_bytes);

  // Reads what others appended. Any process may do that.
  void refresh();
  [[nodiscard]] const AlarmBook& book() const noexcept { return book_; }

  // Asks what to append, with the newest book in hand while nobody else can append, and brings that to the disk.
  // Returns why that failed, else nothing. What took the file beyond its size is put aside as events.jsonl.1.
  std::string change(const std::function<std::vector<AlarmEntry>(const AlarmBook&)>& decide);

  // The newest `most` entries, oldest first, from before the newest cut too.
  [[nodiscard]] std::vector<AlarmEntry> history(std::size_t most) const;

  // One process at a time looks at the conditions: true if it is this one, from now to the end of this object.
  bool become_watcher();
  // Is there one?
  [[nodiscard]] bool watched() const;

 private:
  std::string append(const std::vector<AlarmEntry>& entries);
  std::string cut();
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "events.jsonl"; }
  [[nodiscard]] std::filesystem::path older() const { return folder_ / "events.jsonl.1"; }

  std::filesystem::path folder_;
  std::size_t most_bytes_;
  AlarmBook book_;
  ino_t inode_ = 0;  // of the file that was read
  off_t read_ = 0;   // so far
  base::Descriptor watching_;
};

}  // namespace indurop::alarms
