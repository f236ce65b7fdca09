// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/run_image.h"

#include <atomic>
#include <cstring>
#include <vector>

#include "core/base/json.h"
#include "core/rt/clock.h"
#include "core/schema/schema.h"
#include "scheduler/run_block.h"
#include "store/vars/custody.h"
#include "store/vars/held_value.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

namespace indurop::deploy {
namespace {

using base::Json;
using scheduler::OverrunEntry;
using scheduler::RunBlock;
using scheduler::SlotEntry;

// Copies a log; an entry that changes meanwhile is marked as being written.
template <class Entry>
void copy_log(const Entry* from, Entry* to, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t before = from[i].sequence.load(std::memory_order_acquire);
    std::memcpy(static_cast<void*>(to + i), static_cast<const void*>(from + i), sizeof(Entry));
    std::atomic_thread_fence(std::memory_order_acquire);
    const bool whole = from[i].sequence.load(std::memory_order_relaxed) == before;
    to[i].sequence.store(whole ? before : 0, std::memory_order_relaxed);
  }
}

class Image {
 public:
  Image(const RunBlock& block, std::uint64_t size) : block_(block), size_(size) {}

  // Returns an empty text if the block is invalid.
  std::string make() {
    const std::uint32_t count = block_.module_count;
    const std::uint64_t modules = place<scheduler::ModuleRecord>(block_.modules_offset, count);
    const std::uint64_t slots = place<SlotEntry>(block_.slot_log_offset, block_.slot_log_capacity);
    const std::uint64_t overruns = place<OverrunEntry>(block_.overrun_log_offset, block_.overrun_log_capacity);
    if (!sound_) {
      return {};
    }
    // Whole words, for the alignment of their content.
    std::vector<std::uint64_t> words((end_ + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
    auto* const bytes = reinterpret_cast<std::byte*>(words.data());
    std::memcpy(bytes, static_cast<const void*>(&block_), sizeof block_);
    std::memcpy(bytes + modules, static_cast<const void*>(block_.modules()), count * sizeof(scheduler::ModuleRecord));
    auto& image = *reinterpret_cast<RunBlock*>(bytes);
    copy_log(block_.at<SlotEntry>(block_.slot_log_offset), image.at<SlotEntry>(slots), block_.slot_log_capacity);
    copy_log(block_.at<OverrunEntry>(block_.overrun_log_offset), image.at<OverrunEntry>(overruns),
             block_.overrun_log_capacity);
    image.total_size = end_;
    image.module_count = count;
    image.modules_offset = modules;
    image.slot_log_offset = slots;
    image.overrun_log_offset = overruns;
    image.slots_offset = 0;
    image.rings_offset = 0;
    return {reinterpret_cast<const char*>(bytes), end_};
  }

 private:
  // Returns the position in the image.
  template <class T>
  std::uint64_t place(std::uint64_t offset, std::uint64_t count) {
    sound_ = sound_ && offset % alignof(T) == 0 && offset <= size_ && count <= (size_ - offset) / sizeof(T);
    const std::uint64_t begin = (end_ + alignof(T) - 1) / alignof(T) * alignof(T);
    end_ = sound_ ? begin + count * sizeof(T) : end_;
    return begin;
  }

  const RunBlock& block_;
  std::uint64_t size_;
  std::uint64_t end_ = sizeof(RunBlock);
  bool sound_ = true;
};

std::string block_of(const std::string& board) {
  const auto file = vars::RunFile::open(board, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(RunBlock));
  const auto* block = file ? static_cast<const RunBlock*>(file->data()) : nullptr;
  return block != nullptr && block->abi == scheduler::kRunAbi ? Image(*block, file->size()).make() : std::string();
}

}  // namespace

base::Json forces_to_json(const std::string& board) {
  using base::Json;
  Json list = Json::array();
  const auto store = vars::Store::attach(board, vars::Mode::ReadOnly);
  if (!store) {
    return list;
  }
  const rt::MonoTime now = store->now();
  const auto custody = vars::Custody::open(board, vars::Mode::ReadOnly);
  for (const vars::ForcedPart& part : vars::forced_parts(*store)) {
    const vars::ForceNote note =
        custody ? custody->note_of(*part.variable, part.offset).value_or(vars::ForceNote()) : vars::ForceNote();
    list.push_back({{"name", part.name},
                    {"value", schema::format_value(part.type, part.bytes)},
                    {"raw", Json::parse(schema::value_to_json(part.type, part.bytes)).value_or(Json())},
                    {"left_ns", part.until == vars::kForever ? Json() : Json((part.until - now).count())},
                    {"who", note.who},
                    {"from", note.from},
                    {"reason", note.reason},
                    {"lease", note.lease},
                    {"variable", store->schema().variables[part.variable->schema_index].name},
                    {"offset", part.offset},
                    {"size", part.bytes.size()}});
  }
  return list;
}

base::Json lock_to_json(const std::string& board) {
  const vars::LockNote note = vars::lock_of(board);
  return {{"lock", vars::word_of(note.lock)},
          {"who", note.who},
          {"from", note.from},
          {"reason", note.reason},
          {"wall_ns", note.wall_ns}};
}

std::string run_image(const std::string& board) {
  const Json head{{"running", vars::running_node(board) > 0},
                  {"now_ns", rt::now_ns()},
                  {"forces", forces_to_json(board)},
                  {"lock", lock_to_json(board)}};
  return head.dump() + "\n" + block_of(board);
}

}  // namespace indurop::deploy
