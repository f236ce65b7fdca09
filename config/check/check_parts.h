// SPDX-License-Identifier: Apache-2.0
// The parts check_config() and check_plant() are made of. Each looks at one side of the configuration and reports into
// the same list.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "config/check/check.h"
#include "config/check/uses.h"
#include "scheduler/response_time.h"
#include "scheduler/task.h"

namespace indurop::config {

// Reads each text once: a plant of many boards has the same in most of its modules.
class SchemaTexts {
 public:
  // Errors: those of schema::from_json.
  Result<std::shared_ptr<const schema::Schema>> read(const std::string& text);

 private:
  std::map<std::string, std::shared_ptr<const schema::Schema>, std::less<>> known_;
};

struct CheckContext {
  Config& config;
  CheckOptions options;
  CheckResult& result;
  base::Diagnostics report;
  SchemaTexts& texts;
};

// Basic and macro period, --adjust. Fills table, periodic, sporadic, non_real.
void check_schedule(CheckContext& context);
// After it, and after check_access() where files are looked at: cores of modules, number of bands, and whether what
// says how long it executes ends in time. Fills sharing, spreading, timings.
void check_load(CheckContext& context);
// What bands are made of: a task for each of CheckResult::periodic, in its order.
std::vector<scheduler::Task> periodic_tasks(const CheckContext& context);
// Parts of check_load().
void find_sharing(CheckContext& context);
void take_measured_times(CheckContext& context);
void place_modules(CheckContext& context);
void check_times(CheckContext& context);
scheduler::DispatchCost dispatch_cost(const Config& config, base::Nanos basic);
std::vector<int> usable_cores();  // by this process, ascending
// Cores, time that spinning leaves.
void check_machine(CheckContext& context);
// Files, ABI, symbols. Fills facts and schema.
void check_files(CheckContext& context);
// Who reads and writes which variable, order and age of data, fail-safe values. Fills uses and unknown_*. After the
// three above.
void check_access(CheckContext& context);

// Modules whose runs may differ in a simulation. After check_access().
void check_determinism(CheckContext& context);

// Do all modules that have a variable mean the same bytes, on whatever board they run.
void check_agreement(std::span<const BoardView> boards, base::Diagnostics& report);
// Variables that several modules write, none writes, or none reads. Nothing is missed of those `set_by_hand`.
void check_use(const Uses& uses, const std::set<std::string>& set_by_hand, base::Diagnostics& report);

// Are the files there, and libraries.
void check_type_libraries(const TypeFiles& named, base::Diagnostics& report);
// Brings the names in the rules to full names; removes rules for variables that do not exist.
void resolve_rules(std::vector<VariableRule>& rules, const schema::Schema& schema, base::Diagnostics& report);
// What rules say about tools of others. `shown`: there is an external plane. After resolve_rules().
void check_external_rules(const std::vector<VariableRule>& rules, bool shown, const Uses& uses,
                          base::Diagnostics& report);

// Types that programs of others are known to misread. For an external plane that is shown.
void check_foreign_types(const TypeFiles& named, const std::vector<VariableRule>& rules, const schema::Schema& schema,
                         base::Diagnostics& report);

// All of a module.xml. Returns the variables that tools may set.
std::set<std::string> check_external(CheckContext& context, const Uses& uses);

struct NamedFile {
  std::filesystem::path path;
  std::string as_written;
  const char* element;  // "<filename>"
};
// Why schema::read_module_file() failed and what to do; with `search` names that are near in the folder are proposed.
std::string unreadable_file(const Error& failure, const NamedFile& file, bool search);
void sort_by_severity(std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
