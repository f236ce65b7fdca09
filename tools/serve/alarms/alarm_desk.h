// SPDX-License-Identifier: Apache-2.0
// Checks the alarms of all boards on its own thread, and keeps their counts for other threads.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "history/alarms/alarm_watch.h"
#include "tools/serve/worker.h"

namespace indurop::serve {

class AlarmDesk {
 public:
  // Starts a check of these boards, unless the previous check is still running. Called by the door's thread.
  void check(std::vector<std::string> boards);
  // May be called by any thread.
  [[nodiscard]] alarms::AlarmCounts counts(const std::string& board) const;
  // Returns one stream message for each board whose alarms changed since the last call. Called by the door's thread.
  std::vector<std::string> news();

 private:
  struct Figures {
    alarms::AlarmCounts counts;
    std::uint64_t revision = 0;
    std::uint64_t reported = 0;
  };
  void check_now(const std::vector<std::string>& boards);

  mutable std::mutex lock_;
  std::map<std::string, Figures, std::less<>> figures_;
  // Used by the worker's thread only.
  std::map<std::string, std::unique_ptr<alarms::AlarmWatch>, std::less<>> watches_;
  std::uint64_t round_ = 0;
  std::string problem_;
  Worker worker_;  // last member, so that its thread ends first
};

}  // namespace indurop::serve
