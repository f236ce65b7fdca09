// SPDX-License-Identifier: Apache-2.0
// Facts from a recording: runs, values of one variable, and the additional facts.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "history/explain/facts_json.h"
#include "history/explain/run_facts.h"
#include "history/recorder/cut.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/idl_type.h"
#include "tools/cli/explain/gather.h"

namespace indurop::tools {
namespace {

using base::Problem;
using explain::Facts;

// Facts of one of the nodes in a recording.
class Recorded {
 public:
  Recorded(recording::McapReader reader, std::size_t source, std::string variable)
      : reader_(std::move(reader)),
        sources_(recorder::find_sources(reader_)),
        own_(source),
        about_(sources_.all[source]),
        variable_(std::move(variable)) {}
  Recorded(const Recorded&) = delete;
  Recorded& operator=(const Recorded&) = delete;

  Result<Facts, Problem> facts(const std::string& file) {
    if (!about_the_node()) {
      return Problem{fmt::format("{} does not say of which node it is", file)};
    }
    about_its_end();
    name_modules();
    places_ = add_config(config_, facts_);
    find_variable();
    find_qualities();
    (void)reader_.each([this](const recording::McapMessage& message) { take(message); });
    if (!facts_.runs.empty()) {
      conclude();
    }
    explain::make_sound(facts_);
    return std::move(facts_);
  }

 private:
  bool about_the_node() {
    facts_.node = about_.text("node");
    facts_.board = about_.text("board");
    facts_.basic_period_ns = about_.number("basic_period_ns");
    config_ = about_.text("config");
    return facts_.basic_period_ns > 0;
  }

