// SPDX-License-Identifier: Apache-2.0
#include "node/run/loaded.h"

#include <set>

#include "core/base/print.h"
#include "node/run/setup.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;

// Returns false if some of the modules have errors, which were reported.
bool load_libraries(const Checked& checked, std::vector<ModuleLibrary>& libraries, const Console& console) {
  const config::Config& config = checked.config;
  libraries.reserve(config.modules.size() + scheduler::kSpareModules);
  libraries.resize(config.modules.size());
  std::set<std::filesystem::path> known;
  bool ok = true;
  for (std::uint32_t i = 0; i < config.modules.size(); ++i) {
    const config::Module& module = config.modules[i];
    if (module.type != ModuleType::Thread || checked.alone.value_or(i) != i) {
      continue;
    }
    runtime::set_current_module(i);
    if (const auto loaded = libraries[i].load(module.file, !known.insert(module.file).second); !loaded) {
      base::print(stderr, "{}\n",
                  base::to_string({base::Diagnostic::Severity::Error, config.file.string(), module.place,
                                   fmt::format("module {}: {}", module.name, loaded.error().text)}));
      ok = false;
    }
    runtime::set_current_module(runtime::kNoModule);
    if (module.operation == Operation::Sporadic && libraries[i].functions().run != nullptr &&
        !libraries[i].functions().condition) {
      console.about(module.name)
          .error("module {}: a sporadic thread module needs condition(): define `extern \"C\" int condition()`",
                 module.name);
      ok = false;
    }
  }
  return ok;
}

}  // namespace

Attached::~Attached() {
  if (held_) {
    runtime::detach_process();
  }
}

Result<Loaded, Ending> load(const Options& options, const Checked& checked, const Prepared& prepared,
                            const Console& console, base::StopSignal& signals) {
  if (auto ending = interruption(signals)) {
    return *std::move(ending);
  }
  auto problems = runtime::attach_process(*prepared.store, prepared.run());
  Loaded loaded;
  if (!load_libraries(checked, loaded.libraries, console)) {
    return Ending{kCheckFailed};
  }
  const auto late = runtime::take_binding_errors();
  problems.insert(problems.end(), late.begin(), late.end());
  for (const std::string& problem : problems) {
    console.error("{}", problem);
  }
  if (!problems.empty()) {
    return Ending{kSchemaMismatch};
  }
  loaded.tasks = make_tasks(checked.config, checked.check, prepared.setup, prepared.rights.core);
  if (options.simulation.on) {
    set_work_times(loaded.tasks, checked.config, options.simulation.measured);
  }
  for (scheduler::Task& task : loaded.tasks) {
    if (task.type == ModuleType::Thread) {
      task.run = loaded.libraries[task.index].functions().run;
      if (task.operation == Operation::Sporadic) {
        task.condition = loaded.libraries[task.index].functions().condition;
      }
    }
  }
  if (auto ending = interruption(signals)) {
    return *std::move(ending);
  }
  return loaded;
}

}  // namespace indurop::node
