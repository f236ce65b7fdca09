// SPDX-License-Identifier: Apache-2.0
// The parts of check_config() and check_plant(). Each checks one aspect of the configuration; all report into the same
// list.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/check/uses.h"
#include "core/base/diagnostics.h"
#include "scheduler/response_time.h"
#include "scheduler/task.h"

namespace indurop::config {

// Parses each schema text only once: most modules of a plant contain the same text.
class SchemaTexts {
 public:
  // Errors: as schema::from_json.
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

// Checks the basic and macro period; applies --adjust. Fills table, periodic, sporadic, non_real.
void check_schedule(CheckContext& context);
// Checks cores of modules, number of bands, and whether modules with a known execution time end in time. Call it after
// check_schedule(), and after check_data_flow() if files are checked. Fills sharing, spreading, timings.
void check_load(CheckContext& context);
// Returns the tasks from which bands are made: one for each of CheckResult::periodic, in its order.
std::vector<scheduler::Task> periodic_tasks(const CheckContext& context);
// Parts of check_load().
void find_sharing(CheckContext& context);
void take_measured_times(CheckContext& context);
void place_modules(CheckContext& context);
void check_times(CheckContext& context);
scheduler::DispatchCost dispatch_cost(const Config& config, base::Nanos basic);
std::vector<int> usable_cores();  // cores this process may use, ascending
// Checks cores and the time that spinning leaves.
void check_machine(CheckContext& context);
// Checks files, ABI and symbols. Fills facts and schema.
void check_files(CheckContext& context);
// Checks which modules read and write which variable, order and age of data, and fail-safe values. Fills uses and
// unknown_*. Call it after the three checks above.
void check_data_flow(CheckContext& context);

// Reports modules whose runs may differ in a simulation. Call it after check_data_flow().
void check_determinism(CheckContext& context);

// Reports modules that do not declare what they keep. Fills undeclared. Call it after check_files().
void check_kept(CheckContext& context);

// Checks that all modules that share a variable use the same layout of it, on all boards.
void check_agreement(std::span<const BoardView> boards, base::Diagnostics& report);
// Reports variables that several modules write, that none writes, or that none reads. Variables in `set_by_hand` need
// no writer.
void check_writers(const Uses& uses, const std::set<std::string>& set_by_hand, base::Diagnostics& report);

// Returns why a library of types cannot be used by boards with these options; empty if it can: it has to exist, to be a
// library, and to be built for the board.
std::string type_library_problem(const TypeFiles& named, std::size_t library, const CheckOptions& options);
// Replaces the names in the rules by full names; removes rules for variables that do not exist.
void resolve_rules(std::vector<VariableRule>& rules, const schema::Schema& schema, base::Diagnostics& report);
// Checks the rules for third-party tools. `shown`: there is an external plane. Call it after resolve_rules().
void check_external_rules(const std::vector<VariableRule>& rules, bool shown, const Uses& uses,
                          base::Diagnostics& report);

// Reports types that third-party programs are known to misread. Call it only if there is an external plane.
void check_foreign_types(const TypeFiles& named, const std::vector<VariableRule>& rules, const schema::Schema& schema,
                         base::Diagnostics& report);

// Runs all checks of the external plane of a module.xml. Returns the variables that tools may set.
std::set<std::string> check_external(CheckContext& context, const Uses& uses);

struct NamedFile {
  std::filesystem::path path;
  std::string as_written;
  const char* element;  // "<filename>"
};
// Returns why schema::read_module_file() failed and what to do; with `search` it proposes similar names in the folder.
std::string unreadable_file(const Error& failure, const NamedFile& file, bool search);
// Returns "is built for ..." and what to do if a file for this ELF machine cannot run where the options say; else
// empty.
std::string machine_problem(std::uint16_t machine, const CheckOptions& options);
void sort_by_severity(std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::config
