// SPDX-License-Identifier: Apache-2.0
// committed.json of a board: what it has committed and what was deployed before, with a digest of all of it, so that a
// file that the disk has changed is not believed. Text only.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "base/problem.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

inline constexpr const char* kCommittedFile = "committed.json";

struct HistoryEntry {
  std::string deployment;
  std::string plant;
  std::uint64_t generation = 0;
  std::string host;  // that deployed it
  std::int64_t wall_ns = 0;
  std::string outcome;  // "committed", or why it was rolled back
  std::string comment;  // of whoever deployed it
};

struct Committed : CommittedDeployment {
  std::vector<HistoryEntry> history;  // newest last
};

base::Json history_json(const std::vector<HistoryEntry>& history);

std::string committed_text(const Committed& committed);
// A problem if it is not what committed_text() has made. A file of an older release has no digest and is taken as it
// is.
Result<Committed, base::Problem> read_committed(std::string_view text);

// Ids of the deployments whose files are kept on the board: the current and the previous one, and the newest that were
// committed before.
std::set<std::string> kept_deployments(const Committed& committed);

}  // namespace indurop::deploy
