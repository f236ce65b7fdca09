// SPDX-License-Identifier: Apache-2.0
// committed.json of a board: its committed deployment and the earlier ones, with a digest over all of it, so that a
// file that the disk has corrupted is rejected. Text only.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

inline constexpr const char* kCommittedFile = "committed.json";

struct HistoryEntry {
  std::string deployment;
  std::string plant;
  std::uint64_t generation = 0;
  std::string host;  // host that deployed it
  std::int64_t wall_ns = 0;
  std::string outcome;  // "committed", or why it was rolled back
  std::string comment;  // comment of the user who deployed it
};

struct Committed : CommittedDeployment {
  std::vector<HistoryEntry> history;  // newest last
};

base::Json history_json(const std::vector<HistoryEntry>& history);

std::string committed_text(const Committed& committed);
// Returns a problem if the text is not what committed_text() creates. A file of an older release has no digest and is
// accepted without one.
Result<Committed, base::Problem> read_committed(std::string_view text);

// A board keeps the files of so many deployments, and of so many releases of the platform.
inline constexpr std::size_t kDeploymentsKept = 5;
inline constexpr std::size_t kReleasesKept = 2;
// Returns the ids of the deployments whose files are kept on the board: the current and the previous one, and up to
// `most` in all the newest that were committed earlier.
std::set<std::string> kept_deployments(const Committed& committed, std::size_t most = kDeploymentsKept);

// Returns the folder of a board's releases of the platform, in its state folder.
inline std::filesystem::path platform_folder(const std::filesystem::path& state) {
  return state / "platform";
}

}  // namespace indurop::deploy