  // Reads what was written when the recording was closed; one that was not closed does not have it.
  void about_its_end() {
    for (const auto& index : reader_.contents().attachments) {
      const bool own = index.name == about_.prefix + std::string(explain::kFactsFile);
      const auto bytes = own ? reader_.attachment(index) : Problem{};
      if (bytes) {
        complete_ =
            explain::read_facts({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, facts_) || complete_;
      }
    }
    // Times in the file were converted with this difference; the one measured at the end may differ by milliseconds.
    facts_.wall_minus_node_ns = about_.number("real_minus_node_ns");
  }

  void name_modules() {
    const std::vector<std::string>& names = about_.modules;
    facts_.modules.resize(std::max(facts_.modules.size(), names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      facts_.modules[i].name = names[i];
    }
  }

  // A recording of selected variables does not have those of the others.
  void find_variable() {
    const bool recorded = std::any_of(sources_.channels.begin(), sources_.channels.end(), [this](const auto& channel) {
      const recorder::ChannelPlace& place = channel.second;
      return place.source == own_ && place.kind == recorder::ChannelKind::Value && place.name == variable_;
    });
    for (explain::VariableFact& one : facts_.variables) {
      one.recorded = one.name == variable_ && recorded;
    }
  }

  // Which channels have the qualities of field devices, and with which type.
  void find_qualities() {
    for (const auto& [id, place] : sources_.channels) {
      const auto& channel = reader_.contents().channels.at(id);
      const auto schema = reader_.contents().schemas.find(channel.schema);
      if (place.source != own_ || place.kind != recorder::ChannelKind::Value ||
          schema == reader_.contents().schemas.end()) {
        continue;
      }
      std::vector<const QualityPlace*> inside;
      for (const QualityPlace& one : places_) {
        if (one.variable == place.name) {
          inside.push_back(&one);
        }
      }
      auto type = inside.empty() ? base::Problem{} : recording::idl_type(schema->second.data, schema->second.name);
      if (type) {
        qualities_[id] = {std::move(type).value(), std::move(inside)};
      }
    }
  }

  void take_qualities(const recording::McapMessage& message) {
    const auto found = qualities_.find(message.channel);
    if (found == qualities_.end()) {
      return;
    }
    std::vector<std::uint8_t> bytes(found->second.type.size());
    if (recording::from_cdr(found->second.type, message.data.view, bytes)) {
      for (const QualityPlace* place : found->second.places) {
        place->add(static_cast<std::int64_t>(message.log_time_ns) - facts_.wall_minus_node_ns, bytes, facts_);
      }
    }
  }

  void take(const recording::McapMessage& message) {
    take_qualities(message);
    const auto place = sources_.channels.find(message.channel);
    if (place == sources_.channels.end() || place->second.source != own_) {
      return;
    }
    if (place->second.kind == recorder::ChannelKind::Run) {
      take_run(message);
    } else if (place->second.kind == recorder::ChannelKind::Value && place->second.name == variable_) {
      take_value(message);
    }
  }

  void take_run(const recording::McapMessage& message) {
    const auto run = recorder::run_from_cdr(message.data.view);
    if (!run) {
      return;
    }
    first_numbers_.try_emplace(run->module, run->tail.number);
    note_hole(run->module, run->tail);
    last_tick_ = std::max(last_tick_, run->tail.tick);
    facts_.epoch_ns = run->tail.release_ns - static_cast<std::int64_t>(run->tail.tick) * facts_.basic_period_ns;
    if (run->module < facts_.modules.size()) {
      facts_.runs.push_back(
          {run->module, run->tail.tick, run->tail.release_ns, run->tail.start_ns, run->tail.end_ns, run->faulted});
    }
  }

  // Runs are numbered: gaps between two neighbours are runs that took place but are missing.
  void note_hole(std::uint32_t module, const tape::RunTail& tail) {
    const auto [last, first] = last_runs_.try_emplace(module, tail);
    if (!first && tail.number > last->second.number + 1 && module < facts_.modules.size()) {
      facts_.holes.push_back({module, last->second.tick, tail.tick, last->second.end_ns, tail.start_ns,
                              tail.number - last->second.number - 1});
    }
    last->second = tail;
  }

  void take_value(const recording::McapMessage& message) {
    const auto words = recorder::from_sequence(message.sequence);
    if (words.kind != tape::EntryKind::After) {
      return;
    }
    const auto time = static_cast<std::int64_t>(message.log_time_ns) - facts_.wall_minus_node_ns;
    facts_.changes.push_back(
        {variable_, words.module < facts_.modules.size() ? facts_.modules[words.module].name : "", 0, time});
  }

  // Rings of event-driven modules and of external writers may hold everything from the start while others do not.
  [[nodiscard]] bool from_the_start() const {
    return std::all_of(first_numbers_.begin(), first_numbers_.end(), [&](const auto& first) {
      const bool periodic = first.first < facts_.modules.size() && facts_.modules[first.first].operation != "sporadic";
      return !periodic || first.second == 0;
    });
  }

  // Returns true if the recording is a part: the facts are those at the end of the whole.
  [[nodiscard]] bool is_cut_off() const {
    const std::int64_t last = facts_.runs.back().end_ns + facts_.wall_minus_node_ns;
    const auto& all = reader_.contents().metadata;
    return std::any_of(all.begin(), all.end(), [&](const recording::McapMetadataIndex& index) {
      const bool own = index.name == recorder::kCutMetadata || index.name == about_.prefix + recorder::kCutMetadata;
      const auto metadata = own ? reader_.metadata(index) : Problem{};
      // Joined parts have runs after the end of the first one.
      return metadata && recorder::number_in(metadata->values, recorder::kCutEnd) >= last;
    });
  }

  void forget_later() {
    facts_.tick = 0;
    facts_.stop_reason.clear();
    std::erase_if(facts_.overruns, [this](const auto& one) { return one.tick > last_tick_; });
    for (explain::ModuleFact& module : facts_.modules) {
      if (module.fault_tick > last_tick_) {
        module.fault.clear();
      }
    }
  }

  void conclude() {
    std::stable_sort(facts_.runs.begin(), facts_.runs.end(),
                     [](const auto& a, const auto& b) { return a.start_ns < b.start_ns; });
    std::uint64_t first = last_tick_;
    for (const explain::RunFact& run : facts_.runs) {
      first = std::min(first, run.tick);
    }
    facts_.first_tick = from_the_start() ? 0 : first + 1;
    facts_.closed = complete_;
    if (is_cut_off()) {
      forget_later();
    }
    // Facts from the begin of a recording that was not closed are too old.
    if (facts_.tick <= last_tick_) {
      facts_.tick = last_tick_ + 1;
      facts_.now_ns = facts_.runs.back().end_ns;
    }
    for (explain::ChangeFact& change : facts_.changes) {
      change.tick = facts_.tick_at(change.time_ns);
    }
  }

  recording::McapReader reader_;
  recorder::Sources sources_;
  std::size_t own_;
  const recorder::Source& about_;
  std::string variable_;
  std::string config_;
  struct Qualities {
    schema::Type type;  // of the variable
    std::vector<const QualityPlace*> places;
  };
  std::vector<QualityPlace> places_;
  std::map<std::uint16_t, Qualities> qualities_;  // by channel
  Facts facts_;
  std::map<std::uint32_t, std::uint64_t> first_numbers_;  // of runs, by module
  std::map<std::uint32_t, tape::RunTail> last_runs_;      // by module
  std::uint64_t last_tick_ = 0;
  bool complete_ = false;
};

}  // namespace

std::string two_recordings(const std::string& board, const std::string& file) {
  return fmt::format(
      "with {} there are two recordings of {}; give one of each board, and put parts of one together first: "
      "indurop recording join",
      file, board);
}

Result<std::vector<Facts>, Problem> facts_recorded(const std::filesystem::path& file, const std::string& variable) {
  std::vector<Facts> all;
  for (std::size_t sources = 1; all.size() < sources;) {
    auto reader = recording::McapReader::open(file);
    if (!reader) {
      return std::move(reader).error();
    }
    sources = recorder::find_sources(*reader).all.size();
    if (sources == 0) {
      return Problem{fmt::format("{} is no recording of a node", file.string())};
    }
    auto facts = Recorded(std::move(reader).value(), all.size(), variable).facts(file.string());
    if (!facts) {
      return std::move(facts).error();
    }
    all.push_back(std::move(facts).value());
  }
  return all;
}

}  // namespace indurop::tools
