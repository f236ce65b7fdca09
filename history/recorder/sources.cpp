// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "history/recorder/run_words.h"

namespace indurop::recorder {
namespace {

using base::Problem;

Source source_of(const recording::McapReader& reader, const recording::McapChannel& runs) {
  Source source;
  source.prefix = runs.topic.substr(0, runs.topic.size() - kRunsTopic.size());
  source.about = last_metadata(reader, source.prefix + kNodeMetadata);
  for (std::size_t i = 0; runs.metadata.contains(std::to_string(i)); ++i) {
    source.modules.push_back(runs.metadata.at(std::to_string(i)));
  }
  return source;
}

ChannelPlace place_of(const Source& source, std::size_t number, const std::string& topic) {
  const std::string name = topic.substr(source.prefix.size());
  ChannelKind kind = ChannelKind::Value;
  if (name == kRunsTopic) {
    kind = ChannelKind::Run;
  } else if (name == kClockTopic) {
    kind = ChannelKind::Clock;
  } else if (name == kAnswerTopic) {
    kind = ChannelKind::Answer;
  } else if (name.starts_with(kKeyframeTopic)) {
    kind = ChannelKind::Keyframe;
  }
  return {number, kind, name};
}

}  // namespace

recording::TextMap last_metadata(const recording::McapReader& reader, const std::string& name) {
  recording::TextMap found;
  for (const recording::McapMetadataIndex& index : reader.contents().metadata) {
    if (index.name == name) {
      if (auto metadata = reader.metadata(index)) {
        found = std::move(metadata->values);
      }
    }
  }
  return found;
}

std::string text_in(const recording::TextMap& texts, const std::string& key) {
  const auto found = texts.find(key);
  return found == texts.end() ? std::string() : found->second;
}

std::int64_t number_in(const recording::TextMap& texts, const std::string& key) {
  const std::string digits = text_in(texts, key);
  std::int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

std::string Source::text(const std::string& key) const {
  return text_in(about, key);
}

std::int64_t Source::number(const std::string& key) const {
  return number_in(about, key);
}

Sources find_sources(const recording::McapReader& reader) {
  Sources sources;
  const auto& channels = reader.contents().channels;
  for (const auto& [id, channel] : channels) {
    const bool at_a_border = channel.topic == kRunsTopic || channel.topic.ends_with("/" + std::string(kRunsTopic));
    if (at_a_border) {
      sources.all.push_back(source_of(reader, channel));
    }
  }
  // If prefixes contain each other, the longer one counts.
  std::sort(sources.all.begin(), sources.all.end(),
            [](const Source& a, const Source& b) { return a.prefix.size() > b.prefix.size(); });
  for (const auto& [id, channel] : channels) {
    for (std::size_t i = 0; i < sources.all.size(); ++i) {
      if (channel.topic.starts_with(sources.all[i].prefix)) {
        sources.channels[id] = place_of(sources.all[i], i, channel.topic);
        break;
      }
    }
  }
  return sources;
}

Result<std::size_t, Problem> choose_source(const Sources& sources, const std::string& name, const std::string& file) {
  if (sources.all.empty()) {
    return Problem{
        fmt::format("{} has no runs: only recordings of indurop record and run --record can be replayed", file)};
  }
  std::string names;
  for (std::size_t i = 0; i < sources.all.size(); ++i) {
    const std::string own = sources.all[i].name();
    if (own == name) {
      return i;
    }
    names += (names.empty() ? "" : ", ") + own;
  }
  if (sources.all.size() == 1 && sources.all.front().prefix.empty()) {
    return Problem{fmt::format("{} is the recording of one node: leave out --board", file)};
  }
  return Problem{name.empty() ? fmt::format("{} is of several boards: choose one with --board: {}", file, names)
                              : fmt::format("{} has no board '{}', but {}", file, name, names)};
}

std::string module_name(const Source& source, std::uint32_t module) {
  if (module == kOthers) {
    return "no module";
  }
  return module < source.modules.size() ? source.modules[module] : fmt::format("module {}", module);
}

}  // namespace indurop::recorder
