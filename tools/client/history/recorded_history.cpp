// SPDX-License-Identifier: Apache-2.0
#include "tools/client/history/recorded_history.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/omg_idl.h"

namespace indurop::tools {
namespace {

// What begins so long before the wanted time shows which modules write a variable, and which run was the last one.
constexpr std::int64_t kRunUpNs = 1'000'000'000;

void add_once(std::vector<std::uint32_t>& modules, std::uint32_t module) {
  if (std::ranges::count(modules, module) == 0) {
    modules.push_back(module);
  }
}

class RecordedReader {
 public:
  RecordedReader(recording::McapReader reader, const RecordedNode& file, const RecordedRequest& request)
      : reader_(std::move(reader)), request_(&request) {
    find_channels(file.prefix);
  }

  HistoryFindings read() {
    reader_.seek(static_cast<std::uint64_t>(std::max<std::int64_t>(file_time(request_->span.begin_ns) - kRunUpNs, 0)));
    std::int64_t time = request_->span.begin_ns - kRunUpNs;
    for (;;) {
      auto message = reader_.next();
      if (!message) {
        lost_from_ = lost_from_.value_or(time);
        continue;
      }
      const std::int64_t before = time;
      time = *message ? static_cast<std::int64_t>((*message)->log_time_ns) + request_->shift_ns : request_->span.end_ns;
      if (lost_from_) {
        add_gap_of_all({*lost_from_ + 1, time});
        lost_from_.reset();
      }
      if (!*message || time >= request_->span.end_ns || (time != before && is_enough(time))) {
        found_.complete_ns = std::min(time, request_->span.end_ns);
        break;
      }
      take(**message, time);
    }
    return finish();
  }

 private:
  // The values of one variable.
  struct Channel {
    const HistoryItem* variable = nullptr;
    std::vector<std::uint32_t> items;
    std::vector<std::uint32_t> modules;  // those that read or write it
    std::vector<std::uint32_t> writers;

    // Modules that only read a variable may show a value a little later than it was: they count if no module writes it.
    [[nodiscard]] bool is_known_by(std::uint32_t module) const {
      return std::ranges::count(writers.empty() ? modules : writers, module) > 0;
    }
  };
  struct Found {
    HistoryValue value;
    std::uint32_t module = 0;
    bool first = false;  // a value from before any module was started
  };
  struct LastRun {
    std::uint64_t number = 0;
    std::int64_t end_ns = 0;
  };

  [[nodiscard]] std::int64_t file_time(std::int64_t time_ns) const noexcept { return time_ns - request_->shift_ns; }

  void find_channels(const std::string& prefix) {
    const auto& contents = reader_.contents();
    for (const auto& [id, channel] : contents.channels) {
      if (channel.topic == prefix + std::string(recorder::kRunsTopic)) {
        runs_ = id;
      }
      const auto schema = contents.schemas.find(channel.schema);
      for (std::uint32_t item = 0; item < request_->items->size(); ++item) {
        const HistoryItem& wanted = (*request_->items)[item];
        if (request_->wanted[item] && schema != contents.schemas.end() &&
            channel.topic == prefix + wanted.declared->name &&
            schema->second.data == recording::omg_idl(wanted.declared->type).text) {
          channels_[id].variable = &wanted;
          channels_[id].items.push_back(item);
        }
      }
    }
  }

  [[nodiscard]] bool is_enough(std::int64_t time_ns) const noexcept {
    return time_ns > request_->counted_ns && (values_ >= request_->most || messages_ >= request_->messages);
  }

  void take(const recording::McapMessage& message, std::int64_t time_ns) {
    messages_ += time_ns >= request_->counted_ns ? 1U : 0U;
    if (message.channel == runs_) {
      take_run(message);
      return;
    }
    if (const auto channel = channels_.find(message.channel); channel != channels_.end()) {
      take_value(channel->second, message, time_ns);
    }
  }

  void take_run(const recording::McapMessage& message) {
    const auto run = recorder::run_from_cdr(message.data.view);
    if (!run) {
      return;
    }
    const std::int64_t end = static_cast<std::int64_t>(message.log_time_ns) + request_->shift_ns;
    const auto [last, is_first] = last_runs_.try_emplace(run->module);
    if (!is_first && run->tail.number > last->second.number + 1) {
      const std::int64_t begin = end - (run->tail.end_ns - run->tail.start_ns);
      for (const auto& [id, channel] : channels_) {
        if (channel.is_known_by(run->module)) {
          add_gap(channel, {last->second.end_ns + 1, begin});
        }
      }
    }
    last->second = {run->tail.number, end};
  }

  void take_value(Channel& channel, const recording::McapMessage& message, std::int64_t time_ns) {
    const recorder::ValueWords words = recorder::from_sequence(message.sequence);
    add_once(channel.modules, words.module);
    if (words.kind == tape::EntryKind::After) {
      add_once(channel.writers, words.module);
    }
    bytes_.resize(channel.variable->declared->type.size());
    if (time_ns < request_->span.begin_ns ||
        !recording::from_cdr(channel.variable->declared->type, message.data.view, bytes_)) {
      return;
    }
    for (const std::uint32_t item : channel.items) {
      const auto part = (*request_->items)[item].part_of(bytes_);
      std::vector<std::uint8_t>& last = last_[{item, words.module}];
      if (!std::ranges::equal(part, last)) {
        last.assign(part.begin(), part.end());
        values_ += time_ns >= request_->counted_ns ? 1U : 0U;
        all_.push_back({{time_ns, item, last}, words.module, words.kind == tape::EntryKind::Run});
      }
    }
  }

  void add_gap(const Channel& channel, const TimeSpan& gap) {
    const TimeSpan cut = gap.cut_to(request_->span);
    for (const std::uint32_t item : channel.items) {
      if (!cut.empty()) {
        found_.gaps.push_back({item, cut});
        std::erase_if(last_, [item](const auto& one) { return one.first.first == item; });
      }
    }
  }

  void add_gap_of_all(const TimeSpan& gap) {
    for (const auto& [id, channel] : channels_) {
      add_gap(channel, gap);
    }
  }

  HistoryFindings finish() {
    std::vector<const Channel*> by_item(request_->items->size());
    for (const auto& [id, channel] : channels_) {
      for (const std::uint32_t item : channel.items) {
        by_item[item] = &channel;
      }
    }
    for (Found& one : all_) {
      if (one.first || by_item[one.value.item]->is_known_by(one.module)) {
        found_.values.push_back(std::move(one.value));
      }
    }
    return std::move(found_);
  }

  recording::McapReader reader_;
  const RecordedRequest* request_;
  std::uint16_t runs_ = 0;
  std::map<std::uint16_t, Channel> channels_;
  std::map<std::uint32_t, LastRun> last_runs_;                                         // by module
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint8_t>> last_;  // by item and module
  std::vector<Found> all_;
  std::vector<std::uint8_t> bytes_;
  std::optional<std::int64_t> lost_from_;  // a damaged part of the file begins after this time
  std::size_t values_ = 0;
  std::size_t messages_ = 0;
  HistoryFindings found_;
};

}  // namespace

HistoryFindings read_recorded(const RecordedNode& file, const RecordedRequest& request) {
  auto reader = recording::McapReader::open(file.file);
  if (!reader) {
    HistoryFindings none;
    none.complete_ns = request.span.end_ns;
    for (std::uint32_t item = 0; item < request.wanted.size(); ++item) {
      if (request.wanted[item]) {
        none.gaps.push_back({item, request.span});
      }
    }
    return none;
  }
  return RecordedReader(std::move(*reader), file, request).read();
}

}  // namespace indurop::tools
