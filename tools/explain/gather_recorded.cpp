// SPDX-License-Identifier: Apache-2.0
// What a recording says: runs, values of one variable, and the facts beside them.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>

#include "explain/facts_json.h"
#include "recorder/run_words.h"
#include "recording/mcap_reader.h"
#include "tools/explain/gather.h"

namespace indurop::tools {
namespace {

using base::Problem;
using explain::Facts;

constexpr const char* kNodeMetadata = "indurop.node";
constexpr int kMostDamages = 1000;

std::int64_t number_of(const recording::TextMap& map, const std::string& key) {
  std::int64_t number = 0;
  if (const auto found = map.find(key); found != map.end()) {
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
  }
  return number;
}

std::string text_of(const recording::TextMap& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? std::string() : found->second;
}

class Recorded {
 public:
  Recorded(recording::McapReader reader, std::string variable)
      : reader_(std::move(reader)), variable_(std::move(variable)) {}

  Result<Facts, Problem> facts(const std::string& file) {
    if (!about_the_node()) {
      return Problem{fmt::format("{} is no recording of a node; give the recordings of the boards one by one", file)};
    }
    about_its_end();
    channels();
    messages();
    if (!facts_.runs.empty()) {
      conclude();
    }
    add_config(config_, facts_);
    return std::move(facts_);
  }

 private:
  bool about_the_node() {
    for (const auto& index : reader_.contents().metadata) {
      const auto about = index.name == kNodeMetadata ? reader_.metadata(index) : Problem{};
      if (about) {
        facts_.node = text_of(about->values, "node");
        facts_.board = text_of(about->values, "board");
        facts_.basic_period_ns = number_of(about->values, "basic_period_ns");
        facts_.wall_minus_node_ns = number_of(about->values, "real_minus_node_ns");
        config_ = text_of(about->values, "config");
        return facts_.basic_period_ns > 0;
      }
    }
    return false;
  }

  // Written when the recording was closed; one that was not has none.
  void about_its_end() {
    for (const auto& index : reader_.contents().attachments) {
      const auto bytes = index.name == explain::kFactsFile ? reader_.attachment(index) : Problem{};
      if (bytes) {
        complete_ =
            explain::read_facts({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, facts_) || complete_;
      }
    }
  }

  void channels() {
    for (const auto& [id, channel] : reader_.contents().channels) {
      if (channel.topic == recorder::kRunsTopic) {
        runs_channel_ = id;
        for (std::size_t i = 0; channel.metadata.contains(std::to_string(i)); ++i) {
          if (i >= facts_.modules.size()) {
            facts_.modules.emplace_back();
          }
          facts_.modules[i].name = channel.metadata.at(std::to_string(i));
        }
      }
      if (channel.topic == variable_) {
        variable_channel_ = id;
      }
    }
  }

  void messages() {
    std::map<std::uint32_t, std::vector<std::int64_t>> writes;  // by module: log times of new values
    for (int damages = 0; damages < kMostDamages;) {
      const auto message = reader_.next();
      if (!message) {
        ++damages;
        continue;
      }
      if (!*message) {
        return;
      }
      if ((*message)->channel == runs_channel_) {
        take_run(**message);
      } else if ((*message)->channel == variable_channel_ && variable_channel_ != 0) {
        take_value(**message);
      }
    }
  }

  void take_run(const recording::McapMessage& message) {
    const auto run = recorder::run_from_cdr(message.data.view);
    if (!run) {
      return;
    }
    first_number_ = facts_.runs.empty() ? run->tail.number : first_number_;
    last_tick_ = std::max(last_tick_, run->tail.tick);
    facts_.epoch_ns = run->tail.release_ns - static_cast<std::int64_t>(run->tail.tick) * facts_.basic_period_ns;
    if (run->module < facts_.modules.size()) {
      facts_.runs.push_back(
          {run->module, run->tail.tick, run->tail.release_ns, run->tail.start_ns, run->tail.end_ns, run->faulted});
    }
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

  void conclude() {
    std::stable_sort(facts_.runs.begin(), facts_.runs.end(),
                     [](const auto& a, const auto& b) { return a.start_ns < b.start_ns; });
    std::uint64_t first = last_tick_;
    for (const explain::RunFact& run : facts_.runs) {
      first = std::min(first, run.tick);
    }
    facts_.first_tick = first_number_ == 0 ? 0 : first + 1;
    facts_.closed = complete_;
    // Those at the begin of a recording that was not closed are too old.
    if (facts_.tick <= last_tick_) {
      facts_.tick = last_tick_ + 1;
      facts_.now_ns = facts_.runs.back().end_ns;
    }
    for (explain::ChangeFact& change : facts_.changes) {
      change.tick = facts_.tick_at(change.time_ns);
    }
  }

  recording::McapReader reader_;
  std::string variable_;
  std::string config_;
  Facts facts_;
  std::uint16_t runs_channel_ = 0;
  std::uint16_t variable_channel_ = 0;
  std::uint64_t first_number_ = 0;
  std::uint64_t last_tick_ = 0;
  bool complete_ = false;
};

}  // namespace

Result<Facts, Problem> facts_recorded(const std::filesystem::path& file, const std::string& variable) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  return Recorded(std::move(reader).value(), variable).facts(file.string());
}

}  // namespace indurop::tools
