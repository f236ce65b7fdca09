// SPDX-License-Identifier: Apache-2.0
#include "scheduler/printed_messages.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>
#include <span>
#include <string_view>

namespace indurop::scheduler {
namespace {

// Returns an array of this type, if it lies completely in the block.
template <class T>
std::span<const T> objects(const RunBlock& block, std::uint64_t offset, std::uint64_t count, std::uint64_t total) {
  const bool good =
      offset >= sizeof block && offset % alignof(T) == 0 && offset <= total && count <= (total - offset) / sizeof(T);
  return good ? std::span(block.at<T>(offset), count) : std::span<const T>();
}

// Tickets count messages of a ring; twice around it an entry's sequence goes from free to filled to free again
// (store/runtime/message_ring.cpp). An entry is copied, and kept only if it was not reused for another message
// meanwhile.
template <class Keep>
void read_ring(const MessageRing& ring, std::span<const MessageEntry> entries, const Keep& keep) {
  const std::uint64_t head = ring.head.load(std::memory_order_acquire);
  for (std::uint64_t ticket = head - std::min<std::uint64_t>(head, entries.size()); ticket < head; ++ticket) {
    const MessageEntry& entry = entries[ticket % entries.size()];
    const std::uint64_t free = ticket / entries.size() * 2;
    const std::uint64_t sequence = entry.sequence.load(std::memory_order_acquire);
    if (sequence != free + 1 && sequence != free + 2) {
      continue;
    }
    MessageEntry copy{};
    detail::copy_from_shared(&copy.module, &entry.module, sizeof copy - offsetof(MessageEntry, module));
    std::atomic_thread_fence(std::memory_order_acquire);
    if (ring.head.load(std::memory_order_relaxed) - ticket <= entries.size()) {
      keep(copy.module, copy.time_ns, std::string_view(copy.text, std::min<std::size_t>(copy.length, kMessageText)));
    }
  }
}

}  // namespace

std::vector<PrintedMessage> printed_messages(const RunBlock& block, std::uint64_t size, std::uint32_t module_count,
                                             std::size_t most) {
  std::vector<PrintedMessage> all;
  const auto keep = [&](std::uint32_t module, std::int64_t time_ns, std::string_view text) {
    all.push_back(
        {std::min(module, module_count), time_ns, std::string(text.substr(0, text.find_last_not_of("\r\n") + 1))});
  };
  for (const MessageRing& ring : objects<MessageRing>(block, block.rings_offset, block.module_capacity + 1ULL, size)) {
    const auto entries = objects<MessageEntry>(block, ring.entries_offset, ring.capacity, size);
    if (!entries.empty()) {
      read_ring(ring, entries, keep);
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(std::min(all.size(), most)));
  return all;
}

}  // namespace indurop::scheduler
