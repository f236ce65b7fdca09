// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/recorded_numbers.h"

#include <fmt/format.h>

#include <string_view>

namespace indurop::tools {
namespace {

using base::Problem;

constexpr std::string_view kOwn = "indurop/";  // channels that are not variables

}  // namespace

Layouts layouts_of(const recording::Contents& contents) {
  Layouts layouts;
  for (const auto& [id, channel] : contents.channels) {
    const auto schema = contents.schemas.find(channel.schema);
    if (channel.topic.starts_with(kOwn) || channel.encoding != "cdr" || schema == contents.schemas.end()) {
      continue;
    }
    if (auto layout = recording::idl_layout(schema->second.data, schema->second.name)) {
      layouts.emplace(id, std::move(layout).value());
    }
  }
  return layouts;
}

Result<WantedNumbers, Problem> find_numbers(const recording::Contents& contents, const Layouts& layouts,
                                            const std::vector<std::string>& names) {
  std::map<std::string, std::pair<std::uint16_t, std::size_t>> known;
  for (const auto& [id, layout] : layouts) {
    for (std::size_t i = 0; i < layout.size(); ++i) {
      known.emplace(contents.channels.at(id).topic + layout[i].name, std::pair(id, i));
    }
  }
  WantedNumbers wanted;
  for (std::size_t line = 0; line < names.size(); ++line) {
    const auto found = known.find(names[line]);
    if (found == known.end()) {
      return Problem{fmt::format("there is no number '{}' in the recording", names[line])};
    }
    wanted[found->second.first].emplace_back(found->second.second, line);
  }
  return wanted;
}

}  // namespace indurop::tools
