// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/run_view.h"

#include <algorithm>
#include <cstring>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"

namespace indurop::tools {
namespace {

constexpr std::uint32_t kMostModules = 100'000;

// Returns the begin of `count` objects if they all are inside `total` bytes and aligned, else null.
template <class T>
const T* inside(const scheduler::RunBlock& block, std::uint64_t offset, std::uint64_t count,
                std::uint64_t total) noexcept {
  const bool good = offset >= sizeof(scheduler::RunBlock) && offset % alignof(T) == 0 && offset <= total &&
                    count <= (total - offset) / sizeof(T);
  return good ? block.at<T>(offset) : nullptr;
}

SlotSample plain(const scheduler::SlotEntry& entry, std::uint64_t number) {
  return {number, entry.tick, entry.slot, entry.module, entry.release_ns, entry.start_ns, entry.end_ns};
}

OverrunSample plain(const scheduler::OverrunEntry& entry, std::uint64_t number) {
  return {number,           entry.tick,     entry.slot,        entry.module,      entry.own_ns,
          entry.latency_ns, entry.previous, entry.previous_ns, entry.started != 0};
}

// Entry n is complete while `sequence` is n + 1; the copy is kept only if that was so before and after copying.
template <class Sample, class Entry>
std::vector<Sample> read_log(const Entry* ring, std::uint64_t capacity, std::uint64_t next, std::uint64_t most) {
  std::vector<Sample> out;
  const std::uint64_t count = std::min({capacity, next, most});
  out.reserve(count);
  for (std::uint64_t number = next - count; number < next; ++number) {
    const Entry& entry = ring[number % capacity];
    if (entry.sequence.load(std::memory_order_acquire) != number + 1) {
      continue;
    }
    const Sample sample = plain(entry, number);
    std::atomic_thread_fence(std::memory_order_acquire);
    if (entry.sequence.load(std::memory_order_relaxed) == number + 1) {
      out.push_back(sample);
    }
  }
  return out;
}

}  // namespace

bool RunView::check(const scheduler::RunBlock& block, std::uint64_t file_size, Checked& out) noexcept {
  const std::uint64_t total = block.total_size;
  out.total = total;
  out.module_count = block.module_count;
  out.slot_capacity = block.slot_log_capacity;
  out.overrun_capacity = block.overrun_log_capacity;
  if (total > file_size || out.module_count > kMostModules) {
    return false;
  }
  out.modules = inside<scheduler::ModuleRecord>(block, block.modules_offset, out.module_count, total);
  out.slots = inside<scheduler::SlotEntry>(block, block.slot_log_offset, out.slot_capacity, total);
  out.overruns = inside<scheduler::OverrunEntry>(block, block.overrun_log_offset, out.overrun_capacity, total);
  return out.modules != nullptr && out.slots != nullptr && out.overruns != nullptr;
}

Result<RunView> RunView::checked(std::shared_ptr<void> memory, std::uint64_t size) {
  const auto* block = static_cast<const scheduler::RunBlock*>(memory.get());
  if (block->abi != scheduler::kRunAbi) {
    return Error{Errc::VersionMismatch, 0, "run block of another version"};
  }
  Checked found;
  if (!check(*block, size, found)) {
    return Error{Errc::Corrupt, 0, "run block damaged"};
  }
  return RunView(std::move(memory), found);
}

Result<RunView> RunView::open(const std::string& node, vars::Mode mode) {
  auto opened = vars::RunFile::open(node, mode, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  if (!opened.ok()) {
    return opened.error();
  }
  const auto mapping = std::make_shared<const vars::RunFile>(std::move(opened).value());
  auto view = checked({mapping, mapping->data()}, mapping->size());
  if (view) {
    view->node_ = node;
  }
  return view;
}

Result<RunView> RunView::from_image(std::string_view bytes, bool alive, std::int64_t now_ns) {
  if (bytes.size() < sizeof(scheduler::RunBlock)) {
    return Error{Errc::Corrupt, 0, "run block cut off"};
  }
  const auto words = std::make_shared<std::vector<std::uint64_t>>(bytes.size() / sizeof(std::uint64_t) + 1);
  std::memcpy(words->data(), bytes.data(), bytes.size());
  auto view = checked({words, words->data()}, bytes.size());
  if (view) {
    view->elsewhere_ = Elsewhere{alive, now_ns};
  }
  return view;
}

scheduler::ModuleRecord& RunView::module_to_command(std::uint32_t index) noexcept {
  auto* block = static_cast<scheduler::RunBlock*>(memory_.get());
  return *block->at<scheduler::ModuleRecord>(static_cast<std::uint64_t>(
      reinterpret_cast<const std::byte*>(checked_.modules + index) - reinterpret_cast<const std::byte*>(block_)));
}

const scheduler::ModuleRecord& RunView::module(std::uint32_t index) const noexcept {
  return block_->modules()[index];
}

std::string RunView::module_name(std::int64_t index) const {
  return index >= 0 && index < checked_.module_count ? fixed_text(module(static_cast<std::uint32_t>(index)).name) : "?";
}

std::int64_t RunView::now_ns() const noexcept {
  return elsewhere_ ? elsewhere_->now_ns : rt::now_ns();
}

bool RunView::node_alive() const {
  if (elsewhere_) {
    return elsewhere_->alive;
  }
  const pid_t pid = vars::running_node(node_);
  return pid != 0 && pid == block_->node_pid.load(std::memory_order_relaxed);
}

std::vector<SlotSample> RunView::slot_log(std::uint64_t most) const {
  return read_log<SlotSample>(checked_.slots, checked_.slot_capacity,
                              block_->slot_log_next.load(std::memory_order_acquire), most);
}

std::vector<OverrunSample> RunView::overrun_log(std::uint64_t most) const {
  return read_log<OverrunSample>(checked_.overruns, checked_.overrun_capacity,
                                 block_->overrun_log_next.load(std::memory_order_acquire), most);
}

}  // namespace indurop::tools
