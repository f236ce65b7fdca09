// SPDX-License-Identifier: Apache-2.0
// Boards of other hosts as their agents report them: values are fetched as often as clients request them, at most four
// times a second and 512 kB a second for each board.

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/client/board/plant_watch.h"
#include "tools/client/board/reported_board.h"

namespace indurop::serve {

class RemotePoller {
 public:
  // Requests what is due; takes up to two seconds if a board does not answer. Called by the thread that receives from
  // boards.
  void poll(tools::PlantWatch& watch);
  // Fetches the current values of this board, as far as it answers.
  void fetch(tools::PlantWatch& watch, const std::string& name);

  // May be called by any thread: boards that were ever discovered and do not run on this host. Null: there is none of
  // that name.
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::shared_ptr<tools::ReportedBoard> find(const std::string& name) const;

 private:
  using Some = std::vector<std::shared_ptr<tools::ReportedBoard>>;
  void update(const tools::PlantWatch& watch);
  void ask(tools::PlantWatch& watch, const Some& boards);
  static void learn(tools::PlantWatch& watch, const Some& boards);
  [[nodiscard]] Some all() const;

  mutable std::mutex mutex_;  // protects the map, not the boards in it
  std::map<std::string, std::shared_ptr<tools::ReportedBoard>> boards_;
  std::map<std::string, std::int64_t> learn_ns_;  // time before which their variables are not requested again
};

}  // namespace indurop::serve
