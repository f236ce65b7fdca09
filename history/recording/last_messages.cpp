// SPDX-License-Identifier: Apache-2.0
#include "history/recording/last_messages.h"

#include <algorithm>
#include <vector>

namespace indurop::recording {
namespace {

bool can_hold(const Segment& segment, const std::set<MessageKey>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const MessageKey& key) {
    return segment.channels.empty() || std::ranges::find(segment.channels, key.first) != segment.channels.end();
  });
}

struct Found {
  LastMessage message;
  std::uint64_t offset = 0;  // of its chunk
};

struct Search {
  const std::function<std::uint32_t(std::uint32_t)>& part_of;
  std::uint64_t before_ns = 0;
  std::set<MessageKey> wanted;
  std::map<MessageKey, Found> found;

  // Chunks may overlap: what was found is the last one only if this chunk, and so all that remain, end before it.
  void leave_out_what_is_final(const Segment& next) {
    std::erase_if(wanted, [&](const MessageKey& key) {
      const auto one = found.find(key);
      return one != found.end() && one->second.message.log_time_ns > next.end_ns;
    });
  }

  void take(const LoadedSegment& segment, std::uint64_t offset) {
    std::set<MessageKey> here;
    for (auto entry = segment.messages.rbegin(); entry != segment.messages.rend() && here.size() < wanted.size();
         ++entry) {
      if (entry->log_time_ns >= before_ns) {
        continue;
      }
      const McapMessage message = segment.message(*entry);
      for (const std::uint32_t part : {part_of(message.sequence), kAnyPart}) {
        const MessageKey key(message.channel, part);
        if (wanted.contains(key) && here.insert(key).second) {
          note(key, message, offset);
        }
      }
    }
  }

  void note(const MessageKey& key, const McapMessage& message, std::uint64_t offset) {
    Found& one = found[key];
    const bool is_later = std::pair(message.log_time_ns, offset) >= std::pair(one.message.log_time_ns, one.offset);
    if (is_later) {
      one = {{message.sequence, message.log_time_ns, {message.data.view.begin(), message.data.view.end()}}, offset};
    }
  }
};

}  // namespace

std::map<MessageKey, LastMessage> last_messages(const McapReader& reader, std::uint64_t before_ns,
                                                std::set<MessageKey> wanted,
                                                const std::function<std::uint32_t(std::uint32_t)>& part_of) {
  // Those that end last come first. Of messages of the same time, the one that is later in the file is the last.
  std::vector<const Segment*> latest;
  for (const Segment& segment : reader.segments()) {
    if (segment.start_ns < before_ns) {
      latest.push_back(&segment);
    }
  }
  const auto rank = [](const Segment* one) { return std::pair(one->end_ns, one->offset); };
  std::sort(latest.begin(), latest.end(), [&](const Segment* a, const Segment* b) { return rank(a) > rank(b); });

  Search search{part_of, before_ns, std::move(wanted), {}};
  for (const Segment* segment : latest) {
    search.leave_out_what_is_final(*segment);
    if (!can_hold(*segment, search.wanted)) {
      continue;
    }
    if (const auto loaded = reader.load(*segment)) {
      search.take(*loaded, segment->offset);
    }
  }
  std::map<MessageKey, LastMessage> messages;
  for (auto& [key, one] : search.found) {
    messages.emplace(key, std::move(one.message));
  }
  return messages;
}

}  // namespace indurop::recording
