// SPDX-License-Identifier: Apache-2.0
// Names the modules that do not declare what they keep from one run to the next: no keyframe has it, and no exchange
// carries it.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "config/check/check_parts.h"
#include "config/check/io_access.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr std::size_t kShownOwn = 4;

// Modules that are neither repeated nor exchanged have no use for a declaration.
bool may_be_asked(const Module& module, const schema::ModuleFile& file) {
  return module.operation != scheduler::Operation::NonReal && module.signal == 0 && !is_io_module(file);
}

// Returns what is missing and what to do, or nothing. A module without symbols of variables is not suspected.
std::string missing(const Module& module, const schema::ModuleFile& file) {
  if (!may_be_asked(module, file)) {
    return "";
  }
  if (module.type == scheduler::ModuleType::Process) {
    return "is a process, of which no keyframe is taken: a replay that begins in the middle of a recording does not "
           "know what it keeps; a thread module can declare it (INDUROP_STATE)";
  }
  const bool declares =
      std::binary_search(file.exports.begin(), file.exports.end(), std::string("indurop_module_state"));
  if (declares || file.variables.empty()) {
    return "";
  }
  return fmt::format(
      "has variables of its own ({}) and does not declare which of them it keeps from run to run: there is no keyframe "
      "of it, and an exchange begins with initial values; write INDUROP_STATE(...) with their names, or "
      "INDUROP_STATE() "
      "if it keeps none",
      base::enumerate(file.variables, kShownOwn));
}

}  // namespace

void check_kept(CheckContext& context) {
  const auto& modules = context.config.modules;
  for (std::size_t i = 0; i < modules.size() && i < context.result.facts.size(); ++i) {
    if (const std::string text = missing(modules[i], context.result.facts[i].file); !text.empty()) {
      context.result.undeclared.push_back(i);
      context.report.note(modules[i].places.file, "module " + modules[i].name + " " + text);
    }
  }
}

}  // namespace indurop::config
