// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/deployment_change.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "config/pool_arguments.h"
#include "config/xml/document.h"
#include "config/xml/manifest_difference.h"
#include "config/xml/plant_reader.h"
#include "deploy/bundle/project.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using PlanAct = ModulePlan::Act;

// One of the two deployments.
class DeploymentSide {
 public:
  static std::optional<DeploymentSide> read(const AgentState& state, const std::string& id) {
    const auto package = state.package(id);
    const fs::path file = state.manifest(id);
    const auto bytes = config::read_bytes(file, config::kPlantXml);
    if (!package || !bytes) {
      return std::nullopt;
    }
    DeploymentSide side;
    std::vector<base::Diagnostic> ignored;
    auto document = config::read_document(*bytes, file, config::kPlantXml, ignored);
    auto plant = config::read_plant(file);
    if (!document || !plant.ok()) {
      return std::nullopt;
    }
    side.document_ = std::move(*document);
    side.plant_ = std::move(plant.plant);
    side.folder_ = file.parent_path();
    const fs::path inside = fs::path(package->manifest).parent_path();
    for (const PackageFile& entry : package->files) {
      const std::string name = fs::path(entry.path).lexically_relative(inside).string();
      if (entry.path != package->manifest && entry.path != kProjectPath) {
        side.digests_[inside.empty() ? entry.path : name] = entry.digest;
      }
    }
    return side;
  }

  [[nodiscard]] const config::Plant& plant() const noexcept { return plant_; }
  [[nodiscard]] const base::Element& document() const noexcept { return document_; }
  // Modules of the board; null: the plant does not have it.
  [[nodiscard]] const std::vector<config::Module>* modules(const std::string& board) const {
    const auto found = std::find_if(plant_.boards.begin(), plant_.boards.end(),
                                    [&board](const config::Board& one) { return one.name == board; });
    return found == plant_.boards.end() ? nullptr : &found->config.modules;
  }
  [[nodiscard]] std::string name_of(const config::Module& module) const {
    return module.file.lexically_relative(folder_).string();
  }
  // Empty: the file is not one of the deployment.
  [[nodiscard]] std::string digest_of(const config::Module& module) const {
    const auto found = digests_.find(name_of(module));
    return found == digests_.end() ? "" : found->second;
  }
  [[nodiscard]] const std::map<std::string, std::string>& digests() const noexcept { return digests_; }
  // The files of all modules, on all boards.
  [[nodiscard]] std::set<std::string> module_files() const {
    std::set<std::string> files;
    for (const config::Board& board : plant_.boards) {
      for (const config::Module& module : board.config.modules) {
        files.insert(name_of(module));
      }
    }
    return files;
  }

 private:
  base::Element document_;
  config::Plant plant_;
  fs::path folder_;
  std::map<std::string, std::string> digests_;  // by path, relative to the manifest's folder
};

// Returns the first file that differs besides the manifest and modules; empty: there is none.
std::string changed_file(const DeploymentSide& before, const DeploymentSide& after) {
  std::set<std::string> names = before.module_files();
  names.merge(after.module_files());
  for (const auto& [name, digest] : after.digests()) {
    const auto then = before.digests().find(name);
    if (names.insert(name).second && (then == before.digests().end() || then->second != digest)) {
      return name + (then == before.digests().end() ? " is new" : " has changed");
    }
  }
  for (const auto& [name, digest] : before.digests()) {
    if (names.insert(name).second) {
      return name + " is gone";
    }
  }
  return "";
}

const config::Module* find_module(const std::vector<config::Module>& modules, const std::string& name) {
  const auto found =
      std::find_if(modules.begin(), modules.end(), [&name](const config::Module& one) { return one.name == name; });
  return found == modules.end() ? nullptr : &*found;
}

ModulePlan plan_of(const config::Module& module, const config::Module* then, const DeploymentSide& before,
                   const DeploymentSide& after, const std::map<std::string, std::string>& running) {
  if (then == nullptr) {
    return {module.name, PlanAct::Added, ""};
  }
  const auto known = running.find(module.name);
  const std::string old = known != running.end() ? known->second : before.digest_of(*then);
  const std::string now = after.digest_of(module);
  if (now.empty() || old == now) {
    return {module.name, PlanAct::Kept, ""};
  }
  return {module.name, PlanAct::Exchanged, ""};
}

void plan_modules(const DeploymentSide& before, const DeploymentSide& after, const std::string& board,
                  const std::map<std::string, std::string>& running, DeploymentChange& change) {
  static const std::vector<config::Module> kNone;
  const auto* const old = before.modules(board);
  const auto* const now = after.modules(board);
  for (const config::Module& module : now != nullptr ? *now : kNone) {
    ModulePlan plan = plan_of(module, find_module(old != nullptr ? *old : kNone, module.name), before, after, running);
    if (plan.act == PlanAct::Exchanged) {
      change.exchanged.push_back({module.name, module.file.string()});
    }
    change.plan.modules.push_back(std::move(plan));
  }
  for (const config::Module& module : old != nullptr ? *old : kNone) {
    if (now == nullptr || find_module(*now, module.name) == nullptr) {
      change.plan.modules.push_back({module.name, PlanAct::Ended, ""});
    }
  }
  if (now == nullptr) {
    change.plan.restart = "the plant does not have this board any more";
  }
}

// indurop-pools goes on if nothing changes for it, else it is started again, for all pools of the board.
void plan_pools(const config::Plant& before, const config::Plant& after, const std::string& board, BoardPlan& plan) {
  const auto old = config::pools_of(before, board);
  const auto now = config::pools_of(after, board);
  const bool same = config::pool_arguments(before, board, false) == config::pool_arguments(after, board, false);
  const auto has = [](const std::vector<config::BoardPool>& pools, const std::string& name) {
    return std::any_of(pools.begin(), pools.end(), [&name](const config::BoardPool& one) { return one.pool == name; });
  };
  for (const config::BoardPool& one : now) {
    plan.pools.push_back({one.pool,
                          !has(old, one.pool) ? PlanAct::Added
                          : same              ? PlanAct::Kept
                                              : PlanAct::Restarted,
                          one.text});
  }
  for (const config::BoardPool& one : old) {
    if (!has(now, one.pool)) {
      plan.pools.push_back({one.pool, PlanAct::Ended, ""});
    }
  }
}

}  // namespace

DeploymentChange change_between(const AgentState& state, const std::string& board, const std::string& from,
                                const std::string& to, const std::map<std::string, std::string>& running) {
  DeploymentChange change;
  const auto after = DeploymentSide::read(state, to);
  const auto before = from.empty() ? std::nullopt : DeploymentSide::read(state, from);
  if (!after || !before) {
    change.plan.restart = from.empty() ? "nothing was deployed to it" : "what was deployed to it cannot be compared";
    return change;
  }
  plan_modules(*before, *after, board, running, change);
  plan_pools(before->plant(), after->plant(), board, change.plan);
  if (change.plan.restart.empty()) {
    change.plan.restart =
        config::manifest_difference(before->document(), after->document(), config::ComparedElements::NotSchedule);
  }
  if (change.plan.restart.empty()) {
    change.plan.restart = changed_file(*before, *after);
  }
  if (!change.plan.restart.empty()) {
    change.exchanged.clear();
  } else {
    change.manifest = state.manifest(to).string();
  }
  return change;
}

}  // namespace indurop::deploy
