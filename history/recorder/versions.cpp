// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/versions.h"

#include <algorithm>
#include <tuple>

#include "history/recorder/sources.h"

namespace indurop::recorder {

recording::TextMap to_text_map(const RecordedVersion& version) {
  return {{"module", version.module},
          {"number", std::to_string(version.number)},
          {"first_run", std::to_string(version.first_run)},
          {"first_tick", std::to_string(version.first_tick)},
          {"exchanged", version.exchanged ? "yes" : "no"},
          {"sha256", version.digest},
          {"file", version.file}};
}

std::vector<RecordedVersion> versions_in(const recording::McapReader& reader, const std::string& prefix) {
  std::vector<RecordedVersion> all;
  for (const recording::McapMetadataIndex& index : reader.contents().metadata) {
    const auto record = index.name == prefix + kVersionMetadata ? reader.metadata(index) : base::Problem{};
    if (!record) {
      continue;
    }
    const recording::TextMap& map = record->values;
    RecordedVersion& one = all.emplace_back();
    one.module = text_in(map, "module");
    one.number = static_cast<std::uint32_t>(number_in(map, "number"));
    one.first_run = static_cast<std::uint64_t>(number_in(map, "first_run"));
    one.first_tick = static_cast<std::uint64_t>(number_in(map, "first_tick"));
    one.exchanged = text_in(map, "exchanged") != "no";
    one.digest = text_in(map, "sha256");
    one.file = text_in(map, "file");
  }
  std::sort(all.begin(), all.end(), [](const RecordedVersion& a, const RecordedVersion& b) {
    return std::tie(a.module, a.first_run) < std::tie(b.module, b.first_run);
  });
  const auto again = std::unique(all.begin(), all.end(), [](const RecordedVersion& a, const RecordedVersion& b) {
    return a.module == b.module && a.number == b.number;
  });
  all.erase(again, all.end());
  return all;
}

}  // namespace indurop::recorder
