// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/omg_idl.h"

namespace indurop::recorder {
namespace {

using base::Problem;

recording::TextMap metadata_of(const schema::Variable& variable) {
  recording::TextMap map{{"unit", variable.unit}, {"description", variable.description}, {"declared", variable.source}};
  std::erase_if(map, [](const auto& entry) { return entry.second.empty(); });
  return map;
}

std::uint32_t module_of(const tape::Run& run) {
  return run.module == tape::kOthers ? kOthers : run.module;
}

bool is_wanted(const std::vector<std::string>& globs, const std::string& name) {
  return globs.empty() || std::any_of(globs.begin(), globs.end(),
                                      [&name](const std::string& glob) { return schema::glob_match(glob, name); });
}

// The name that a variable has on the tape: the store calls it otherwise while another type has that name.
const std::string& name_on_tape(const vars::Store& store, const tape::Follower& tape, std::uint32_t index) {
  const auto taped = tape.variables();
  const vars::DirectoryEntry* const named = index < taped.size() ? store.find(taped[index].name_hash) : nullptr;
  const vars::DirectoryEntry& entry = named != nullptr ? *named : store.directory()[index];
  return store.schema().variables[entry.schema_index].name;
}

recording::View view(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

Result<Recorder, Problem> Recorder::create_one_of(const std::string& prefix, const About& about,
                                                  const vars::Store& store, tape::Follower follower,
                                                  const std::vector<std::string>& globs, std::vector<bool>& matched) {
  if (!follower.is_of(store)) {
    return Problem{"the node's variables have just changed: try again"};
  }
  Recorder recorder(prefix, store, std::move(follower), about);
  recorder.begun_wall_ns_ =
      about.real_minus_node_ns != 0 ? about.real_minus_node_ns + store.now().time_since_epoch().count() : 0;
  recorder.choose(globs, matched);
  return recorder;
}

Result<Recorder, Problem> Recorder::create(const std::filesystem::path& path, const About& about,
                                           const vars::Store& store, tape::Follower follower,
                                           const std::vector<std::string>& globs) {
  std::vector<bool> matched(globs.size(), false);
  auto recorder = create_one_of("", about, store, std::move(follower), globs, matched);
  if (!recorder) {
    return recorder;
  }
  if (const auto none = std::find(matched.begin(), matched.end(), false); none != matched.end()) {
    return Problem{fmt::format("node {} has no variable '{}'; see indurop vars", about.node,
                               globs[static_cast<std::size_t>(none - matched.begin())])};
  }
  auto writer = recording::McapWriter::create(path, {});
  if (!writer) {
    return std::move(writer).error();
  }
  if (auto begun = recorder->go_on_in(std::make_shared<recording::McapWriter>(std::move(writer).value())); !begun) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
    return std::move(begun).error();
  }
  return recorder;
}

const schema::Variable& Recorder::variable(std::uint32_t index) const {
  return store_->schema().variables[store_->directory()[index].schema_index];
}

std::uint64_t Recorder::real_time(std::int64_t node_ns) const noexcept {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(node_ns + about_.real_minus_node_ns, 0));
}

// The log time of a file begins at its own start, however old its known values are; a run that began earlier gets that
// start.
std::uint64_t Recorder::log_time(std::int64_t node_ns) const noexcept {
  return real_time(std::max(node_ns, begin_ns_));
}

void Recorder::choose(const std::vector<std::string>& globs, std::vector<bool>& matched) {
  globs_ = globs;
  follower_.show_later_variables();
  const auto count = static_cast<std::uint32_t>(follower_.variables().size());
  for (std::uint32_t i = 0; i < store_->directory().size(); ++i) {
    for (std::size_t glob = 0; glob < globs.size(); ++glob) {
      matched[glob] = matched[glob] || schema::glob_match(globs[glob], variable(i).name);
    }
    if (i >= count && is_wanted(globs, variable(i).name)) {
      missing_.appeared.push_back(variable(i).name);
    }
  }
  runs_.set_tracks(follower_.tracks());
  known_.resize(follower_.tracks());
  add_places();
}

// Variables that appear while the node runs are recorded from the first run on that uses them.
void Recorder::add_places() {
  const auto count = static_cast<std::uint32_t>(follower_.variables().size());
  if (count <= places_.size()) {
    return;
  }
  if (store_->directory().size() < count) {
    auto again = vars::Store::attach(about_.node, vars::Mode::ReadOnly);
    if (!again || again->directory().size() < count || !follower_.is_of(*again)) {
      return;
    }
    own_store_ = std::make_unique<vars::Store>(std::move(again).value());
    store_ = own_store_.get();
  }
  for (auto i = static_cast<std::uint32_t>(places_.size()); i < count; ++i) {
    const tape::TapeVariable& taped = follower_.variables()[i];
    const schema::Type& type = variable(i).type;
    const std::string& name = name_on_tape(*store_, follower_, i);
    const bool wanted = is_wanted(globs_, name);
    std::erase(missing_.appeared, name);
    if (wanted && taped.taped == 0) {
      missing_.too_large.push_back(name);
    }
    places_.push_back({wanted && taped.taped != 0, recording::lies_as_cdr(type) && type.size() == taped.size, 0});
  }
  for (Known& known : known_) {
    known.values.resize(places_.size());
  }
}

// Writes everything that precedes the first run.
Result<void, Problem> Recorder::begin_file() {
  for (Place& place : places_) {
    place.channel = 0;
  }
  keyframes_.begin_file();
  for (Known& known : known_) {
    known.version = 0;
  }
  schemas_.clear();
  if (auto channels = add_own_channels(); !channels) {
    return channels;
  }
  for (const auto& [name, text] : about_.files) {
    recording::McapAttachment attachment;
    attachment.name = prefix_ + name;
    attachment.media_type = "text/plain";
    if (auto attached = writer_->attach(attachment, view(text)); !attached) {
      return attached;
    }
  }
  recording::TextMap metadata_values{{"format", std::to_string(kRecordingFormat)},
                                     {"node", about_.node},
                                     {"config", about_.config},
                                     {"board", about_.board},
                                     {"deployment", about_.deployment},
                                     {"reason", about_.reason},
                                     {"basic_period_ns", std::to_string(about_.basic_period_ns)},
                                     {"real_minus_node_ns", std::to_string(about_.real_minus_node_ns)},
                                     {"begun_wall_ns", std::to_string(begun_wall_ns_)}};
  if (part_ > 0) {
    metadata_values[kPartText] = std::to_string(part_);
  }
  return writer_->metadata(prefix_ + kNodeMetadata, metadata_values);
}

Result<std::uint16_t, Problem> Recorder::schema_of(std::string_view name, const std::string& idl) {
  std::uint16_t& schema = schemas_[idl];
  if (schema == 0) {
    auto added = writer_->add_schema(name, "omgidl", idl);
    if (!added) {
      return added;
    }
    schema = *added;
  }
  return schema;
}

Result<std::uint16_t, Problem> Recorder::channel_of(std::uint32_t index) {
  if (places_[index].channel != 0) {
    return places_[index].channel;
  }
  const schema::Variable& known = variable(index);
  const recording::OmgIdl idl = recording::omg_idl(known.type);
  auto schema = schema_of(idl.name, idl.text);
  if (!schema) {
    return schema;
  }
  auto channel =
      writer_->add_channel(*schema, prefix_ + name_on_tape(*store_, follower_, index), "cdr", metadata_of(known));
  if (channel) {
    places_[index].channel = *channel;
  }
  return channel;
}

Result<void, Problem> Recorder::write_value(const tape::Value& value, std::uint32_t module, std::int64_t time_ns,
                                            std::int64_t release_ns) {
  if (value.variable >= places_.size() || !places_[value.variable].wanted) {
    return {};
  }
  auto channel = channel_of(value.variable);
  if (!channel) {
    return std::move(channel).error();
  }
  if (places_[value.variable].copied) {
    cdr_.assign(recording::kCdrHead.begin(), recording::kCdrHead.end());
    cdr_.insert(cdr_.end(), value.bytes.begin(), value.bytes.end());
  } else if (!recording::to_cdr(variable(value.variable).type, value.bytes, cdr_)) {
    return Problem{fmt::format("{} has another size than its type", variable(value.variable).name)};
  }
  auto written =
      writer_->write(*channel, log_time(time_ns), real_time(release_ns), to_sequence({module, value.kind}), cdr_);
  counts_.values += written.ok() ? 1U : 0U;
  return written;
}

// Writes part number `part` of a run: its values, the results of the clock and of calls, and last the run itself.
Result<void, Problem> Recorder::write_part(const tape::Run& run, std::size_t part) {
  const std::uint32_t module = module_of(run);
  if (part < run.values.size()) {
    const tape::Value& value = run.values[part];
    const std::int64_t time = value.kind == tape::EntryKind::Before ? run.tail.start_ns : run.tail.end_ns;
    return write_value(value, module, time, run.tail.release_ns);
  }
  part -= run.values.size();
  const auto write = [&](std::uint16_t channel, std::uint32_t sequence) {
    return writer_->write(channel, log_time(run.tail.end_ns), real_time(run.tail.release_ns), sequence, cdr_);
  };
  if (part < run.clock.size()) {
    to_cdr(run.clock[part], cdr_);
    return write(clock_channel_, to_sequence({module, tape::EntryKind::Clock}));
  }
  part -= run.clock.size();
  if (part < run.answers.size()) {
    to_cdr(AnswerRecord{run.answers[part].code, run.answers[part].bytes}, cdr_);
    return write(answer_channel_, to_sequence({module, tape::EntryKind::Answer}));
  }
  to_cdr(RunWords{run.tail, module, (run.flags & tape::kFaulted) != 0, (run.flags & tape::kRestarted) != 0,
                  (run.flags & tape::kExchanged) != 0},
         cdr_);
  auto written = write(runs_channel_, static_cast<std::uint32_t>(run.tail.number));
  counts_.runs += written.ok() ? 1U : 0U;
  return written;
}

Result<void, Problem> Recorder::write_run(RunQueue::Held& held) {
  const std::size_t parts = held.run.values.size() + held.run.clock.size() + held.run.answers.size() + 1;
  for (; held.written < parts; ++held.written) {
    if (auto written = write_part(held.run, held.written); !written) {
      return written;
    }
  }
  return {};
}

// Writes the run that was read of the track. Returns false if it did not end before `until_ns`.
Result<bool, Problem> Recorder::take_run(std::size_t track, std::int64_t until_ns) {
  RunQueue::Held& held = runs_.held(track);
  if (held.run.tail.end_ns >= until_ns) {
    return false;
  }
  add_places();
  if (!first_values_written_) {
    if (auto first_values = write_first_values(held.run); !first_values) {
      return std::move(first_values).error();
    }
    first_values_written_ = true;
  }
  auto written = write_version(track, held.run);
  if (written) {
    written = write_keyframe(held);
  }
  if (written) {
    written = write_run(held);
  }
  if (!written) {
    return std::move(written).error();
  }
  latest_ns_ = std::max(latest_ns_, held.run.tail.end_ns);
  if (remembers_) {
    note(track, held.run);
  }
  return true;
}

Result<void, Problem> Recorder::take(std::int64_t until_ns) {
  std::vector<std::uint32_t> modules;
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    modules.push_back(follower_.module_of(track));
  }
  keyframes_.read(about_.node, follower_.header(), modules,
                  [this](std::uint32_t module) { return records_inputs(module); });
  runs_.begin(follower_);
  while (const auto track = runs_.next()) {
    auto taken = take_run(*track, until_ns);
    if (!taken) {
      return std::move(taken).error();
    }
    if (*taken) {
      runs_.finish(*track, follower_);
    }
  }
  for (std::size_t track = 0; track < follower_.tracks(); ++track) {
    if (const std::uint64_t lost = follower_.lost(track); lost > 0) {
      counts_.lost[follower_.module_of(track)] = lost;
    }
  }
  return {};
}

