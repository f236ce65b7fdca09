// SPDX-License-Identifier: Apache-2.0
#include "store/vars/call_exchange.h"

#include <algorithm>
#include <cstring>

#include "core/rt/clock.h"
#include "core/rt/shared_mutex.h"
#include "store/vars/call_state.h"

namespace indurop::vars {
namespace {

constexpr std::int64_t kServerCheckNs =
    5'000'000;  // interval at which a waiting caller checks that the server is alive

// The caller holds the slot's mutex. Returns true if no server is working on it.
bool make_free(CallSlot& slot) noexcept {
  std::uint64_t word = slot.state.load(std::memory_order_acquire);
  for (;;) {
    switch (state_of(word)) {
      case CallState::Free:
      case CallState::Done:
        return true;
      case CallState::Ready:  // its caller died before the server accepted it
        if (slot.state.compare_exchange_weak(word, word_of(sequence_of(word), CallState::Free))) {
          return true;
        }
        break;
      case CallState::Running:  // its caller died; the server frees it
        if (slot.state.compare_exchange_weak(word, word_of(sequence_of(word), CallState::Abandoned))) {
          return false;
        }
        break;
      default:
        return false;
    }
  }
}

CallSlot* take_slot(const CallArea& area, const CallFunction& function, Caller& caller) noexcept {
  for (std::uint32_t i = 0; i < kCallSlots; ++i) {
    const std::uint32_t index = (caller.first + i) % kCallSlots;
    CallSlot& slot = area.slot(function, index);
    const rt::LockResult result = rt::try_lock(slot.caller);
    if (!rt::is_locked(result) && result != rt::LockResult::HeldByCaller) {
      continue;
    }
    if (make_free(slot)) {
      caller.first = index;
      return &slot;
    }
    rt::unlock(slot.caller);
  }
  return nullptr;
}

// Abandons request `sequence`. Returns false if its answer has arrived meanwhile.
bool give_up(CallSlot& slot, std::uint64_t sequence) noexcept {
  std::uint64_t word = word_of(sequence, CallState::Ready);
  if (slot.state.compare_exchange_strong(word, word_of(sequence, CallState::Free))) {
    return true;
  }
  word = word_of(sequence, CallState::Running);
  return slot.state.compare_exchange_strong(word, word_of(sequence, CallState::Abandoned));
}

// Waits for the answer to `sequence`. Returns Ok if it has arrived.
Errc wait_for_answer(CallFunction& function, CallSlot& slot, std::uint64_t sequence, std::int64_t deadline) noexcept {
  for (;;) {
    (void)slot.reply.wait_until(rt::mono_time(std::min(deadline, rt::now_ns() + kServerCheckNs)));
    if (slot.state.load(std::memory_order_acquire) == word_of(sequence, CallState::Done)) {
      return Errc::Ok;
    }
    Errc code = find_call_server(function);
    if (code == Errc::Ok && rt::now_ns() >= deadline) {
      code = Errc::Timeout;
    }
    if (code != Errc::Ok) {
      return give_up(slot, sequence) ? code : Errc::Ok;
    }
  }
}

}  // namespace

Errc find_call_server(CallFunction& function) noexcept {
  switch (rt::try_lock(function.serving)) {
    case rt::LockResult::Timeout:
    case rt::LockResult::HeldByCaller:
      return Errc::Ok;
    case rt::LockResult::Broken:
      return Errc::Corrupt;
    case rt::LockResult::OwnerDied:
    case rt::LockResult::Locked:
      break;
  }
  // A server that ends normally clears its pid.
  const bool died = function.server_pid.load(std::memory_order_relaxed) != 0;
  rt::unlock(function.serving);
  return died ? Errc::Dead : Errc::NotFound;
}

Errc exchange_call(const CallArea& area, CallFunction& function, const CallBytes& call, Caller& caller) noexcept {
  const std::int64_t deadline = rt::now_ns() + std::max<std::int64_t>(call.deadline_ns, 0);
  CallSlot* slot = take_slot(area, function, caller);
  if (slot == nullptr) {
    return Errc::Busy;
  }
  caller.slot = slot;
  auto* bytes = reinterpret_cast<std::byte*>(slot);
  const std::uint64_t sequence = sequence_of(slot->state.load(std::memory_order_relaxed)) + 1;
  while (slot->reply.try_wait()) {  // wake-ups for callers that no longer waited for them
  }
  if (call.args_size > 0) {
    std::memcpy(bytes + kCallArgsOffset, call.args, call.args_size);
  }
  slot->state.store(word_of(sequence, CallState::Ready), std::memory_order_release);
  area.wake_of(function).wake.wake();

  Errc code = wait_for_answer(function, *slot, sequence, deadline);
  if (code == Errc::Ok) {
    code = static_cast<Errc>(slot->error.load(std::memory_order_relaxed));
    if (code == Errc::Ok && call.result_size > 0) {
      std::memcpy(call.result, bytes + function.result_offset, call.result_size);
    }
    slot->state.store(word_of(sequence, CallState::Free), std::memory_order_release);
    function.calls.fetch_add(1, std::memory_order_relaxed);
  } else {
    function.given_up.fetch_add(1, std::memory_order_relaxed);
  }
  caller.slot = nullptr;
  rt::unlock(slot->caller);
  return code;
}

void release_call(Caller& caller) noexcept {
  CallSlot* const slot = caller.slot;
  if (slot != nullptr) {
    caller.slot = nullptr;
    (void)make_free(*slot);
    rt::unlock(slot->caller);
  }
}

}  // namespace indurop::vars
