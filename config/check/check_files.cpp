// SPDX-License-Identifier: Apache-2.0
// Checks module files: they must exist, be readable, fit this machine and ABI, and have the functions that their kind
// of module needs.

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "config/check/check_parts.h"
#include "config/check/io_access.h"
#include "core/base/nearest.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

using scheduler::ModuleType;
using scheduler::Operation;

struct Machine {
  std::uint16_t number = 0;
  const char* name = "";
  const char* arch = "";  // as manifests name it
};
constexpr Machine kMachines[] = {
    {3, "32-bit x86"}, {40, "32-bit ARM"}, {62, "x86-64", "amd64"}, {183, "AArch64", "arm64"}, {243, "RISC-V"}};
#if defined(__x86_64__)
constexpr std::uint16_t kThisMachine = 62;
#elif defined(__aarch64__)
constexpr std::uint16_t kThisMachine = 183;
#elif defined(__riscv)
constexpr std::uint16_t kThisMachine = 243;
#else
#error "unknown processor: add its ELF machine number here"
#endif

std::string machine_name(std::uint16_t number) {
  for (const Machine& machine : kMachines) {
    if (machine.number == number) {
      return machine.name;
    }
  }
  return "machine number " + std::to_string(number);
}

bool is_for(std::uint16_t number, const std::string& arch) {
  return std::any_of(std::begin(kMachines), std::end(kMachines),
                     [&](const Machine& machine) { return machine.number == number && machine.arch == arch; });
}

bool has(const std::vector<std::string>& sorted, const std::string& name) {
  return std::binary_search(sorted.begin(), sorted.end(), name);
}

bool imports_of(const schema::ModuleFile& file, const std::string& prefix) {
  const auto found = std::lower_bound(file.imports.begin(), file.imports.end(), prefix);
  return found != file.imports.end() && found->starts_with(prefix);
}

// Returns the text after "no such file": the missing folder, or the most similar name in the folder.
std::string missing_hint(const std::filesystem::path& file, const std::string& element) {
  std::error_code ignored;
  const std::filesystem::path folder = file.parent_path();
  if (!std::filesystem::is_directory(folder, ignored)) {
    return "; there is no folder " + base::path_in_quotes(folder.string());
  }
  constexpr std::size_t kMaxEntries = 10'000;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end && names.size() < kMaxEntries;
       entry.increment(ignored)) {
    if (!entry->is_directory(ignored)) {
      names.push_back(entry->path().filename().string());
    }
  }
  std::sort(names.begin(), names.end());
  const std::string near = base::nearest(file.filename().string(), names);
  return near.empty() ? "; build it, or correct " + element : "; did you mean " + base::path_in_quotes(near) + "?";
}

bool is_script(const std::filesystem::path& file) {
  char head[2] = {};
  std::ifstream stream(file, std::ios::binary);
  return stream.read(head, sizeof head) && head[0] == '#' && head[1] == '!';
}

class FileCheck {
 public:
  FileCheck(CheckContext& context, const Module& module, ModuleFacts& facts)
      : report_(context.report),
        texts_(context.texts),
        options_(context.options),
        module_(module),
        facts_(facts),
        place_(module.places.file) {}

  void run() {
    std::error_code ignored;
    if (std::filesystem::is_directory(module_.file, ignored)) {
      error("is a directory; give the module's file in it");
      return;
    }
    // Not opened: opening a pipe without a writer would block.
    if (std::filesystem::exists(module_.file, ignored) && !std::filesystem::is_regular_file(module_.file, ignored)) {
      error("is not an ordinary file; give the module's file");
      return;
    }
    if (module_.type == ModuleType::Process && is_script(module_.file)) {
      check_executable();
      check_wake_up();
      return;
    }
    auto read = schema::read_module_file(module_.file);
    if (!read) {
      report_.error(place_, unreadable_file(read.error(), {module_.file, module_.file_as_written, "<filename>"},
                                            !report_.full()) +
                                not_deployed(read.error()));
      return;
    }
    facts_.file = std::move(read.value());
    if (const std::string problem = machine_problem(facts_.file.machine, options_); !problem.empty()) {
      error(problem);
      return;
    }
    check_abi();
    read_schema();
    if (module_.type == ModuleType::Thread) {
      check_thread();
    } else {
      check_process();
    }
  }

