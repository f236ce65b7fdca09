// SPDX-License-Identifier: Apache-2.0
// The history of a node's alarms in its state folder: lines of JSON that are only appended to. It is the only storage:
// a process that reads it from the beginning knows the state of every alarm, also after a kill or a loss of power.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/descriptor.h"
#include "history/alarms/alarm_book.h"

namespace indurop::alarms {

class AlarmJournal {
 public:
  explicit AlarmJournal(const std::string& node);
  AlarmJournal(std::filesystem::path folder, std::size_t max_bytes);

  // Reads what other processes have appended. Any process may do that.
  void refresh();
  [[nodiscard]] const AlarmBook& book() const noexcept { return book_; }

  // Calls `decide` with the newest book while no other process can append, appends the entries it returns, and syncs
  // them to the disk. Returns why that failed, else an empty text. A file beyond its maximum size is cut; the old one
  // is kept as events.jsonl.1.
  std::string change(const std::function<std::vector<AlarmEntry>(const AlarmBook&)>& decide);

  // Returns the newest `most` entries, oldest first, including those from before the last cut.
  [[nodiscard]] std::vector<AlarmEntry> history(std::size_t most) const;

  // Only one process at a time evaluates the conditions. Returns true if it is this one, from now until this object is
  // destroyed.
  bool become_watcher();
  // Returns whether a process evaluates the conditions.
  [[nodiscard]] bool watched() const;

 private:
  std::string append(const std::vector<AlarmEntry>& entries);
  std::string cut();
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "events.jsonl"; }
  [[nodiscard]] std::filesystem::path older() const { return folder_ / "events.jsonl.1"; }

  std::filesystem::path folder_;
  std::size_t max_bytes_;
  AlarmBook book_;
  ino_t inode_ = 0;  // inode of the file that was read
  off_t read_ = 0;   // bytes read so far
  base::Descriptor watching_;
};

}  // namespace indurop::alarms
