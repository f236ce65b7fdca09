// SPDX-License-Identifier: Apache-2.0
// Readers and writers of each variable, over all boards.

#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "config/check/check.h"

namespace indurop::config {

// One board, for checks over all boards. The name is empty if there is only one board.
struct BoardView {
  std::string name;
  const Config& config;
  const CheckResult& result;  // after check_data_flow
};

struct Plant;
struct PlantCheck;
// Returns all boards of a plant, in the order of the manifest; `plant` and `check` are borrowed.
std::vector<BoardView> views_of(const Plant& plant, const PlantCheck& check);

struct User {
  std::size_t board = 0;   // index into the views
  std::size_t module = 0;  // index into the board's Config::modules
};

struct Users {
  std::vector<User> readers;  // by board, then in order of execution
  std::vector<User> writers;
  bool given = false;     // declared with a value
  bool optional = false;  // declared @optional
};

class Uses {
 public:
  // Borrows `boards`.
  explicit Uses(std::span<const BoardView> boards);

  [[nodiscard]] const std::map<std::string, Users>& variables() const noexcept { return variables_; }
  [[nodiscard]] const std::vector<User>& unknown_readers() const noexcept { return unknown_readers_; }
  [[nodiscard]] const std::vector<User>& unknown_writers() const noexcept { return unknown_writers_; }

  [[nodiscard]] const BoardView& board(User user) const { return boards_[user.board]; }
  [[nodiscard]] const Module& module(User user) const { return board(user).config.modules[user.module]; }
  // Returns "control", in a plant "control@sensor".
  [[nodiscard]] std::string name(User user) const;
  [[nodiscard]] std::vector<std::string> names(const std::vector<User>& users) const;

 private:
  std::span<const BoardView> boards_;
  std::map<std::string, Users> variables_;
  std::vector<User> unknown_readers_;
  std::vector<User> unknown_writers_;
};

}  // namespace indurop::config
