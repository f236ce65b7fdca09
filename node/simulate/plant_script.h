// SPDX-License-Identifier: Apache-2.0
// Events that happen to the boards of a simulated plant, and when: a file with lines like "500ms kill sensor".

#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::node {

struct PlantEvent {
  enum class What {
    Kill,    // the board loses power
    Cut,     // its network cable is disconnected
    Return,  // undoes the above: the board starts again, or its cable is connected again
  };
  std::chrono::nanoseconds at{};  // since the first tick
  What what = What::Kill;
  std::size_t board = 0;
  std::string text;  // "kill sensor"
  base::SourcePlace place;
};

struct PlantScript {
  std::vector<PlantEvent> events;  // by time
  std::vector<base::Diagnostic> diagnostics;
};

// Events at `end` of the run or later are left out, with a warning; events without an effect get a warning, too.
// `file`: file name for the diagnostics.
PlantScript read_script_text(std::string_view text, const std::string& file, const std::vector<std::string>& boards,
                             std::optional<std::chrono::nanoseconds> end = {});
PlantScript read_script(const std::filesystem::path& file, const std::vector<std::string>& boards,
                        std::optional<std::chrono::nanoseconds> end = {});

}  // namespace indurop::node
