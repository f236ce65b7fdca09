// SPDX-License-Identifier: Apache-2.0
// The programs of process modules, and which process of a module runs.
#include <algorithm>
#include <utility>

#include "core/keys/digest.h"
#include "core/rt/clock.h"
#include "node/modules/processes.h"
#include "node/modules/trampoline.h"
#include "scheduler/module_version.h"

namespace indurop::node {
namespace {

// Of constant children, a constant one; null: the module has none.
template <class Children>
auto* find_in(Children& children, std::uint32_t module) noexcept {
  const auto found =
      std::find_if(children.begin(), children.end(), [module](const auto& child) { return child.index == module; });
  return found == children.end() ? nullptr : &*found;
}

}  // namespace

const Processes::Child* Processes::find(std::uint32_t module) const noexcept {
  return find_in(children_, module);
}

Processes::Child* Processes::find(std::uint32_t module) noexcept {
  return find_in(children_, module);
}

bool Processes::note_version(Child& child) {
  child.program.mark = mark_of(child.program.file);
  const auto found = keys::digest_of_file(child.program.file);
  const std::string digest = found ? found->digest : std::string();
  const std::string before = child.program.digest;
  if (run_.deployment[0] != '\0' && (digest.empty() || (!before.empty() && digest != before))) {
    console_.about(child.module->name)
        .error("module {}: it is not started again, because {} is not what was deployed: its SHA-256 is {}, it was {}",
               child.module->name, child.program.file.string(), digest.empty() ? "unknown" : digest, before);
    return false;
  }
  note_digest(child, digest);
  slot(child).version.store(child.program.version, std::memory_order_release);
  return true;
}

void Processes::note_digest(Child& child, const std::string& digest) {
  if (digest == child.program.digest) {
    return;
  }
  const bool is_first = child.program.digest.empty();
  const std::string file = std::filesystem::absolute(child.program.file).string();
  child.program.digest = digest;
  child.program.version = tape_ == nullptr || tape_->of(child.index) == nullptr ? 0
                          : is_first ? tape_->versions().add_first(child.index, digest, file)
                                     : tape_->versions().add(child.index, digest, file);
  scheduler::set_version(record(child), digest, is_first ? 0 : run_.tick.load(), scheduler::VersionState::Settled);
}

void Processes::set_file(std::uint32_t module, const std::filesystem::path& file, const std::string& digest) {
  Child& child = *find(module);
  child.program.file = file;
  note_digest(child, digest);
}

pid_t Processes::pid(std::uint32_t module) const noexcept {
  const Child* const child = find(module);
  return child == nullptr ? -1 : child->pid;
}

const Processes::Program& Processes::program(std::uint32_t module) const noexcept {
  return find(module)->program;
}

Result<pid_t> Processes::launch_next_to(std::uint32_t module, const std::filesystem::path& file) const {
  const Child& child = *find(module);
  return node::launch({file.string(), child.module->arguments, node_, std::to_string(module), child.module->core});
}

Processes::Program Processes::set_program(std::uint32_t module, Program program) {
  return std::exchange(find(module)->program, std::move(program));
}

void Processes::hold(std::uint32_t module, bool is_held) noexcept {
  if (Child* const child = find(module); child != nullptr) {
    child->held = is_held;
  }
}

Processes::Program Processes::replace(std::uint32_t module, pid_t pid, Program program) {
  Child& child = *find(module);
  child.pid = pid;
  child.killed_for_budget = false;
  child.killed_hanging = false;
  child.launched = rt::MonoClock::now();
  record(child).pid.store(pid, std::memory_order_release);
  record(child).state.store(scheduler::ModuleState::Running, std::memory_order_release);
  return set_program(module, std::move(program));
}

}  // namespace indurop::node
