// SPDX-License-Identifier: Apache-2.0
// Reads plant.xml, the manifest of a plant, like config/xml/reader.h reads module.xml.

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "config/model/plant.h"

namespace indurop::config {

struct ReadPlant {
  Plant plant;                                // meaningful only if ok
  std::vector<base::Diagnostic> diagnostics;  // of the file, sorted by place
  [[nodiscard]] bool ok() const noexcept;
};

// Returns true if the root element of the file is <plant>; false otherwise, also for unreadable files.
bool is_plant_file(const std::filesystem::path& file);
// Limits and errors as for read_config(). Not real-time safe.
ReadPlant read_plant(const std::filesystem::path& file);
ReadPlant read_plant_text(std::string_view xml, const std::filesystem::path& pretend_file);

}  // namespace indurop::config
