// SPDX-License-Identifier: Apache-2.0
// The caller's side of shared functions. A slot belongs to the holder of its robust mutex, so the slot of a killed
// caller simply passes to the next one; the state word then shows what must be cleaned up.

#include <indurop/detail/call.h>
#include <indurop/result.h>

#include <algorithm>
#include <cstring>

#include "core/rt/clock.h"
#include "core/rt/shared_mutex.h"
#include "store/runtime/call_server.h"
#include "store/runtime/call_state.h"
#include "store/runtime/host.h"
#include "store/runtime/process.h"

namespace indurop::runtime {

namespace {

using vars::CallFunction;
using vars::CallSlot;
using vars::CallState;

constexpr std::int64_t kServerCheckNs =
    5'000'000;  // interval at which a waiting caller checks that the server is alive

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): what a thread keeps from call to call
[[gnu::tls_model("initial-exec")]] thread_local CallSlot* t_slot = nullptr;  // held by this thread
[[gnu::tls_model("initial-exec")]] thread_local std::uint32_t t_first = 0;   // first slot to try
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

// Returns Ok if a server serves it, NotFound if there is none, Dead if the server died and no other has started.
Errc find_server(CallFunction& function) noexcept {
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

CallSlot* take_slot(const Attachment& attachment, const CallFunction& function) noexcept {
  for (std::uint32_t i = 0; i < vars::kCallSlots; ++i) {
    const std::uint32_t index = (t_first + i) % vars::kCallSlots;
    CallSlot& slot = attachment.slot(function, index);
    const rt::LockResult result = rt::try_lock(slot.caller);
    if (!rt::is_locked(result) && result != rt::LockResult::HeldByCaller) {
      continue;
    }
    if (make_free(slot)) {
      t_first = index;
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
    Errc code = find_server(function);
    if (code == Errc::Ok && rt::now_ns() >= deadline) {
      code = Errc::Timeout;
    }
    if (code != Errc::Ok) {
      return give_up(slot, sequence) ? code : Errc::Ok;
    }
  }
}

Errc exchange(const Attachment& attachment, CallFunction& function, const detail::CallRequest& request) noexcept {
  const std::int64_t deadline = rt::now_ns() + std::max<std::int64_t>(request.deadline_ns, 0);
  CallSlot* slot = take_slot(attachment, function);
  if (slot == nullptr) {
    return Errc::Busy;
  }
  t_slot = slot;
  auto* bytes = reinterpret_cast<std::byte*>(slot);
  const std::uint64_t sequence = sequence_of(slot->state.load(std::memory_order_relaxed)) + 1;
  while (slot->reply.try_wait()) {  // wake-ups for callers that no longer waited for them
  }
  if (request.args_size > 0) {
    std::memcpy(bytes + vars::kCallArgsOffset, request.args, request.args_size);
  }
  slot->state.store(word_of(sequence, CallState::Ready), std::memory_order_release);
  attachment.wake_of(function).wake.wake();

  Errc code = wait_for_answer(function, *slot, sequence, deadline);
  if (code == Errc::Ok) {
    code = static_cast<Errc>(slot->error.load(std::memory_order_relaxed));
    if (code == Errc::Ok && request.result_size > 0) {
      std::memcpy(request.result, bytes + function.result_offset, request.result_size);
    }
    slot->state.store(word_of(sequence, CallState::Free), std::memory_order_release);
    function.calls.fetch_add(1, std::memory_order_relaxed);
  } else {
    function.given_up.fetch_add(1, std::memory_order_relaxed);
  }
  t_slot = nullptr;
  rt::unlock(slot->caller);
  return code;
}

Errc call_now(const detail::CallRequest& request) noexcept {
  const Attachment* attachment = hot.attachment.load(std::memory_order_acquire);
  CallFunction* function = attachment != nullptr ? attachment->function(request.name_hash) : nullptr;
  if (function == nullptr) {
    return Errc::NotFound;
  }
  if (function->type_hash != request.type_hash || function->args_size != request.args_size ||
      function->result_size != request.result_size) {
    return Errc::TypeMismatch;
  }
  // A module's server thread cannot wait for itself.
  if (const detail::FunctionOffer* own = offer_of_this_server(request.name_hash)) {
    return invoke_contained(*own, request.args, request.result);
  }
  const Errc code = find_server(*function);
  return code == Errc::Ok ? exchange(*attachment, *function, request) : code;
}

// A repeated run gets the recorded answer.
Errc call(const detail::CallRequest& request) noexcept {
  const auto is_good = [](std::int64_t code) { return code == static_cast<std::int64_t>(Errc::Ok); };
  return static_cast<Errc>(answer(request.result, request.result_size, is_good,
                                  [&] { return static_cast<std::int64_t>(call_now(request)); }));
}

}  // namespace

void release_calls_of_this_thread() noexcept {
  CallSlot* slot = t_slot;
  if (slot != nullptr) {
    t_slot = nullptr;
    (void)make_free(*slot);
    rt::unlock(slot->caller);
  }
}

}  // namespace indurop::runtime

extern "C" int indurop_call(const indurop::detail::CallRequest* request) noexcept {
  return static_cast<int>(indurop::runtime::call(*request));
}
