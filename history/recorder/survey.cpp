// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/survey.h"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "history/recorder/run_words.h"

namespace indurop::recorder {
namespace {

using base::Problem;
using Whose = std::pair<std::size_t, std::uint32_t>;  // source and module

struct Counted {
  std::uint64_t messages = 0;
  std::set<Whose> modules;
};

class Surveyor {
 public:
  explicit Surveyor(Survey& to) : to_(to) {}

  void take(const recording::McapMessage& message) {
    const auto time = static_cast<std::int64_t>(message.log_time_ns);
    to_.begin_ns = to_.messages == 0 ? time : std::min(to_.begin_ns, time);
    to_.end_ns = std::max(to_.end_ns, time);
    ++to_.messages;
    Counted& channel = channels_[message.channel];
    ++channel.messages;
    const auto place = to_.sources.channels.find(message.channel);
    if (place == to_.sources.channels.end()) {
      return;
    }
    if (place->second.kind == ChannelKind::Run) {
      take_run(place->second.source, message);
    } else if (const ValueWords words = from_sequence(message.sequence); words.module != kOthers) {
      channel.modules.insert({place->second.source, words.module});
    }
  }

  void add(const recording::Contents& contents) {
    for (auto& [whose, module] : modules_) {
      to_.modules.push_back(module);
    }
    for (const auto& [id, channel] : contents.channels) {
      SurveyedChannel one;
      one.name = channel.topic;
      if (const auto schema = contents.schemas.find(channel.schema); schema != contents.schemas.end()) {
        one.type = schema->second.name;
      }
      if (const auto unit = channel.metadata.find("unit"); unit != channel.metadata.end()) {
        one.unit = unit->second;
      }
      const Counted& counted = channels_[id];
      one.messages = counted.messages;
      for (const Whose& whose : counted.modules) {
        const auto module = modules_.find(whose);
        one.dropped += module == modules_.end() ? 0 : module->second.lost;
      }
      to_.channels.push_back(std::move(one));
    }
  }

 private:
  void take_run(std::size_t source, const recording::McapMessage& message) {
    const auto run = run_from_cdr(message.data.view);
    if (!run || run->module == kOthers) {
      return;
    }
    SurveyedModule& module = modules_[{source, run->module}];
    std::uint64_t& next = next_[{source, run->module}];
    const std::uint64_t number = run->tail.number;
    if (module.runs == 0) {
      module.source = source;
      module.name = module_name(to_.sources.all[source], run->module);
      module.first_tick = run->tail.tick;
      module.before = number;
    } else if (number > next) {
      module.lost += number - next;
    }
    next = std::max(next, number + 1);
    module.last_tick = std::max(module.last_tick, run->tail.tick);
    ++module.runs;
    module.faults += run->faulted ? 1U : 0U;
  }

  Survey& to_;
  std::map<std::uint16_t, Counted> channels_;
  std::map<Whose, SurveyedModule> modules_;
  std::map<Whose, std::uint64_t> next_;
};

}  // namespace

Result<Survey, Problem> survey(const std::filesystem::path& file) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  Survey survey;
  survey.sources = find_sources(*reader);
  std::error_code ignored;
  survey.bytes = std::filesystem::file_size(file, ignored);
  survey.closed = reader->contents().has_summary;
  for (const recording::McapAttachmentIndex& attachment : reader->contents().attachments) {
    const std::vector<std::string>& names = survey.attachments;
    if (std::find(names.begin(), names.end(), attachment.name) == names.end()) {  // a later one replaces an earlier one
      survey.attachments.push_back(attachment.name);
    }
  }
  Surveyor surveyor(survey);
  survey.damages = reader->each([&surveyor](const recording::McapMessage& message) { surveyor.take(message); });
  surveyor.add(reader->contents());
  return survey;
}

}  // namespace indurop::recorder
