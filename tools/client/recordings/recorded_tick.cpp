// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/recorded_tick.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recorder/tick_search.h"
#include "history/recording/cdr.h"
#include "history/recording/idl_type.h"
#include "history/recording/last_messages.h"
#include "history/recording/mcap_reader.h"
#include "tools/client/recordings/recorded_numbers.h"

namespace indurop::tools {
namespace {

using base::Problem;

constexpr std::int64_t kLatestEndNs = 1'000'000'000;  // how long after its release a run may end
constexpr std::size_t kLongestValueText = 120;

// The runs around a time, with the messages of their values.
class TickReader {
 public:
  TickReader(recording::McapReader& reader, const recorder::Sources& sources, std::size_t source)
      : reader_(reader), source_(sources.all[source]), shift_ns_(source_.number("real_minus_node_ns")) {
    for (const auto& [id, place] : sources.channels) {
      if (place.source == source && place.kind == recorder::ChannelKind::Run) {
        runs_ = id;
      } else if (place.source == source && place.kind == recorder::ChannelKind::Value) {
        variables_[id].name = place.name;
      }
    }
  }

  // Returns nothing if there is no run.
  std::optional<RecordedTick> read(const TickRequest& request) {
    const auto [first, last] = reader_.contents().span_ns();
    const auto time = request.tick ? recorder::time_of_tick(reader_, runs_, *request.tick) : std::nullopt;
    const std::int64_t at = std::clamp(
        request.tick ? static_cast<std::int64_t>(time.value_or(UINT64_MAX >> 1U)) : request.at_ns, first, last);
    for (std::int64_t before = kLatestEndNs;; before *= 4) {
      const std::int64_t begin = std::max(at - before, first);
      const std::uint64_t newest = read_part(begin, at);
      const auto tick = nearest(request.tick.value_or(newest));
      if (begin == first || (tick != runs_of_.end() && tick != runs_of_.begin())) {
        return tick == runs_of_.end() ? std::nullopt : std::optional(tick_of(tick));
      }
    }
  }

 private:
  struct Variable {
    std::string name;
    std::optional<schema::Type> type;
    bool sought = false;  // the type
  };
  struct Value {
    std::uint16_t channel = 0;
    bool written = false;
    recording::Bytes bytes;
  };
  struct Run {
    recorder::RunWords words;
    std::vector<Value> values;
  };
  using Runs = std::map<std::uint64_t, std::vector<Run>>;  // by tick

  // Each run repeats an unchanged value in turn, which it may not even have read.
  static bool is_new(tape::EntryKind kind) noexcept {
    return kind == tape::EntryKind::Before || kind == tape::EntryKind::During || kind == tape::EntryKind::After;
  }

  // Reads the runs from `begin` on, until those of the ticks at `at` have had their time and a later one was found.
  // Returns the newest tick at `at`.
  std::uint64_t read_part(std::int64_t begin, std::int64_t at) {
    runs_of_.clear();
    std::map<std::uint32_t, std::vector<Value>> next;  // by module: of the run that follows
    std::uint64_t newest = 0;
    reader_.seek(static_cast<std::uint64_t>(begin));
    for (;;) {
      const auto message = reader_.next();
      if (!message) {
        continue;  // a damaged part
      }
      if (!*message) {
        return newest;
      }
      const recording::McapMessage& one = **message;
      if (variables_.contains(one.channel)) {
        const recorder::ValueWords words = recorder::from_sequence(one.sequence);
        if (is_new(words.kind) && words.module != recorder::kOthers) {
          next[words.module].push_back(
              {one.channel, words.kind == tape::EntryKind::After, {one.data.view.begin(), one.data.view.end()}});
        }
      } else if (const auto run = one.channel == runs_ ? recorder::run_from_cdr(one.data.view) : Error{};
                 run && run->module != recorder::kOthers) {
        const std::uint64_t tick = run->tail.tick;
        const bool is_early = static_cast<std::int64_t>(one.log_time_ns) <= at;
        if (!is_early && tick > newest && !runs_of_.empty() && log_time(run->tail.release_ns) > at + kLatestEndNs) {
          runs_of_[tick].push_back({*run, {}});
          return newest;
        }
        newest = is_early || runs_of_.empty() ? std::max(newest, tick) : newest;
        runs_of_[tick].push_back({*run, std::exchange(next[run->module], {})});
      }
    }
  }

  [[nodiscard]] Runs::iterator nearest(std::uint64_t tick) {
    const auto found = runs_of_.lower_bound(tick);
    return found == runs_of_.end() && !runs_of_.empty() ? std::prev(found) : found;
  }