std::size_t Recorder::variables() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(places_.begin(), places_.end(), [](const Place& place) { return place.wanted; }));
}

Result<void, Problem> Recorder::attach(std::string_view name, std::string_view text) {
  recording::McapAttachment attachment;
  attachment.name = prefix_ + std::string(name);
  attachment.media_type = "application/json";
  return writer_->attach(attachment, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

Result<void, Problem> Recorder::conclude() {
  std::uint64_t lost = 0;
  recording::TextMap metadata_values;
  for (const auto& [module, runs] : counts_.lost) {
    const auto earlier = before_.lost.find(module);
    const std::uint64_t here = runs - (earlier == before_.lost.end() ? 0 : earlier->second);
    lost += here;
    metadata_values["lost_runs." + (module < about_.modules.size() ? about_.modules[module] : "")] =
        std::to_string(here);
  }
  metadata_values["runs"] = std::to_string(counts_.runs - before_.runs);
  metadata_values["values"] = std::to_string(counts_.values - before_.values);
  metadata_values["lost_runs"] = std::to_string(lost);
  return writer_->metadata(prefix_ + kEndMetadata, metadata_values);
}

Result<void, Problem> Recorder::close() {
  auto concluded = conclude();
  return concluded ? writer_->close() : concluded;
}

Result<void, Problem> Recorder::go_on_in(std::shared_ptr<recording::McapWriter> writer, std::uint64_t part) {
  writer_ = std::move(writer);
  part_ = part;
  begin_ns_ = std::max(begin_ns_, latest_ns_);
  before_ = counts_;
  auto begun = begin_file();
  return begun && first_values_written_ ? write_known_values() : begun;
}

}  // namespace indurop::recorder
