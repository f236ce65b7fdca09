// SPDX-License-Identifier: Apache-2.0
// The black boxes of a board's node for remote tools: a list of them as JSON, and the files by name.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace indurop::deploy {

// {"boxes": [{"name", "reason", "bytes", "end_ns" as CLOCK_REALTIME of the board}]}, the newest first.
std::string boxes_text(const std::string& board);
// Returns the file with that name in the list, and no other.
std::optional<std::filesystem::path> box_file(const std::string& board, const std::string& name);

}  // namespace indurop::deploy
