// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "config/check/check_parts.h"
#include "core/keys/digest.h"
#include "node/exchange/module_trial.h"
#include "node/modules/kept_versions.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

class CandidateCheck {
 public:
  CandidateCheck(const CandidateTask& task, Candidate& candidate)
      : task_(task), candidate_(candidate), errors_(candidate.errors) {}

  // Returns true if what is wrong is wrong for this run of the node only.
  bool run() {
    config::Config one = task_.config;
    one.modules = {task_.config.modules[task_.module]};
    config::Module& module = one.modules.front();
    if (task_.file != module.file) {
      module.file_as_written = task_.file.string();
    }
    module.file = task_.file;
    config::CheckResult result;
    config::SchemaTexts texts;
    config::CheckContext context{one, {}, result, base::Diagnostics(one.file.string(), result.diagnostics), texts};
    config::check_files(context);
    for (const base::Diagnostic& diagnostic : result.diagnostics) {
      if (diagnostic.severity == base::Diagnostic::Severity::Error) {
        errors_.push_back(base::to_string(diagnostic));
      }
    }
    if (!errors_.empty()) {
      return false;
    }
    candidate_.library.set_uses(uses_of(result.facts.front()));
    candidate_.access = result.facts.front().file.access;
    if (task_.may_grow) {
      find_changes(result.facts.front());
    }
    check_variables(result.facts.front());
    check_imports(result.facts.front().file.imports);
    return !errors_.empty();
  }

 private:
  void error(const std::string& text) {
    const config::Module& module = task_.config.modules[task_.module];
    errors_.push_back(base::to_string({base::Diagnostic::Severity::Error, task_.config.file.string(),
                                       module.places.file, fmt::format("{}: {}", task_.file.string(), text)}));
  }

  // As at the start, the store gets all variables of the .glb files, used or not.
  void find_changes(const config::ModuleFacts& facts) {
    candidate_.variables = VariableChange::of(task_.store, candidate_.library.uses(), facts.schema->variables);
    if (!task_.others.empty()) {
      for (const std::string& text :
           objections(candidate_.variables, {task_.store, task_.config, task_.others, task_.configured, task_.index})) {
        error(text + "; restart the node with the new version");
      }
    }
  }

  void check_variables(const config::ModuleFacts& facts) {
    for (const auto& [hash, access] : facts.file.access) {
      const auto variable = std::find_if(facts.schema->variables.begin(), facts.schema->variables.end(),
                                         [hash = hash](const auto& one) { return one.name_hash() == hash; });
      if (variable != facts.schema->variables.end() && (access.reads || access.writes)) {
        check_variable(*variable, access);
      }
    }
  }

  // A running module is not given new variables only on a board of a plant.
  [[nodiscard]] std::string not_here(const std::string& name) const {
    return task_.running.digest().empty()
               ? fmt::format("variable {} is not one of this node; restart the node with the new version", name)
               : fmt::format(
                     "variable {} is not one of this board, and the others would not know it; `indurop deploy` brings "
                     "new variables to all boards of a plant without a restart",
                     name);
  }

  void check_variable(const schema::Variable& variable, const schema::Access& access) {
    const vars::DirectoryEntry* entry = task_.store.find(variable.name_hash());
    if (entry == nullptr) {
      return task_.may_grow ? void() : error(not_here(variable.name));
    }
    const schema::Variable& known = task_.store.schema().variables[entry->schema_index];
    const bool changes = task_.may_grow && !task_.others.empty();  // then it was checked before
    if ((known.type_hash != variable.type_hash || known.kind != variable.kind) && !changes) {
      return error(
          fmt::format("variable {} has another layout in this node: {}; build against the same .glb, or restart "
                      "the node with the new version",
                      variable.name, schema::first_difference(variable.type, known.type)));
    }
    if (entry->offset >= task_.store.header().total_size) {
      return check_new_variable(variable, access);
    }
    const auto allowed = task_.allowed.find(variable.name_hash());
    const schema::Access then = allowed != task_.allowed.end() ? allowed->second : schema::Access{};
    if ((access.reads && !then.reads) || (access.writes && !then.writes)) {
      error(
          fmt::format("it {} variable {}, which the version the node started with did not: order, tape and messages "
                      "do not expect that; restart the node with the new version",
                      access.writes && !then.writes ? "writes" : "reads", variable.name));
    }
  }

  // One that appeared while the node runs. Of a plant, only a deployment can say from where it comes.
  void check_new_variable(const schema::Variable& variable, const schema::Access& access) {
    const auto use = task_.running.uses().find(variable.name_hash());
    const bool as_before = use != task_.running.uses().end() && (use->second.reads || !access.reads) &&
                           (use->second.writes || !access.writes);
    if (!task_.may_grow && !as_before) {
      error(
          fmt::format("it {} variable {}, which the running version does not: other boards may have to know that; "
                      "`indurop deploy` exchanges it on all boards",
                      access.writes ? "writes" : "reads", variable.name));
    }
  }

