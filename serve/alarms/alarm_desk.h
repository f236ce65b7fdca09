// SPDX-License-Identifier: Apache-2.0
// Looks at the alarms of all boards on a thread of its own, and knows how many there are for whoever asks.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "alarms/alarm_watch.h"
#include "serve/api/worker.h"

namespace indurop::serve {

class AlarmDesk {
 public:
  // Looks at these boards, unless the look before has not ended. The door's thread.
  void look(std::vector<std::string> boards);
  // Any thread.
  [[nodiscard]] alarms::AlarmCounts counts(const std::string& board) const;
  // A word of the stream for each board whose alarms changed since the last call; the door's thread.
  std::vector<std::string> news();

 private:
  struct Figures {
    alarms::AlarmCounts counts;
    std::uint64_t revision = 0;
    std::uint64_t told = 0;
  };
  void look_now(const std::vector<std::string>& boards);

  mutable std::mutex lock_;
  std::map<std::string, Figures, std::less<>> figures_;
  // Of the worker's thread.
  std::map<std::string, std::unique_ptr<alarms::AlarmWatch>, std::less<>> watches_;
  std::uint64_t round_ = 0;
  std::string problem_;
  Worker worker_;  // ends first
};

}  // namespace indurop::serve
