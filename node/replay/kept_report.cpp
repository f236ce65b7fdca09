// SPDX-License-Identifier: Apache-2.0
#include "node/replay/kept_report.h"

#include "core/base/json.h"
#include "core/base/replace_file.h"
#include "node/replay/kept_text.h"
#include "store/tape/state_form.h"

namespace indurop::node {
namespace {

using base::Json;

const char* word_of(Knowledge knowledge) {
  switch (knowledge) {
    case Knowledge::Certain:
      return "known";
    case Knowledge::Doubtful:
      return "doubtful";
    case Knowledge::None:
      break;
  }
  return "unknown";
}

// Returns why that is not known for certain; empty: it is.
std::string reason_of(const ReplayedModule& module) {
  if (!module.why_not.empty()) {
    return module.why_not;
  }
  if (!module.kept.is_declared()) {
    return module.kept.why_none();
  }
  if (module.apart) {
    return "it faulted only in the recording or only now";
  }
  if (module.knowledge == Knowledge::Certain) {
    return "";
  }
  if (module.knowledge == Knowledge::None && module.kept.has_keyframes()) {
    return module.seen == 0 ? "it did not run" : "there is no keyframe before this tick";
  }
  return module.seen == 0 ? "it did not run" : module.kept.why_none();
}

// `form`: of the keyframe that was put back last.
bool has_functions(const ModuleMemory& memory, const std::string& form) {
  return memory.uses_functions() || form.find(tape::kFormOfFunctions) != std::string::npos;
}

Json items_of(const ModuleMemory& memory) {
  Json items = Json::array();
  for (const ModuleMemory::Item& item : memory.items()) {
    if (item.kind == ModuleMemory::Kind::Place || item.kind == ModuleMemory::Kind::Shown) {
      continue;
    }
    const std::span<const std::uint8_t> bytes(static_cast<const std::uint8_t*>(item.address), item.size);
    const std::string text = item.kind == ModuleMemory::Kind::Value ? kept_text(item.type, bytes) : memory.led_to(item);
    items.push_back({{"name", item.name}, {"type", item.type}, {"value", text}});
  }
  return items;
}

}  // namespace

Result<void, base::Problem> write_kept(const std::filesystem::path& file, std::uint64_t tick,
                                       const ReplayedModules& modules, const Comparison& comparison,
                                       const std::function<const ModuleMemory*(const ReplayedModule&)>& memory_of) {
  Json list = Json::array();
  for (const auto& module : modules.all()) {
    const bool known = module->runs && !module->apart && module->kept.is_declared() && !module->kept.is_empty();
    const ModuleMemory* const memory = known ? memory_of(*module) : nullptr;
    const bool shown = memory != nullptr || (module->runs && module->kept.is_empty());
    const Knowledge knowledge = shown ? module->knowledge : Knowledge::None;
    list.push_back({{"module", module->name},
                    {"state", word_of(knowledge)},
                    {"reason", reason_of(*module)},
                    {"by_functions", memory != nullptr && has_functions(*memory, module->kept.form())},
                    {"kept", knowledge == Knowledge::None || memory == nullptr ? Json::array() : items_of(*memory)}});
  }
  const Json report = {{"tick", tick}, {"differing", comparison.differences()}, {"modules", list}};
  if (const auto written = base::replace_file(file, report.dump(2), base::Durable::No); !written) {
    return base::Problem{base::cannot_write(file, written.error())};
  }
  return {};
}

}  // namespace indurop::node
