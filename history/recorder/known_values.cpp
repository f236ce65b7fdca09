// SPDX-License-Identifier: Apache-2.0
// What precedes the runs of a file: channels, the first values, the last ones of each module, and the version of its
// code.

#include "history/recorder/recorder.h"
#include "history/recorder/run_words.h"
#include "history/recorder/versions.h"

namespace indurop::recorder {

using base::Problem;

// Adds the channels of runs, of the clock and of other inputs.
Result<void, Problem> Recorder::add_own_channels() {
  recording::TextMap modules;
  for (std::size_t i = 0; i < about_.modules.size(); ++i) {
    modules[std::to_string(i)] = about_.modules[i];
  }
  const auto add = [&](std::string_view name, std::string_view idl, std::string_view topic,
                       std::uint16_t& to) -> Result<void, Problem> {
    auto schema = writer_->add_schema(name, "omgidl", idl);
    if (!schema) {
      return std::move(schema).error();
    }
    auto channel = writer_->add_channel(*schema, prefix_ + std::string(topic), "cdr", modules);
    if (!channel) {
      return std::move(channel).error();
    }
    to = *channel;
    return {};
  };
  auto runs = add(kRunSchema, kRunIdl, kRunsTopic, runs_channel_);
  auto clock = runs ? add(kClockSchema, kClockIdl, kClockTopic, clock_channel_) : runs;
  return clock ? add(kAnswerSchema, kAnswerIdl, kAnswerTopic, answer_channel_) : clock;
}

void Recorder::note(std::size_t track, const tape::Run& run) {
  Known& known = known_[track];
  for (const tape::Value& value : run.values) {
    if (value.variable < known.values.size()) {
      known.values[value.variable].assign(value.bytes.begin(), value.bytes.end());
    }
  }
  known.end_ns = run.tail.end_ns;
}

// Says which version of the module's code runs from this run on, if the file has not said that yet.
Result<void, Problem> Recorder::write_version(std::size_t track, const tape::Run& run) {
  std::uint32_t& known = known_[track].version;
  const std::uint32_t number = tape::version_in(run.flags);
  if (number == known) {
    return {};
  }
  RecordedVersion version;
  version.module = run.module < about_.modules.size() ? about_.modules[run.module] : std::to_string(run.module);
  version.number = number;
  version.first_run = run.tail.number;
  version.first_tick = run.tail.tick;
  if (auto found = follower_.version(number); found) {
    version.exchanged = !found->of_start;
    version.digest = std::move(found->digest);
    version.file = std::move(found->file);
  }
  auto written = writer_->metadata(prefix_ + kVersionMetadata, to_text_map(version));
  known = written.ok() ? number : known;
  return written;
}

// Reads the values of the runs so far, without recording them.
void Recorder::learn() {
  begin_ns_ = store_->now().time_since_epoch().count();
  tape::Run run;
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    while (follower_.next(track, run)) {
      add_places();
      note(track, run);
    }
  }
}

// Writes the values from before any module was started, if the recording begins with the first run, else those of the
// runs before it.
Result<void, Problem> Recorder::write_first_values(const tape::Run& first) {
  const std::int64_t before = first.tail.release_ns - about_.basic_period_ns;
  for (std::uint32_t i = 0; first.tail.number == 0 && i < places_.size(); ++i) {
    const tape::Value value{tape::EntryKind::Run, i, follower_.first_value(i)};
    if (value.bytes.empty()) {
      continue;  // it appeared later
    }
    if (auto written = write_value(value, kOthers, before, before); !written) {
      return written;
    }
  }
  return write_known_values();
}

// Writes the values of each module at the end of its last run: inputs of the next run come later, however long that
// takes.
Result<void, Problem> Recorder::write_known_values() {
  for (std::size_t track = 0; track < known_.size(); ++track) {
    const Known& known = known_[track];
    const std::uint32_t module = follower_.module_of(track);
    for (std::uint32_t i = 0; i < known.values.size(); ++i) {
      if (known.values[i].empty()) {
        continue;
      }
      const tape::Value value{tape::EntryKind::Before, i, known.values[i]};
      if (auto written = write_value(value, module == tape::kOthers ? kOthers : module, known.end_ns, known.end_ns);
          !written) {
        return written;
      }
    }
  }
  return {};
}

}  // namespace indurop::recorder
