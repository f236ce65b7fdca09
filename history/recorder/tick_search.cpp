// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/tick_search.h"

#include <algorithm>
#include <vector>

#include "history/recorder/run_words.h"

namespace indurop::recorder {
namespace {

class TickSearch {
 public:
  TickSearch(const recording::McapReader& reader, std::uint16_t runs) : reader_(reader), runs_(runs) {
    for (const recording::Segment& segment : reader.segments()) {
      const auto& channels = segment.channels;
      if (channels.empty() || std::ranges::find(channels, runs) != channels.end()) {
        parts_.push_back(&segment);
      }
    }
  }

  std::optional<std::uint64_t> find(std::uint64_t tick) {
    std::size_t low = 0;
    std::size_t high = parts_.size();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (reaches(middle, tick)) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    // A part counts as reaching a tick if the one before it does.
    for (std::size_t part = low == 0 ? 0 : low - 1; part < parts_.size(); ++part) {
      if (const auto time = first_time(part, tick)) {
        return time;
      }
    }
    return std::nullopt;
  }

 private:
  // Calls `use` with the runs of a part, in the order of their ends, until it returns false.
  template <class Use>
  void each_run(std::size_t part, Use use) const {
    const auto loaded = reader_.load(*parts_[part]);
    if (!loaded) {
      return;
    }
    for (const auto& entry : loaded->messages) {
      const recording::McapMessage message = loaded->message(entry);
      const auto run = message.channel == runs_ ? run_from_cdr(message.data.view) : Error{};
      if (run && run->module != kOthers && !use(*run, message.log_time_ns)) {
        return;
      }
    }
  }

  // Returns whether a run of this tick or a later one is in the part or just before it. The last runs of a part may be
  // late ones of earlier ticks, and a damaged part has none: so the nearest readable ones before it count as well.
  [[nodiscard]] bool reaches(std::size_t part, std::uint64_t tick) const {
    std::size_t readable = 0;
    for (std::size_t i = part + 1; i-- > 0 && readable < 2;) {
      bool any = false;
      bool reached = false;
      each_run(i, [&](const RunWords& run, std::uint64_t /*time*/) {
        any = true;
        reached = run.tail.tick >= tick;
        return !reached;
      });
      if (reached) {
        return true;
      }
      readable += any ? 1U : 0U;
    }
    return false;
  }

  [[nodiscard]] std::optional<std::uint64_t> first_time(std::size_t part, std::uint64_t tick) const {
    std::optional<std::uint64_t> found;
    each_run(part, [&](const RunWords& run, std::uint64_t time) {
      found = run.tail.tick >= tick ? std::optional(time) : std::nullopt;
      return !found;
    });
    return found;
  }

  const recording::McapReader& reader_;
  std::uint16_t runs_;
  std::vector<const recording::Segment*> parts_;
};

}  // namespace

std::optional<std::uint64_t> time_of_tick(const recording::McapReader& reader, std::uint16_t runs, std::uint64_t tick) {
  return TickSearch(reader, runs).find(tick);
}

}  // namespace indurop::recorder
