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
#include "core/schema/kept_notes.h"

namespace indurop::config {
namespace {

constexpr std::size_t kShownOwn = 4;

// Modules that are neither repeated nor exchanged have no use for a declaration.
bool may_be_asked(const Module& module, const schema::ModuleFile& file) {
  return module.operation != scheduler::Operation::NonReal && module.signal == 0 && !is_io_module(file);
}

constexpr const char* kLost = "there is no keyframe of it, and an exchange begins with initial values";

// Returns what is missing and what to do, or nothing.
std::string missing(const Module& module, const schema::ModuleFile& file) {
  if (!may_be_asked(module, file)) {
    return "";
  }
  const auto notes = schema::read_kept_notes(module.file);
  if (notes && !notes->undeclarable.empty()) {
    return fmt::format("keeps what its declaration cannot contain ({}): {}; keep it in another way",
                       notes->undeclarable, kLost);
  }
  const bool declares =
      std::binary_search(file.exports.begin(), file.exports.end(), std::string("indurop_module_state"));
  if (!declares && module.type == scheduler::ModuleType::Process) {
    return fmt::format(
        "is a process that does not declare what it keeps from run to run, so there is no keyframe of it; write "
        "INDUROP_STATE(...) with the names of its variables ({}), or INDUROP_STATE() if it keeps nothing",
        file.variables.empty() ? "local variables of main() cannot be declared"
                               : base::enumerate(file.variables, kShownOwn));
  }
  const bool unknown = file.variables.empty() && notes && notes->stripped;
  if (declares || (file.variables.empty() && !unknown)) {
    return "";
  }
  if (unknown) {
    return fmt::format(
        "is stripped, so its variables are not known, and does not declare what it keeps from run to run: {}; write "
        "INDUROP_STATE(...) with the names of what it keeps, or INDUROP_STATE() if it keeps nothing",
        kLost);
  }
  return fmt::format(
      "has variables of its own ({}) and does not declare which of them it keeps from run to run: {}; write "
      "INDUROP_STATE(...) with their names, or INDUROP_STATE() if it keeps none",
      base::enumerate(file.variables, kShownOwn), kLost);
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
