// SPDX-License-Identifier: Apache-2.0
#include "node/replay/recorded_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "history/explain/facts_json.h"
#include "history/recorder/sources.h"
#include "history/recorder/tick_search.h"
#include "history/recording/omg_idl.h"
#include "node/replay/other_declarations.h"

namespace indurop::node {

using base::Problem;

Result<RecordedRuns, Unfit> RecordedRuns::open(const std::filesystem::path& path, const std::string& board,
                                               const vars::Store& store, std::span<const schema::Variable> former) {
  auto reader = recording::McapReader::open(path);
  if (!reader) {
    return Unfit{reader.error().text};
  }
  RecordedRuns runs(std::move(reader).value());
  if (auto matched = runs.match(store, former, board, path.string()); !matched) {
    return std::move(matched).error();
  }
  return runs;
}

Result<std::string, Unfit> RecordedRuns::node_of(const std::filesystem::path& path, const std::string& board) {
  const auto reader = recording::McapReader::open(path);
  if (!reader) {
    return Unfit{reader.error().text};
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  const auto source = recorder::choose_source(sources, board, path.string());
  return source ? Result<std::string, Unfit>(sources.all[*source].text("node")) : Unfit{source.error().text};
}

std::uint16_t& RecordedRuns::channel_of(recorder::ChannelKind kind) noexcept {
  switch (kind) {
    case recorder::ChannelKind::Run:
      return runs_channel_;
    case recorder::ChannelKind::Clock:
      return clock_channel_;
    default:
      return answer_channel_;
  }
}

Result<void, Unfit> RecordedRuns::match(const vars::Store& store, std::span<const schema::Variable> former,
                                        const std::string& board, const std::string& name) {
  const recording::Contents& contents = reader_.contents();
  const recorder::Sources sources = recorder::find_sources(reader_);
  const auto source = recorder::choose_source(sources, board, name);
  if (!source) {
    return Unfit{source.error().text};
  }
  modules_ = sources.all[*source].modules;
  prefix_ = sources.all[*source].prefix;
  node_ = sources.all[*source].text("node");
  versions_ = recorder::versions_in(reader_, prefix_);
  real_minus_node_ns_ = sources.all[*source].number("real_minus_node_ns");
  format_ = std::max<std::int64_t>(sources.all[*source].number("format"), 1);
  const recording::TextMap end = recorder::last_metadata(reader_, prefix_ + recorder::kEndMetadata);
  const auto lost = end.find("lost_runs");
  without_gaps_ = lost != end.end() && lost->second == "0";
  std::set<std::string> fits;
  std::set<std::string> changed;
  for (const auto& [id, place] : sources.channels) {
    if (place.source != *source) {
      continue;
    }
    if (place.kind == recorder::ChannelKind::Keyframe) {
      const recording::TextMap& said = contents.channels.at(id).metadata;
      const auto form = said.find(recorder::kKeyframeForm);
      keyframes_[id] = form == said.end() ? std::string() : form->second;
      continue;
    }
    if (place.kind != recorder::ChannelKind::Value) {
      channel_of(place.kind) = id;
      continue;
    }
    const auto* entry = store.find(abi::fnv1a64(place.name.data(), place.name.size()));
    if (entry == nullptr) {
      unknown_.push_back(place.name);
      continue;
    }
    const auto schema = contents.schemas.find(contents.channels.at(id).schema);
    const schema::Variable* const before = former_of(former, entry->name_hash);
    const schema::Variable& declared = before != nullptr ? *before : store.schema().variables[entry->schema_index];
    if (schema == contents.schemas.end() || schema->second.data != recording::omg_idl(declared.type).text) {
      changed.insert(place.name);
      continue;
    }
    fits.insert(place.name);
    variables_[id] = static_cast<std::uint32_t>(entry - store.directory().data());
  }
  // Of a variable whose type changed while it was recorded, the values of this type are read.
  std::erase_if(changed, [&fits](const std::string& one) { return fits.contains(one); });
  if (!changed.empty()) {
    return Unfit{fmt::format("{} has another type in this configuration than in {}: replay with the modules that "
                             "were recorded",
                             fmt::join(changed, ", "), name),
                 kSchemaMismatch};
  }
  return {};
}

bool RecordedRuns::has_keyframes(const std::string& module) const {
  const std::string topic = prefix_ + std::string(recorder::kKeyframeTopic) + module;
  const auto& channels = reader_.contents().channels;
  return std::any_of(channels.begin(), channels.end(), [&](const auto& entry) { return entry.second.topic == topic; });
}

std::optional<std::uint64_t> RecordedRuns::time_of_tick(std::uint64_t tick) const {
  return recorder::time_of_tick(reader_, runs_channel_, tick);
}

std::pair<std::uint64_t, std::uint64_t> RecordedRuns::span_ns() const {
  const auto [first, last] = reader_.contents().span_ns();
  return {static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(last)};
}

std::vector<RecordedRuns::EarlierValue> RecordedRuns::values_before(std::uint64_t log_time_ns,
                                                                    const std::set<VariableOf>& wanted) const {
  std::set<recording::MessageKey> keys;
  for (const auto& [channel, variable] : variables_) {
    for (auto one = wanted.lower_bound({variable, 0}); one != wanted.end() && one->first == variable; ++one) {
      keys.insert({channel, one->second});
    }
  }
  const auto module_of = [](std::uint32_t sequence) { return recorder::from_sequence(sequence).module; };
  std::vector<EarlierValue> values;
  for (auto& [key, message] : recording::last_messages(reader_, log_time_ns, std::move(keys), module_of)) {
    values.push_back({variables_.at(key.first), key.second, std::move(message.bytes)});
  }
  return values;
}

bool RecordedRuns::has_values_of(std::uint32_t variable) const noexcept {
  return std::any_of(variables_.begin(), variables_.end(),
                     [variable](const auto& entry) { return entry.second == variable; });
}

explain::Facts RecordedRuns::facts() const {
  explain::Facts facts;
  for (const recording::McapAttachmentIndex& index : reader_.contents().attachments) {
    const bool own = index.name == prefix_ + std::string(explain::kFactsFile);
    if (const auto bytes = own ? reader_.attachment(index) : Problem{}; bytes) {
      (void)explain::read_facts({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, facts);
    }
  }
  return facts;
}

Result<std::optional<RecordedRuns::Item>, Problem> RecordedRuns::next() {
  for (;;) {
    auto message = reader_.next();
    if (!message) {
      return std::move(message).error();
    }
    if (!*message) {
      return std::optional<Item>();
    }
    const recording::McapMessage& one = **message;
    time_ns_ = one.log_time_ns;
    if (one.channel == runs_channel_) {
      auto run = recorder::run_from_cdr(one.data.view);
      if (!run) {
        return Problem{"a run of the recording is damaged"};
      }
      return std::optional<Item>(RecordedRun{*run});
    }
    if (one.channel == clock_channel_ && clock_channel_ != 0) {
      auto clock = recorder::clock_from_cdr(one.data.view);
      if (!clock) {
        return Problem{"a time of the recording is damaged"};
      }
      return std::optional<Item>(RecordedClock{recorder::from_sequence(one.sequence).module, *clock});
    }
    if (one.channel == answer_channel_ && answer_channel_ != 0) {
      auto answer = recorder::answer_from_cdr(one.data.view);
      if (!answer) {
        return Problem{"an input record of the recording is damaged"};
      }
      return std::optional<Item>(RecordedAnswer{recorder::from_sequence(one.sequence).module, *answer});
    }
    if (const auto known = keyframes_.find(one.channel); known != keyframes_.end()) {
      auto keyframe = recorder::keyframe_from_cdr(one.data.view);
      if (!keyframe) {
        return Problem{"a keyframe of the recording is damaged"};
      }
      return std::optional<Item>(
          RecordedKeyframe{recorder::from_sequence(one.sequence).module, *keyframe, &known->second});
    }
    if (const auto known = variables_.find(one.channel); known != variables_.end()) {
      return std::optional<Item>(RecordedValue{recorder::from_sequence(one.sequence), known->second, one.data.view});
    }
  }
}

}  // namespace indurop::node
