// SPDX-License-Identifier: Apache-2.0
#include "config/check/uses.h"

#include "config/check/check_plant.h"

namespace indurop::config {

std::vector<BoardView> views_of(const Plant& plant, const PlantCheck& check) {
  std::vector<BoardView> views;
  for (std::size_t i = 0; i < check.boards.size(); ++i) {
    views.push_back({plant.boards[i].name, plant.boards[i].config, check.boards[i]});
  }
  return views;
}

Uses::Uses(std::span<const BoardView> boards) : boards_(boards) {
  for (std::size_t b = 0; b < boards.size(); ++b) {
    const BoardView& board = boards[b];
    std::map<std::string, std::size_t> by_name;
    for (std::size_t i = 0; i < board.config.modules.size(); ++i) {
      by_name.emplace(board.config.modules[i].name, i);
    }
    for (const VariableUse& use : board.result.uses) {
      Users& users = variables_[use.name];
      for (const std::string& reader : use.readers) {
        users.readers.push_back({b, by_name.at(reader)});
      }
      for (const std::string& writer : use.writers) {
        users.writers.push_back({b, by_name.at(writer)});
      }
    }
    for (const schema::Variable& one : board.result.schema.variables) {
      if (const auto used = variables_.find(one.name); used != variables_.end()) {
        used->second.given |= one.given;
        used->second.optional |= one.optional;
      }
    }
    for (const std::size_t module : board.result.unknown_readers) {
      unknown_readers_.push_back({b, module});
    }
    for (const std::size_t module : board.result.unknown_writers) {
      unknown_writers_.push_back({b, module});
    }
  }
}

std::string Uses::name(User user) const {
  const std::string& on = board(user).name;
  return module(user).name + (on.empty() ? "" : "@" + on);
}

std::vector<std::string> Uses::names(const std::vector<User>& users) const {
  std::vector<std::string> list;
  list.reserve(users.size());
  for (const User& user : users) {
    list.push_back(name(user));
  }
  return list;
}

}  // namespace indurop::config
