// SPDX-License-Identifier: Apache-2.0
// Boards of other hosts, by what their agents say: their values as often as somebody wants them, at most four times a
// second and 512 kB a second of each.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/plant/plant_watch.h"
#include "tools/plant/remote_board.h"

namespace indurop::serve {

class RemoteBoards {
 public:
  // Of the thread that hears boards. Asks for what is due; takes up to two seconds if a board does not answer.
  void look(tools::PlantWatch& watch);
  // Values of this board as they are now, as far as it answers.
  void fetch(tools::PlantWatch& watch, const std::string& name);

  // Of any thread: boards that were ever heard and do not run on this host. Null: there is none of that name.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::shared_ptr<tools::RemoteBoard> find(const std::string& name) const;

 private:
  using Some = std::vector<std::shared_ptr<tools::RemoteBoard>>;
  void hear(const tools::PlantWatch& watch);
  void ask(tools::PlantWatch& watch, const Some& boards);
  static void learn(tools::PlantWatch& watch, const Some& boards);
  [[nodiscard]] Some all() const;

  mutable std::mutex mutex_;  // of the map, not of what is in it
  std::map<std::string, std::shared_ptr<tools::RemoteBoard>> boards_;
  std::map<std::string, std::int64_t> learn_ns_;  // not to be asked for their variables before
};

}  // namespace indurop::serve