  void check_imports(const std::vector<std::string>& imports) {
    if (task_.ends_first) {
      return;
    }
    const auto has = [&imports](std::string_view beginning) {
      return std::any_of(imports.begin(), imports.end(),
                         [beginning](const std::string& name) { return name.starts_with(beginning); });
    };
    if (has("indurop_offer_function")) {
      error("it implements shared functions, which are served by the version that was loaded first; restart the node");
    }
    if (!task_.running.digest().empty() &&
        (has("pthread_create") || has("_ZNSt6thread15_M_start_thread") || has("thrd_create"))) {
      error("it starts threads of its own, and those of both versions would run at once; restart the node");
    }
  }

  const CandidateTask& task_;
  Candidate& candidate_;
  std::vector<std::string>& errors_;
};

// The variables must have a place before the file is loaded, which binds them.
void make_places(const CandidateTask& task, Candidate& candidate) {
  const std::vector<schema::Variable> places = candidate.variables.places();
  if (const Status made = task.store.reserve(places); !made) {
    candidate.errors.push_back(
        fmt::format("{}: error: there is no place for its {} new variables: {}; restart the node "
                    "with the new version",
                    task.file.string(), places.size(), made.error().where));
    candidate.needs_restart = true;
  }
}

// A recording of the exchange can be repeated only with both files.
void keep_files(const CandidateTask& task, Candidate& candidate) {
  for (const ModuleLibrary* version : {&task.running, &std::as_const(candidate.library)}) {
    if (const auto kept = keep_version(task.keep_for, *version); !kept) {
      candidate.notes.push_back(kept.error().text);
    }
  }
}

// The file of the one that runs may have been replaced.
void keep_programs(const CandidateTask& task, Candidate& candidate) {
  for (const std::string& file : {fmt::format("/proc/{}/exe", task.process), task.file.string()}) {
    if (const auto kept = keep_program(task.keep_for, file); !kept) {
      candidate.notes.push_back(kept.error().text);
    }
  }
}

void check_loaded(const CandidateTask& task, Candidate& candidate) {
  const auto& module = task.config.modules[task.module];
  if (candidate.digest.empty() || candidate.digest != candidate.library.digest()) {
    candidate.errors.push_back(
        fmt::format("{}: error: it was written while it was read; repeat the command", task.file.string()));
  } else if (module.operation == scheduler::Operation::Sporadic && !candidate.library.functions().condition) {
    candidate.errors.push_back(
        fmt::format("{}: error: it has no condition(); a sporadic module needs one", task.file.string()));
  }
}

}  // namespace

ModuleLibrary::Uses uses_of(const config::ModuleFacts& facts) {
  ModuleLibrary::Uses uses;
  for (const schema::Variable& variable : facts.schema->variables) {
    const auto access = facts.file.access.find(variable.name_hash());
    if (access != facts.file.access.end() && (access->second.reads || access->second.writes)) {
      uses[variable.name_hash()] = {variable.type_hash, access->second.reads, access->second.writes};
    }
  }
  return uses;
}

Candidate make_candidate(const CandidateTask& task) {
  Candidate candidate;
  candidate.mark = mark_of(task.file);
  if (const auto digest = keys::digest_of_file(task.file)) {
    candidate.digest = digest->digest;
  }
  candidate.needs_restart = CandidateCheck(task, candidate).run();
  if (task.config.modules[task.module].type == scheduler::ModuleType::Process) {
    if (candidate.errors.empty()) {
      make_places(task, candidate);
    }
    if (candidate.errors.empty() && !task.keep_for.empty()) {
      keep_programs(task, candidate);
    }
    return candidate;
  }
  if (candidate.errors.empty() && task.try_first) {
    if (const std::string failed = try_module(task.file); !failed.empty()) {
      candidate.errors.push_back(fmt::format("{}: error: {}", task.file.string(), failed));
    }
  }
  if (candidate.errors.empty()) {
    make_places(task, candidate);
  }
  if (!candidate.errors.empty()) {
    return candidate;
  }
  if (auto loaded = load_apart(task.file, task.index); !loaded) {
    candidate.errors.push_back(fmt::format("{}: error: {}", task.file.string(), loaded.error().text));
  } else {
    loaded.value().set_uses(candidate.library.uses());  // known from the file
    candidate.library = std::move(loaded).value();
    check_loaded(task, candidate);
  }
  for (const std::string& text : runtime::take_binding_errors()) {
    candidate.errors.push_back(fmt::format("{}: error: {}", task.file.string(), text));
  }
  if (candidate.errors.empty()) {
    candidate.library.prefault();
    candidate.carry = plan_carry(task.running.memory(), candidate.library.memory(),
                                 most_in_tick(task.config.modules[task.module].period.count()));
    candidate.carry.loses |= candidate.variables.list(task.store, candidate.carry.plan);
    if (candidate.variables.changes_types()) {
      candidate.carry.carry_between_runs();
    }
    if (!task.keep_for.empty()) {
      keep_files(task, candidate);
    }
  }
  return candidate;
}

}  // namespace indurop::node
