// SPDX-License-Identifier: Apache-2.0
#include "node/board_deployment.h"

#include <fmt/format.h>

#include <algorithm>

#include "deploy/plant.h"
#include "rt/clock.h"

namespace indurop::node {
namespace {

// First error of a check, and how many more.
std::string first_error(const std::vector<deploy::Diagnostic>& diagnostics) {
  std::string text;
  std::size_t more = 0;
  for (const deploy::Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.severity != deploy::Diagnostic::Severity::Error) {
      continue;
    }
    if (text.empty()) {
      deploy::Diagnostic shown = diagnostic;
      shown.file = std::filesystem::path(shown.file).filename().string();
      text = deploy::to_string(shown);
    } else {
      ++more;
    }
  }
  return more > 0 ? fmt::format("{} (and {} more)", text, more) : text;
}

HistoryEntry history_of(const deploy::Order& order, const std::string& plant, const std::string& outcome) {
  return {order.deployment, plant, order.generation, order.host, rt::wall_ns(), outcome};
}

}  // namespace

bool BoardDeployment::belongs(const std::vector<std::string>& members) const {
  return std::find(members.begin(), members.end(), board_) != members.end();
}

std::filesystem::path BoardDeployment::manifest(const std::string& id) const {
  std::string problem;
  const auto package = id.empty() ? std::nullopt : state_.package(id, problem);
  return package && belongs(package->boards) ? state_.manifest(id) : std::filesystem::path{};
}

// The deployment is of this board's plant and leaves it out, perhaps not for the first time.
bool BoardDeployment::leaves(const std::string& id) const {
  std::string problem;
  const auto package = state_.package(id, problem);
  return package && package->plant == state_.committed().plant && !belongs(package->boards);
}

std::string BoardDeployment::check(const deploy::Order& order) {
  if (leaves(order.deployment)) {
    return {};
  }
  if (std::string problem = state_.install(order.deployment); !problem.empty()) {
    return problem;
  }
  deploy::ReadPlant read = deploy::read_plant(state_.manifest(order.deployment));
  if (!read.ok()) {
    return first_error(read.diagnostics);
  }
  if (read.plant.name != order.plant) {
    return fmt::format("plant {} was offered, and {} is in the package", order.plant, read.plant.name);
  }
  deploy::CheckOptions how;
  how.board = one_host_ ? std::string{} : board_;
  const deploy::PlantCheck checked = deploy::check_plant(read.plant, how);
  const bool here = std::any_of(read.plant.boards.begin(), read.plant.boards.end(),
                                [this](const deploy::Board& board) { return board.name == board_; });
  return here ? first_error(checked.diagnostics) : fmt::format("the plant has no board {}", board_);
}

std::string BoardDeployment::commit(const deploy::Order& order) {
  std::string problem;
  const auto package = state_.package(order.deployment, problem);
  Committed next = state_.committed();
  next.generation = order.generation;
  next.grant = order.grant;
  if (package) {
    next.plant = package->plant;
    next.members = package->boards;
  }
  if (next.current != order.deployment) {
    next.previous = next.current;
  }
  next.current = order.deployment;
  std::error_code error;
  next.current_size = std::filesystem::file_size(state_.file(order.deployment), error);
  next.history.push_back(history_of(order, next.plant, "committed"));
  problem = state_.commit(std::move(next));
  if (problem.empty()) {
    state_.collect_garbage();
  }
  return problem;
}

std::string BoardDeployment::note_rollback(const deploy::Order& order, const std::string& why) {
  Committed same = state_.committed();
  same.history.push_back(history_of(order, same.plant, "rolled back: " + why));
  return state_.commit(std::move(same));
}

}  // namespace indurop::node
