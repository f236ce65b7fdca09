// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/duration.h"
#include "history/recorder/copy.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recording/mcap_reader.h"
#include "history/recording/mcap_writer.h"

namespace indurop::recorder {
namespace {

using base::Problem;

// A message that owns its bytes.
struct Kept {
  recording::McapMessage head;
  recording::Bytes bytes;
};

Kept keep(const recording::McapMessage& message) {
  return {message, {message.data.view.begin(), message.data.view.end()}};
}

// The state of one module, from the messages so far.
struct Module {
  std::vector<Kept> pending;            // since its last run
  std::map<std::uint16_t, Kept> known;  // by channel
};

std::uint64_t begin_of(const recording::Contents& contents) {
  std::uint64_t begin = UINT64_MAX;
  for (const recording::Segment& segment : contents.segments) {
    begin = std::min(begin, segment.start_ns);
  }
  return begin;
}

class Cutter {
 public:
  Cutter(recording::McapReader reader, recording::McapWriter writer)
      : reader_(std::move(reader)), writer_(std::move(writer)), sources_(find_sources(reader_)) {}

  Result<Cut, Problem> run(std::int64_t from_ns, std::int64_t to_ns) {
    auto channels = copy_frame(reader_, "", writer_);
    if (!channels) {
      return std::move(channels).error();
    }
    channels_ = *std::move(channels);
    const std::uint64_t begin = begin_of(reader_.contents());
    from_ = begin + static_cast<std::uint64_t>(from_ns);
    to_ = to_ns == 0 ? UINT64_MAX : begin + static_cast<std::uint64_t>(to_ns);
    if (auto copied = copy(); !copied) {
      return std::move(copied).error();
    }
    recording::TextMap metadata_values{{"from", base::format_duration(std::chrono::nanoseconds(from_ns))},
                                       {"begins_with_first_run", cut_.from_first_run ? "yes" : "no"}};
    if (more_) {
      metadata_values[kCutEnd] = std::to_string(to_);
    }
    auto written = writer_.metadata(kCutMetadata, metadata_values);
    if (written) {
      written = writer_.close();
    }
    return written ? Result<Cut, Problem>(cut_) : std::move(written).error();
  }

 private:
  Result<void, Problem> copy() {
    for (;;) {
      auto next = reader_.next();
      if (!next) {
        return std::move(next).error();
      }
      more_ = *next && (*next)->log_time_ns > to_;
      if (!*next || more_) {
        return {};
      }
      if (auto taken = take(**next); !taken) {
        return taken;
      }
    }
  }

  Result<void, Problem> take(const recording::McapMessage& message) {
    const auto place = sources_.channels.find(message.channel);
    if (place == sources_.channels.end()) {
      return discard_unowned(message);
    }
    const ChannelPlace& channel = place->second;
    if (channel.kind == ChannelKind::Run) {
      return take_run(channel.source, message);
    }
    const ValueWords words = from_sequence(message.sequence);
    if (words.kind == tape::EntryKind::Run) {
      firsts_.insert_or_assign(message.channel, keep(message));  // before any module was started
    } else {
      modules_[{channel.source, words.module}].pending.push_back(keep(message));
    }
    return {};
  }

  // In a third-party file each message is independent.
  Result<void, Problem> discard_unowned(const recording::McapMessage& message) {
    if (message.log_time_ns < from_) {
      firsts_.insert_or_assign(message.channel, keep(message));
      return {};
    }
    auto begun = begin();
    return begun ? write(keep(message)) : begun;
  }

  Result<void, Problem> take_run(std::size_t source, const recording::McapMessage& message) {
    const auto run = run_from_cdr(message.data.view);
    if (!run) {
      return Problem{"a run of the recording is damaged"};
    }
    Module& module = modules_[{source, run->module}];
    if (message.log_time_ns < from_) {
      forget(module);
      return {};
    }
    if (auto begun = begin(); !begun) {
      return begun;
    }
    for (const Kept& each : module.pending) {
      if (auto written = write(each); !written) {
        return written;
      }
    }
    module.pending.clear();
    ++cut_.runs;
    return write(keep(message));
  }

  // A run that is left out: its values are known from now on.
  void forget(Module& module) {
    cut_.from_first_run = false;
    for (Kept& each : module.pending) {
      if (const auto place = sources_.channels.find(each.head.channel); place->second.kind == ChannelKind::Value) {
        const std::uint16_t channel = each.head.channel;
        firsts_.insert_or_assign(channel, each);
        module.known.insert_or_assign(channel, std::move(each));
      }
    }
    module.pending.clear();
  }

  // Writes the known values, before the earliest message that follows.
  Result<void, Problem> begin() {
    if (begun_) {
      return {};
    }
    begun_ = true;
    std::uint64_t at = from_;
    for (const auto& [whose, module] : modules_) {
      for (const Kept& each : module.pending) {
        at = std::min(at, each.head.log_time_ns);
      }
    }
    for (auto& [channel, kept] : firsts_) {
      kept.head.sequence = to_sequence({kOthers, tape::EntryKind::Run});
      kept.head.log_time_ns = cut_.from_first_run ? kept.head.log_time_ns : at;
      if (auto written = write(kept); !written) {
        return written;
      }
    }
    for (auto& [whose, module] : modules_) {
      for (auto& [channel, kept] : module.known) {
        kept.head.sequence = to_sequence({whose.second, tape::EntryKind::Before});
        kept.head.log_time_ns = at;
        if (auto written = write(kept); !written) {
          return written;
        }
      }
    }
    cut_.messages = 0;
    return {};
  }

  Result<void, Problem> write(const Kept& kept) {
    ++cut_.messages;
    return writer_.write(channels_[kept.head.channel], kept.head.log_time_ns, kept.head.publish_time_ns,
                         kept.head.sequence, kept.bytes);
  }

  recording::McapReader reader_;
  recording::McapWriter writer_;
  Sources sources_;
  ChannelMap channels_;
  std::uint64_t from_ = 0;
  std::uint64_t to_ = 0;
  std::map<std::uint16_t, Kept> firsts_;                             // by channel: the latest before the cut
  std::map<std::pair<std::size_t, std::uint32_t>, Module> modules_;  // by source and number
  bool begun_ = false;
  bool more_ = false;  // than was copied
  Cut cut_;
};

}  // namespace

Result<Cut, Problem> cut(const std::filesystem::path& file, std::int64_t from_ns, std::int64_t to_ns,
                         const std::filesystem::path& to) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  auto writer = recording::McapWriter::create(to, {});
  if (!writer) {
    return std::move(writer).error();
  }
  auto done = Cutter(std::move(reader).value(), std::move(writer).value()).run(from_ns, to_ns);
  if (done && done->messages == 0) {
    done = Problem{fmt::format("{}: nothing was recorded between these times", file.string())};
  }
  if (!done) {
    std::error_code ignored;
    std::filesystem::remove(to, ignored);
  }
  return done;
}

}  // namespace indurop::recorder
