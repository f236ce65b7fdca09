// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_values.h"

#include <fmt/format.h>
#include <indurop/detail/freshness.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "deploy/agent/run_image.h"
#include "deploy/words/node_texts.h"
#include "history/alarms/alarm_list.h"
#include "scheduler/printed_messages.h"
#include "store/vars/node_lock.h"
#include "store/vars/run_file.h"
#include "store/vars/store.h"

namespace indurop::deploy {
namespace {

using base::Json;

constexpr std::size_t kMaxMessages = 200;

std::string layout_of(const vars::Store& store) {
  return fmt::format("{:016x}", store.layout_hash());
}

std::int64_t freshness_of(const vars::Store& store, const vars::DirectoryEntry& entry, std::int64_t now_ns) {
  void* const at = store.entry(entry.name_hash, entry.type_hash);
  const std::int64_t confirmed = at != nullptr ? abi::confirmed_of(at, entry.kind).load(std::memory_order_acquire) : 0;
  if (confirmed == 0) {
    return 0;
  }
  if (confirmed == abi::kNeverConfirmed) {
    return kNeverHeard;
  }
  const std::int64_t age = std::max<std::int64_t>(0, now_ns - (confirmed > 0 ? confirmed : -confirmed)) + 1;
  return confirmed > 0 ? age : -age;
}

// Returns an empty text if it is too large.
std::string bytes_of(const vars::Store& store, std::int64_t now_ns) {
  std::string all;
  std::vector<std::uint8_t> bytes;
  for (const schema::Variable& variable : store.schema().variables) {
    const auto* const entry = store.find(variable.name_hash());
    const std::size_t size = variable.type.size();
    if (all.size() + sizeof(std::int64_t) + size > kMaxValuesBytes) {
      return {};
    }
    bytes.assign(size, 0);
    const bool read = entry != nullptr && store.read(*entry, 0, bytes).ok();
    const std::int64_t freshness = read ? freshness_of(store, *entry, now_ns) : kNotRead;
    all.append(reinterpret_cast<const char*>(&freshness), sizeof freshness);
    all.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return all;
}

// Returns the names of the modules; nothing if the block is invalid.
std::optional<std::vector<std::string>> modules_of(const scheduler::RunBlock& block, std::uint64_t size) {
  using scheduler::ModuleRecord;
  const bool good = block.abi == scheduler::kRunAbi && block.modules_offset % alignof(ModuleRecord) == 0 &&
                    block.modules_offset <= size &&
                    block.module_count <= (size - block.modules_offset) / sizeof(ModuleRecord);
  if (!good) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < block.module_count; ++i) {
    const char* const name = block.modules()[i].name;
    names.emplace_back(name, ::strnlen(name, sizeof block.modules()[i].name));
  }
  return names;
}

}  // namespace

std::string BoardValues::variables() const {
  const auto store = vars::Store::attach(board_, vars::Mode::ReadOnly);
  if (!store) {
    return {};
  }
  std::string text = Json{{"layout", layout_of(*store)}}.dump() + "\n" + schema::to_json(store->schema());
  return text.size() > kMaxValuesBytes ? std::string() : text;
}

const std::string& BoardValues::values(rt::MonoTime now) {
  if (now < kept_until_) {
    return kept_;
  }
  kept_.clear();
  kept_until_ = now + kKeep;
  const auto store = vars::Store::attach(board_, vars::Mode::ReadOnly);
  if (!store) {
    return kept_;
  }
  journal_.refresh();
  const std::int64_t now_ns = store->now().time_since_epoch().count();
  const std::string bytes = bytes_of(*store, now_ns);
  if (bytes.empty() && !store->schema().variables.empty()) {
    return kept_;
  }
  const Json head{{"layout", layout_of(*store)},
                  {"running", vars::running_node(board_) > 0},
                  {"now_ns", now_ns},
                  {"forces", forces_to_json(board_)},
                  {"lock", lock_to_json(board_)},
                  {"alarms", json_of(journal_.book().counts())}};
  kept_ = head.dump() + "\n" + bytes;
  return kept_;
}

std::string messages_text(const std::string& board) {
  Json list = Json::array();
  const auto file = vars::RunFile::open(board, vars::Mode::ReadOnly, scheduler::kRunMagic, sizeof(scheduler::RunBlock));
  const auto* const block = file ? static_cast<const scheduler::RunBlock*>(file->data()) : nullptr;
  const auto names = block != nullptr ? modules_of(*block, file->size()) : std::nullopt;
  if (names) {
    const auto count = static_cast<std::uint32_t>(names->size());
    for (const auto& one : scheduler::printed_messages(*block, file->size(), count, kMaxMessages)) {
      list.push_back(
          {{"who", one.module < count ? (*names)[one.module] : "node"}, {"time_ns", one.time_ns}, {"text", one.text}});
    }
  }
  return Json{{"epoch_ns", names ? block->epoch_ns.load() : 0},
              {"basic_period_ns", names ? block->basic_period_ns : 0},
              {"messages", std::move(list)}}
      .dump();
}

}  // namespace indurop::deploy
