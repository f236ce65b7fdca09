// SPDX-License-Identifier: Apache-2.0
// The part of a history that is in a recording.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/client/history/history_items.h"
#include "tools/client/history/history_types.h"
#include "tools/client/history/recording_catalog.h"

namespace indurop::tools {

struct RecordedRequest {
  const std::vector<HistoryItem>* items = nullptr;
  std::vector<bool> wanted;   // by item
  TimeSpan span;              // of the history
  std::int64_t shift_ns = 0;  // times of the history minus those in the file
  std::size_t most = 0;       // stops at the first new time after so many values,
  std::size_t messages = 0;   // or after so many messages of the file that are not before `counted_ns`
  std::int64_t counted_ns = 0;
};

// Finds the values and gaps of the wanted items. Damaged parts of the file, and runs that its recorder lost, are gaps.
// Not real-time safe.
HistoryFindings read_recorded(const RecordedNode& file, const RecordedRequest& request);

}  // namespace indurop::tools
