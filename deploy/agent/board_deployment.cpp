// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_deployment.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "core/base/diagnostics.h"
#include "core/rt/clock.h"
#include "deploy/agent/board_pools.h"

namespace indurop::deploy {
namespace {

using base::Problem;

// Returns the first error of a check, if any, and the number of further ones.
Result<void, Problem> first_error(const std::vector<base::Diagnostic>& diagnostics) {
  std::string text;
  std::size_t more = 0;
  for (const base::Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.severity != base::Diagnostic::Severity::Error) {
      continue;
    }
    if (text.empty()) {
      base::Diagnostic shown = diagnostic;
      shown.file = std::filesystem::path(shown.file).filename().string();
      text = base::to_string(shown);
    } else {
      ++more;
    }
  }
  if (text.empty()) {
    return {};
  }
  return Problem{more > 0 ? fmt::format("{} (and {} more)", text, more) : text};
}

// Reports pools of the board that nothing would send or receive, because the program is missing.
void check_pools_program(const config::Plant& plant, const std::string& board,
                         std::vector<base::Diagnostic>& diagnostics) {
  const std::filesystem::path program = pools_program();
  if (::access(program.c_str(), X_OK) == 0) {
    return;
  }
  base::Diagnostics report(plant.file.string(), diagnostics);
  for (const config::PoolRoute& route : plant.pools) {
    const bool gets = std::find(route.to.begin(), route.to.end(), board) != route.to.end();
    if (route.from == board || gets) {
      report.error(route.place,
                   fmt::format("board {} cannot {} the pool '{}', because {} is missing there; install all "
                               "of the package indurop on it",
                               board, gets ? "receive" : "send", route.name, program.string()));
    }
  }
}

HistoryEntry history_of(const Order& order, const std::string& plant, const std::string& outcome,
                        const std::string& comment) {
  return {order.deployment, plant, order.generation, order.host, rt::wall_ns(), outcome, comment};
}

}  // namespace

bool BoardDeployment::belongs(const std::vector<std::string>& members) const {
  return std::find(members.begin(), members.end(), board_) != members.end();
}

bool BoardDeployment::lacks(const BoardReport& other, bool damaged) const {
  const Committed& committed = state_.committed();
  const bool complete =
      std::find(other.members.begin(), other.members.end(), other.board) != other.members.end();  // has all files
  const bool left_out = other.plant == committed.plant && belongs(committed.members);
  const bool same = other.generation == committed.generation && other.current == committed.current;
  return other.board != board_ && complete && (belongs(other.members) || left_out) &&
         (other.generation > committed.generation || (damaged && same));
}

std::filesystem::path BoardDeployment::manifest(const std::string& id) const {
  const auto package = state_.package(id);
  const Committed& committed = state_.committed();
  // With a damaged package there is still a manifest to run, and verification reports why it cannot be run.
  const bool part = package ? belongs(package->boards) : id == committed.current && belongs(committed.members);
  return part && !id.empty() ? state_.manifest(id) : std::filesystem::path{};
}

// Returns whether the deployment is of this board's plant and leaves the board out, perhaps not for the first time.
bool BoardDeployment::leaves(const std::string& id) const {
  const auto package = state_.package(id);
  return package && package->plant == state_.committed().plant && !belongs(package->boards);
}

Result<void, Problem> BoardDeployment::check(const Order& order) {
  if (leaves(order.deployment)) {
    return {};
  }
  if (auto installed = state_.install(order.deployment); !installed) {
    return installed;
  }
  config::ReadPlant read = config::read_plant(state_.manifest(order.deployment));
  if (!read.ok()) {
    return first_error(read.diagnostics);
  }
  if (read.plant.name != order.plant) {
    return Problem{fmt::format("plant {} was offered, and {} is in the package", order.plant, read.plant.name)};
  }
  if (const auto package = state_.package(order.deployment); package && !is_package_of(*package, read.plant)) {
    return Problem{fmt::format("the package names another plant, or other boards, than the manifest of {} in it",
                               read.plant.name)};
  }
  config::CheckOptions how;
  how.board = one_host_ ? std::string{} : board_;
  const config::PlantCheck checked = config::check_plant(read.plant, how);
  const bool here = std::any_of(read.plant.boards.begin(), read.plant.boards.end(),
                                [this](const config::Board& board) { return board.name == board_; });
  if (!here) {
    return Problem{fmt::format("the plant has no board {}", board_)};
  }
  std::vector<base::Diagnostic> diagnostics = checked.diagnostics;
  check_pools_program(read.plant, board_, diagnostics);
  return first_error(diagnostics);
}

Result<void, Problem> BoardDeployment::commit(const Order& order) {
  const auto package = state_.package(order.deployment);
  Committed next = state_.committed();
  next.generation = order.generation;
  next.grant = order.grant;
  if (package) {
    next.plant = package->plant;
    next.members = package->boards;
    next.comment = package->comment;
  }
  // The board had this deployment already, and has fetched it again.
  const bool again = next.current == order.deployment && state_.committed().generation == order.generation;
  if (next.current != order.deployment) {
    next.previous = next.current;
  }
  next.current = order.deployment;
  std::error_code error;
  next.current_size = std::filesystem::file_size(state_.file(order.deployment), error);
  if (!again) {
    next.history.push_back(history_of(order, next.plant, "committed", next.comment));
  }
  auto committed = state_.commit(std::move(next));
  if (committed) {
    state_.collect_garbage();
  }
  return committed;
}

Result<void, Problem> BoardDeployment::note_rollback(const Order& order, const std::string& why) {
  const auto package = state_.package(order.deployment);
  Committed same = state_.committed();
  same.history.push_back(history_of(order, same.plant, "rolled back: " + why, package ? package->comment : ""));
  return state_.commit(std::move(same));
}

}  // namespace indurop::deploy
