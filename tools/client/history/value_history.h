// SPDX-License-Identifier: Apache-2.0
// The values of a node's variables over time, from its tape and from recordings of it, in pages: however long the time,
// a page takes a bounded number of values and a bounded part of the recordings, except that a file without a summary,
// because its recorder still writes, is read whole. A page that follows does not look in recordings for what the tape
// has. Only reads: the node is not affected. Not real-time safe; one thread at a time.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "store/operate/item.h"
#include "store/vars/store.h"
#include "tools/client/history/history_page.h"
#include "tools/client/history/recording_catalog.h"

namespace indurop::tools {

inline constexpr std::size_t kMostHistoryItems = 64;
inline constexpr std::size_t kMostHistoryValues = 10'000;
inline constexpr std::size_t kMostHistoryBytes = 1'000'000;      // of a page's values
inline constexpr std::size_t kMostHistoryMessages = 300'000;     // of recordings, for a page
inline constexpr std::int64_t kHistoryRunUpNs = 10'000'000'000;  // how far before the history recordings are read
inline constexpr std::int64_t kHistoryFromNow = INT64_MAX;  // begin of a history: the time up to which all is known

struct HistoryRequest {
  std::vector<operate::Item> items;  // of the store; at most kMostHistoryItems
  TimeSpan span;
  std::size_t most = 1000;                  // values of a page, at most kMostHistoryValues
  std::optional<HistoryPosition> position;  // where the page before it ended
  bool follow = false;                      // there is always a next page, with what is not known yet
};

class ValueHistory {
 public:
  // `folder`: recordings in addition to the black boxes; may be empty.
  explicit ValueHistory(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // The tape is preferred to recordings, and of these the one that begins first. The page never reaches beyond the time
  // up to which the runs of the node have ended.
  HistoryPage read(const std::string& node, const vars::Store& store, const HistoryRequest& request);

 private:
  std::int64_t real_minus_node_of(const std::string& node, const vars::Store& store);

  std::filesystem::path folder_;
  RecordingCatalog catalog_;
  std::map<std::string, std::int64_t> real_minus_node_ns_;  // by node
};

}  // namespace indurop::tools