 private:
  // Each board reads the modules of all boards, to know who writes which variable.
  [[nodiscard]] std::string not_deployed(const Error& failure) const {
    return !options_.board.empty() && failure.code == Errc::NotFound &&
                   std::filesystem::path(module_.file_as_written).is_absolute()
               ? "; a file with an absolute name is not deployed: copy it to every board, or give a name relative to "
                 "the manifest"
               : "";
  }
  void error(const std::string& text) {
    report_.error(place_, base::path_in_quotes(module_.file_as_written) + " " + text);
  }
  void warning(const std::string& text) {
    report_.warning(place_, base::path_in_quotes(module_.file_as_written) + " " + text);
  }

  void check_abi() {
    if (facts_.file.abi == schema::kMixedAbi) {
      error("contains parts built with different InduRoP versions; rebuild all of it");
    } else if (facts_.file.abi != 0 && facts_.file.abi != abi::kVersion) {
      error("is built for InduRoP ABI " + std::to_string(facts_.file.abi) + ", this is ABI " +
            std::to_string(abi::kVersion) + "; build it again with this version's headers");
    }
  }

  void read_schema() {
    if (facts_.file.schema_json.empty()) {
      return;
    }
    auto read = texts_.read(facts_.file.schema_json);
    facts_.file.schema_json.clear();
    if (read) {
      facts_.schema = std::move(read.value());
    } else if (read.error().code == Errc::VersionMismatch) {
      error("describes its variables in the format of another InduRoP version; rebuild it with this one");
    } else {
      error("has a damaged description of its variables; build it again");
    }
  }

  void check_thread() {
    const schema::ModuleFile& file = facts_.file;
    if (!file.shared_object) {
      error("is a program, not a shared library; write <moduletype>process</moduletype> or link it with -shared");
      return;
    }
    const bool described = has(file.exports, "indurop_module_describe");
    const bool runs = has(file.exports, "run") || has(file.exports, "_Z3runv");
    if (!described && !runs) {
      error("has no run function; write INDUROP_MODULE(run = &::onRun) or extern \"C\" void run(), and export it");
      return;
    }
    const bool condition = has(file.exports, "condition") || has(file.exports, "_Z9conditionv");
    if (module_.operation == Operation::Sporadic && !described && !condition) {
      error("has no condition(), so its event can never occur; write extern \"C\" int condition()");
    }
  }

  void check_process() {
    if (facts_.file.shared_object) {
      warning("is a shared library, not a program; write <moduletype>thread</moduletype>?");
      return;
    }
    check_executable();
    check_wake_up();
  }

  void check_executable() {
    if (::access(module_.file.c_str(), X_OK) != 0) {
      error("is not executable for this user; chmod +x " + module_.file_as_written);
    }
  }

  void check_wake_up() {
    if (module_.operation != Operation::NonReal && module_.signal == 0 &&
        !imports_of(facts_.file, "_ZN3irp10waitPeriod")) {
      warning(
          "neither calls irp::waitPeriod() nor has a <signal>, so nothing starts its runs; add "
          "<signal>SIGUSR1</signal>, or make it non-real");
    }
  }

  base::Diagnostics& report_;
  SchemaTexts& texts_;
  const CheckOptions& options_;
  const Module& module_;
  ModuleFacts& facts_;
  base::SourcePlace place_;
};

