// SPDX-License-Identifier: Apache-2.0
#include "node/replay/replayed_process.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <thread>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kKeptPatience{5};
constexpr std::chrono::microseconds kKeptPoll{20};

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
  for (std::string_view rest = form_; !rest.empty();) {
    const std::size_t name = rest.find('\t');
    const std::size_t type = name == std::string_view::npos ? name : rest.find('\t', name + 1);
    const std::size_t end = type == std::string_view::npos ? type : rest.find('\n', type);
    std::size_t size = 0;
    if (end == std::string_view::npos ||
        std::from_chars(rest.data() + type + 1, rest.data() + end, size).ec != std::errc() ||
        size > bytes_.size() - at) {
      break;
    }
    if (name > 0) {
      items_.push_back({rest.data(), static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(type - name - 1),
                        rest.data() + name + 1, bytes_.data() + at, size});
      at += size;
    }
    rest.remove_prefix(end + 1);
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

// Items are put back by name, as in a thread module. The bytes of the module's own functions are its own affair: they
// are put back as they are if all else has the same form.
std::vector<std::string> ReplayedProcess::restore(std::string_view form, std::span<const std::uint8_t> bytes) {
  const std::vector<std::string> all{"what it keeps"};
  if (!take()) {
    return all;
  }
  std::vector<std::string> differing;
  if (form == form_) {
    bytes_.assign(bytes.begin(), bytes.end());
  } else {
    differing = memory_.restore(form, bytes);
  }
  const std::span<std::byte> room = keyframes_->room();
  const std::size_t size = std::min(bytes_.size(), room.size());
  std::memcpy(room.data(), bytes_.data(), size);
  return request(true, size) ? differing : all;
}

}  // namespace indurop::node