  [[nodiscard]] std::int64_t log_time(std::int64_t node_ns) const noexcept { return node_ns + shift_ns_; }

  std::string text_of(const Value& value) {
    Variable& variable = variables_[value.channel];
    if (!std::exchange(variable.sought, true)) {
      const recording::Contents& contents = reader_.contents();
      const auto schema = contents.schemas.find(contents.channels.at(value.channel).schema);
      if (schema != contents.schemas.end()) {
        auto type = recording::idl_type(schema->second.data, schema->second.name);
        variable.type = type ? std::optional(std::move(type).value()) : std::nullopt;
      }
    }
    std::vector<std::uint8_t> bytes(variable.type ? variable.type->size() : 0);
    if (!variable.type || !recording::from_cdr(*variable.type, value.bytes, bytes)) {
      return "?";
    }
    return base::shortened(schema::format_value(*variable.type, bytes), kLongestValueText);
  }

  RecordedTick tick_of(Runs::const_iterator tick) {
    RecordedTick out;
    out.tick = tick->first;
    out.begin_ns = INT64_MAX;
    if (tick != runs_of_.begin()) {
      out.previous = std::prev(tick)->first;
    }
    if (std::next(tick) != runs_of_.end()) {
      out.next = std::next(tick)->first;
    }
    for (const auto& [words, values] : tick->second) {
      TickRun& run = out.runs.emplace_back();
      run.module = recorder::module_name(source_, words.module);
      run.number = words.tail.number;
      run.release_ns = log_time(words.tail.release_ns);
      run.start_ns = log_time(words.tail.start_ns);
      run.end_ns = log_time(words.tail.end_ns);
      run.faulted = words.faulted;
      for (const Value& value : values) {
        run.values.push_back({variables_[value.channel].name, value.written, text_of(value)});
      }
      out.begin_ns = std::min(out.begin_ns, run.release_ns);
      out.end_ns = std::max(out.end_ns, run.end_ns);
    }
    return out;
  }

  recording::McapReader& reader_;
  const recorder::Source& source_;
  std::int64_t shift_ns_;
  std::uint16_t runs_ = 0;
  std::map<std::uint16_t, Variable> variables_;  // by channel
  Runs runs_of_;
};

Result<std::vector<double>, Problem> numbers_at(const recording::McapReader& reader, std::int64_t time_ns,
                                                const std::vector<std::string>& names) {
  const Layouts layouts = layouts_of(reader.contents());
  const auto wanted = find_numbers(reader.contents(), layouts, names);
  if (!wanted) {
    return wanted.error();
  }
  std::set<recording::MessageKey> keys;
  for (const auto& [channel, leaves] : *wanted) {
    keys.insert({channel, recording::kAnyPart});
  }
  std::vector<double> numbers(names.size(), std::nan(""));
  std::vector<double> values;
  const auto any = [](std::uint32_t) { return recording::kAnyPart; };
  for (const auto& [key, message] : last_messages(reader, static_cast<std::uint64_t>(time_ns) + 1, keys, any)) {
    if (recording::read_leaves(layouts.at(key.first), message.bytes, values)) {
      for (const auto& [leaf, line] : wanted->at(key.first)) {
        numbers[line] = values[leaf];
      }
    }
  }
  return numbers;
}

}  // namespace

Result<RecordedTick, Problem> read_tick_of(const std::filesystem::path& path, const TickRequest& request) {
  auto reader = recording::McapReader::open(path);
  if (!reader) {
    return reader.error();
  }
  const recorder::Sources sources = recorder::find_sources(*reader);
  const auto source = recorder::choose_source(sources, request.board, path.filename().string());
  if (!source) {
    return source.error();
  }
  auto tick = TickReader(*reader, sources, *source).read(request);
  if (!tick) {
    return Problem{fmt::format("{} has no runs", path.filename().string())};
  }
  auto numbers = numbers_at(*reader, tick->end_ns, request.names);
  if (!numbers) {
    return numbers.error();
  }
  tick->numbers = std::move(*numbers);
  return std::move(*tick);
}

std::vector<std::string> boards_in(const std::filesystem::path& path) {
  std::vector<std::string> boards;
  if (const auto reader = recording::McapReader::open(path)) {
    for (const recorder::Source& source : recorder::find_sources(*reader).all) {
      if (!source.prefix.empty()) {
        boards.push_back(source.name());
      }
    }
  }
  return boards;
}

}  // namespace indurop::tools