// Checks that the modules of one board are for the same processor type.
void check_same_machine(CheckContext& context) {
  const auto& modules = context.config.modules;
  const auto& facts = context.result.facts;
  const auto first = std::find_if(facts.begin(), facts.end(), [](const ModuleFacts& f) { return f.file.machine != 0; });
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].file.machine != 0 && facts[i].file.machine != first->file.machine) {
      const Module& other = modules[static_cast<std::size_t>(first - facts.begin())];
      context.report.error(modules[i].places.file, base::path_in_quotes(modules[i].file_as_written) + " is built for " +
                                                       machine_name(facts[i].file.machine) + ", " + other.name +
                                                       " of the same board for " + machine_name(first->file.machine) +
                                                       "; build both for the board");
    }
  }
}

// A call of a shared function without an implementer fails at run time; here it is known whether there is one.
void check_functions(CheckContext& context) {
  const auto& facts = context.result.facts;
  const bool offered = std::any_of(facts.begin(), facts.end(),
                                   [](const ModuleFacts& f) { return has(f.file.imports, "indurop_offer_function"); });
  for (std::size_t i = 0; i < facts.size() && !offered; ++i) {
    if (has(facts[i].file.imports, "indurop_call")) {
      const Module& module = context.config.modules[i];
      context.report.warning(module.places.file, module.name +
                                                     " calls shared functions, but no module implements one; "
                                                     "add the module with INDUROP_IMPLEMENT");
    }
  }
}

// Variables that the module's ioconfig.xml declares, for FMUs.
void declare_io_variables(ModuleFacts& facts, const Module& module, const std::filesystem::path& folder) {
  const schema::Schema declared = io_variables_of(module, folder);
  if (declared.variables.empty()) {
    return;
  }
  schema::Schema all = *facts.schema;
  std::vector<std::string> differences;  // reported as those of two modules are
  schema::merge(all, declared, differences);
  facts.schema = std::make_shared<schema::Schema>(std::move(all));
}

}  // namespace

std::string machine_problem(std::uint16_t machine, const CheckOptions& options) {
  if (!options.arch.empty() && !is_for(machine, options.arch)) {
    return "is built for " + machine_name(machine) + ", the board is " + options.arch +
           "; name the file that is built for the board, or correct arch=";
  }
  if (options.machine && machine != kThisMachine) {
    return "is built for " + machine_name(machine) + ", this machine is " + machine_name(kThisMachine) +
           "; build it for this one";
  }
  return {};
}

std::string unreadable_file(const Error& failure, const NamedFile& file, bool search) {
  const std::string name = base::path_in_quotes(file.as_written);
  if (failure.code == Errc::NotFound) {
    return "no such file: " + name + (search ? missing_hint(file.path, file.element) : "");
  }
  if (failure.code == Errc::PermissionDenied) {
    return name + " is not readable by this user; check the permissions of the file and its folders (ls -l)";
  }
  return name + " cannot be used: " + failure.where +
         (failure.code == Errc::Corrupt ? "; is it a module, and completely built?" : "");
}

Result<std::shared_ptr<const schema::Schema>> SchemaTexts::read(const std::string& text) {
  if (const auto known = known_.find(text); known != known_.end()) {
    return known->second;
  }
  auto read = schema::from_json(text);
  if (!read) {
    return read.error();
  }
  return known_.emplace(text, std::make_shared<schema::Schema>(std::move(read.value()))).first->second;
}

void check_files(CheckContext& context) {
  const auto& modules = context.config.modules;
  context.result.facts.resize(modules.size());
  for (std::size_t i = 0; i < modules.size(); ++i) {
    ModuleFacts& facts = context.result.facts[i];
    FileCheck(context, modules[i], facts).run();
    if (is_io_module(facts.file)) {
      declare_io_variables(facts, modules[i], context.config.file.parent_path());
    }
  }
  if (!context.options.machine) {
    check_same_machine(context);
  }
  std::vector<std::string> differences;  // reported by check_agreement()
  for (const ModuleFacts& facts : context.result.facts) {
    schema::merge(context.result.schema, *facts.schema, differences);
  }
  check_functions(context);
}

}  // namespace indurop::config
