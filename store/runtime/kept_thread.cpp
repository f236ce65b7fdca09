// SPDX-License-Identifier: Apache-2.0
#include "store/runtime/kept_thread.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/guard.h"
#include "store/runtime/process.h"
#include "store/tape/grown_array.h"
#include "store/tape/state_copy.h"

// A process module that declares what it keeps defines this function; the linker then exports it, because this library
// refers to it.
extern "C" [[gnu::weak]] void indurop_module_state(indurop::StateDescriptor* descriptor);

namespace indurop::runtime {
namespace {

constexpr std::int64_t kLongestSleepNs = 1'000'000'000;
constexpr std::int64_t kCopyPollNs = 20'000;

const std::byte* item_at(const StateDescriptor& declared, std::uint32_t index) {
  return reinterpret_cast<const std::byte*>(declared.items) + std::size_t{index} * declared.item_size;
}

StateItem item_of(const StateDescriptor& declared, std::uint32_t index) {
  StateItem item;
  std::memcpy(static_cast<void*>(&item), item_at(declared, index),
              std::min<std::size_t>(declared.item_size, sizeof item));
  return item;
}

bool has_functions(const StateDescriptor& declared) {
  return declared.save != nullptr && declared.restore != nullptr;
}

// Returns the description of the bytes of a keyframe, as the node's own ones have it (node/modules/module_memory.h);
// nothing: something cannot be copied.
std::optional<std::string> form_of(const StateDescriptor& declared, std::uint64_t& bytes) {
  std::string form;
  for (std::uint32_t i = 0; i < declared.item_count; ++i) {
    const StateItem item = item_of(declared, i);
    const std::string_view type(item.type, item.type_length);
    if (item.size == 0 || type.starts_with(kStateAddress) || type.starts_with(kStatePlace)) {
      return std::nullopt;
    }
    form.append(item.name, item.name_length).append("\t").append(type).append("\t");
    form.append(std::to_string(item.size)).append("\n");
    bytes += item.size;
  }
  if (has_functions(declared)) {
    form.append("\t").append(tape::kFormOfFunctions).append("\t").append(std::to_string(declared.most)).append("\n");
    bytes += declared.most;
  }
  return declared.missing == nullptr ? std::optional(form) : std::nullopt;
}

}  // namespace

std::unique_ptr<KeptThread> KeptThread::prepare(const std::string& node, std::uint32_t module,
                                                const scheduler::RunBlock& run) {
  StateDescriptor declared;
  if (&indurop_module_state == nullptr) {
    return nullptr;
  }
  indurop_module_state(&declared);
  std::uint64_t most = 0;
  const auto form = form_of(declared, most);
  auto file = form ? tape::ProcessKeyframes::create(node, module, run.node_pid.load(), {*form, most}) : Error{};
  if (!file) {
    return nullptr;  // as if it declared nothing
  }
  if (has_functions(declared)) {
    rt::install_guard_handlers();
  }
  std::unique_ptr<KeptThread> kept(new KeptThread(declared, run, std::move(file).value()));
  auto thread = rt::Thread::start({.name = "keyframes"}, [own = kept.get()] { own->answer(); });
  if (!thread) {
    return nullptr;
  }
  kept->thread_ = std::move(thread).value();
  return kept;
}

bool KeptThread::start(const std::string& node, std::uint32_t module, const tape::Track* track) {
  track_.store(track);
  return tape::ProcessKeyframes::set_running(node, module).ok();
}

KeptThread::~KeptThread() {
  ending_.store(true);
  file_.words().wake.wake();
}

// The other process waits, so the thread is not waited for, unless it is copying.
void KeptThread::hand_over() {
  ending_.store(true);
  while (is_copying_.exchange(true, std::memory_order_acquire)) {
    rt::sleep_until(rt::mono_time(rt::now_ns() + kCopyPollNs));
  }
  file_.words().hand_over.store(take() ? tape::HandOver::Written : tape::HandOver::Failed, std::memory_order_release);
}

bool KeptThread::take_over(const tape::ProcessKeyframes& from) {
  const std::string form = from.form();
  std::span<const std::uint8_t> bytes = from.newest();
  std::string_view rest = form;
  while (const auto line = tape::take_line(rest)) {
    if (line->type == tape::kFormOfFunctions) {
      return has_functions(declared_) && declared_.restore(bytes.data(), bytes.size());
    }
    if (line->size > bytes.size()) {
      return false;
    }
    put_back(*line, bytes.first(line->size));
    bytes = bytes.subspan(line->size);
  }
  return true;
}

// An array with more elements than in the other process keeps its own values in the new ones.
void KeptThread::put_back(const tape::FormLine& line, std::span<const std::uint8_t> bytes) {
  for (std::uint32_t i = 0; i < declared_.item_count; ++i) {
    const StateItem item = item_of(declared_, i);
    const std::string_view type(item.type, item.type_length);
    const bool same = type == line.type && item.size == bytes.size();
    if (std::string_view(item.name, item.name_length) == line.name &&
        (same || (tape::has_grown(line.type, type) && item.size > bytes.size()))) {
      std::memcpy(item.address, bytes.data(), bytes.size());
      return;
    }
  }
}

void KeptThread::answer() {
  tape::KeyframeRequestWords& words = file_.words();
  while (!ending_.load()) {
    (void)words.wake.wait_until(rt::mono_time(rt::now_ns() + kLongestSleepNs));
    const std::uint64_t asked = words.asked.load(std::memory_order_acquire);
    if (asked == words.answered.load(std::memory_order_relaxed) || ending_.load()) {
      continue;
    }
    if (is_copying_.exchange(true, std::memory_order_acquire)) {
      return;  // it is handed over
    }
    const bool done = words.puts_back.load(std::memory_order_relaxed) != 0 ? put_back() : take();
    is_copying_.store(false, std::memory_order_release);
    words.done.store(done ? 1 : 0, std::memory_order_relaxed);
    words.answered.store(asked, std::memory_order_release);
  }
}

// The copy counts if no run was being executed before it and none began until it was complete.
bool KeptThread::take() {
  const std::uint64_t before = entries_.load(std::memory_order_acquire);
  if (before % 2 != 0) {
    return false;
  }
  tape::KeyframeHead head;
  const tape::Track* const track = track_.load();
  head.run = track != nullptr ? track->runs() : 0;
  head.tick = run_.tick.load();
  head.time_ns = rt::to_ns(schedule_now());
  const std::span<std::byte> room = file_.room();
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < declared_.item_count; ++i) {
    const StateItem item = item_of(declared_, i);
    tape::copy_racing(room.data() + at, item.address, item.size);
    at += item.size;
  }
  const std::size_t by_functions =
      has_functions(declared_) ? tape::save_by_function(declared_, room.subspan(at, declared_.most)) : 0;
  head.bytes = at + by_functions;
  std::atomic_thread_fence(std::memory_order_acquire);
  const bool whole =
      (by_functions > 0 || !has_functions(declared_)) && entries_.load(std::memory_order_relaxed) == before;
  if (whole) {
    file_.publish(head);
  }
  return whole;
}

// In a replay, which releases no run meanwhile.
bool KeptThread::put_back() {
  const std::span<const std::byte> room = file_.room();
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < declared_.item_count; ++i) {
    const StateItem item = item_of(declared_, i);
    std::memcpy(item.address, room.data() + at, item.size);
    at += item.size;
  }
  const std::uint64_t bytes = file_.words().bytes.load(std::memory_order_relaxed);
  return !has_functions(declared_) || bytes <= at || declared_.restore(room.data() + at, bytes - at);
}

}  // namespace indurop::runtime
