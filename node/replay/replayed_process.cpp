// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_process.h"

#include <algorithm>
#include <cstring>
#include <thread>

#include "core/rt/clock.h"
#include "store/tape/state_form.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kKeptPatience{5};
constexpr std::chrono::microseconds kKeptPoll{20};

// The bytes of the module's own functions among those of a keyframe, at its end; empty: it has none.
std::span<const std::uint8_t> functions_in(std::string_view form, std::span<const std::uint8_t> bytes) {
  std::size_t items = 0;
  while (const auto line = tape::take_line(form)) {
    if (line->type == tape::kFormOfFunctions) {
      return bytes.subspan(std::min(items, bytes.size()));
    }
    items += line->size;
  }
  return {};
}

}  // namespace

bool ReplayedProcess::open(const std::string& node, std::uint32_t module, std::int32_t node_pid) {
  keyframes_.reset();
  auto opened = tape::ProcessKeyframes::open(node, module, node_pid);
  if (opened) {
    keyframes_.emplace(std::move(opened).value());
  }
  return keyframes_.has_value();
}

bool ReplayedProcess::request(bool puts_back, std::uint64_t bytes) {
  tape::KeyframeRequestWords& words = keyframes_->words();
  words.puts_back.store(puts_back ? 1 : 0, std::memory_order_relaxed);
  words.bytes.store(bytes, std::memory_order_relaxed);
  const std::uint64_t asked = words.asked.load(std::memory_order_relaxed) + 1;
  words.asked.store(asked, std::memory_order_release);
  words.wake.wake();
  const rt::MonoTime until = rt::MonoClock::now() + kKeptPatience;
  while (words.answered.load(std::memory_order_acquire) != asked && rt::MonoClock::now() < until) {
    std::this_thread::sleep_for(kKeptPoll);
  }
  return words.answered.load(std::memory_order_acquire) == asked && words.done.load(std::memory_order_relaxed) != 0;
}

bool ReplayedProcess::take() {
  if (!keyframes_ || (!is_empty() && !request(false, 0))) {
    return false;
  }
  const auto newest = keyframes_->newest();
  bytes_.assign(newest.begin(), newest.end());
  form_ = keyframes_->form();
  items_.clear();
  std::size_t at = 0;
  std::string_view rest = form_;
  for (auto line = tape::take_line(rest); line && line->size <= bytes_.size() - at; line = tape::take_line(rest)) {
    if (line->type != tape::kFormOfFunctions) {
      items_.push_back({line->name.data(), static_cast<std::uint32_t>(line->name.size()),
                        static_cast<std::uint32_t>(line->type.size()), line->type.data(), bytes_.data() + at,
                        line->size});
      at += line->size;
    }
  }
  StateDescriptor declared;
  declared.items = items_.data();
  declared.item_count = static_cast<std::uint32_t>(items_.size());
  memory_ = ModuleMemory(declared);
  return true;
}

const ModuleMemory* ReplayedProcess::memory() {
  return take() ? &memory_ : nullptr;
}

std::optional<ReplayedProcess::State> ReplayedProcess::state() {
  return take() ? std::optional(State{form_, bytes_}) : std::nullopt;
}

// Items are put back by name, as in a thread module. The bytes of the module's own functions are its own affair.
std::vector<std::string> ReplayedProcess::restore(std::string_view form, std::span<const std::uint8_t> bytes) {
  const std::vector<std::string> all{"what it keeps"};
  if (!take()) {
    return all;
  }
  const auto of_functions = functions_in(form, bytes);
  const auto own_of_functions = functions_in(form_, bytes_);
  const std::vector<std::string> differing = memory_.restore(form, bytes.first(bytes.size() - of_functions.size()));
  if (!of_functions.empty() && !own_of_functions.empty()) {
    bytes_.resize(bytes_.size() - own_of_functions.size());
    bytes_.insert(bytes_.end(), of_functions.begin(), of_functions.end());
  }
  const std::span<std::byte> room = keyframes_->room();
  const std::size_t size = std::min(bytes_.size(), room.size());
  std::memcpy(room.data(), bytes_.data(), size);
  return request(true, size) ? differing : all;
}

}  // namespace indurop::node
