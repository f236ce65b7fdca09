// SPDX-License-Identifier: Apache-2.0

#include "store/runtime/message_ring.h"

#include <indurop/detail/variable_access.h>

#include <algorithm>

#include "store/runtime/host.h"

namespace indurop::runtime {

namespace {

using scheduler::MessageEntry;
using scheduler::MessageRing;
using scheduler::RunBlock;

struct TicketEntry {
  MessageEntry* entry;
  std::uint64_t free;  // sequence of the entry when free for this ticket; + 1 when filled
};

TicketEntry place_of(RunBlock& run, const MessageRing& ring, std::uint64_t ticket) noexcept {
  auto* entries = run.at<MessageEntry>(ring.entries_offset);
  return {entries + ticket % ring.capacity, ticket / ring.capacity * 2};
}

std::uint32_t ring_index(const RunBlock& run, std::uint32_t module) noexcept {
  return module < run.module_count ? module : run.module_capacity;
}

}  // namespace

bool push_message(RunBlock& run, std::uint32_t module, std::string_view text, rt::MonoTime time) noexcept {
  MessageRing& ring = run.rings()[ring_index(run, module)];
  if (ring.capacity == 0) {
    return false;
  }
  std::uint64_t ticket = ring.head.load(std::memory_order_relaxed);
  TicketEntry place{};
  for (;;) {
    place = place_of(run, ring, ticket);
    const std::uint64_t sequence = place.entry->sequence.load(std::memory_order_acquire);
    if (sequence == place.free) {
      if (ring.head.compare_exchange_weak(ticket, ticket + 1, std::memory_order_relaxed)) {
        break;
      }
    } else if (sequence < place.free) {
      ring.dropped.fetch_add(1, std::memory_order_relaxed);
      if (module < run.module_count) {
        run.modules()[module].lost_messages.fetch_add(1, std::memory_order_relaxed);
      }
      return false;
    } else {
      ticket = ring.head.load(std::memory_order_relaxed);
    }
  }
  std::atomic_thread_fence(std::memory_order_release);  // readers must see the ticket taken before any of its text
  const std::size_t length = std::min(text.size(), scheduler::kMessageText);
  const std::uint32_t words[2] = {module, static_cast<std::uint32_t>(length)};
  detail::copy_to_shared(&place.entry->module, words, sizeof words);
  const std::int64_t stamp = rt::to_ns(time);
  detail::copy_to_shared(&place.entry->time_ns, &stamp, sizeof stamp);
  detail::copy_to_shared(place.entry->text, text.data(), length);
  // Fails if the reader abandoned this entry because this thread was stopped for too long.
  return place.entry->sequence.compare_exchange_strong(place.free, place.free + 1, std::memory_order_release,
                                                       std::memory_order_relaxed);
}

MessageReader::MessageReader(RunBlock& run) : run_(run), stuck_(std::size_t{run.module_capacity} + 1) {}

bool MessageReader::has_any() const noexcept {
  for (std::size_t i = 0; i < stuck_.size(); ++i) {
    const MessageRing& ring = run_.rings()[i];
    if (ring.head.load(std::memory_order_relaxed) != ring.tail.load(std::memory_order_relaxed)) {
      return true;
    }
  }
  return false;
}

bool MessageReader::next(Message& message, rt::MonoTime now) {
  const auto rings = static_cast<std::uint32_t>(stuck_.size());
  for (std::uint32_t i = 0; i < rings; ++i) {
    if (next_of(at_, message, now)) {
      return true;
    }
    at_ = (at_ + 1) % rings;
  }
  return false;
}

bool MessageReader::next_of(std::uint32_t index, Message& message, rt::MonoTime now) {
  MessageRing& ring = run_.rings()[index];
  while (ring.capacity != 0) {
    const std::uint64_t ticket = ring.tail.load(std::memory_order_relaxed);
    TicketEntry place = place_of(run_, ring, ticket);
    std::uint64_t sequence = place.entry->sequence.load(std::memory_order_acquire);
    if (sequence == place.free + 1) {
      detail::copy_from_shared(&copy_.module, &place.entry->module, sizeof copy_ - offsetof(MessageEntry, module));
      place.entry->sequence.store(place.free + 2, std::memory_order_release);
      ring.tail.store(ticket + 1, std::memory_order_relaxed);
      message = {copy_.module,
                 rt::mono_time(copy_.time_ns),
                 {copy_.text, std::min<std::size_t>(copy_.length, scheduler::kMessageText)}};
      return true;
    }
    if (ring.head.load(std::memory_order_relaxed) == ticket) {
      return false;
    }
    // A producer took the ticket and has not filled the entry.
    Stuck& stuck = stuck_[index];
    if (stuck.ticket != ticket + 1) {
      stuck = {ticket + 1, now};
    }
    if (now - stuck.since < kUnfinishedMessage) {
      return false;
    }
    if (place.entry->sequence.compare_exchange_strong(sequence, place.free + 2, std::memory_order_acq_rel)) {
      ring.tail.store(ticket + 1, std::memory_order_relaxed);
      ring.dropped.fetch_add(1, std::memory_order_relaxed);
    }
  }
  return false;
}

std::uint64_t MessageReader::lost() const noexcept {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < stuck_.size(); ++i) {
    sum += run_.rings()[i].dropped.load(std::memory_order_relaxed);
  }
  return sum;
}

}  // namespace indurop::runtime
