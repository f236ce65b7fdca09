// SPDX-License-Identifier: Apache-2.0
// All nodes of the host, or the selected one, and boards of other hosts. Used by one thread.

#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/serve/boards/board.h"
#include "tools/serve/boards/remote_poller.h"

namespace indurop::serve {

class Boards {
 public:
  // `remote`: boards of other hosts; `reader` identifies this thread among their readers; `watch`: see RemoteBoard.
  explicit Boards(std::string only, const RemotePoller* remote = nullptr, std::size_t reader = 0,
                  tools::PlantWatch* watch = nullptr)
      : only_(std::move(only)), remote_(remote), reader_(reader), watch_(watch) {}

  // Names of the nodes of this host.
  [[nodiscard]] std::vector<std::string> local() const;
  // Names of all boards that are present now.
  [[nodiscard]] std::vector<std::string> names() const;
  // Returns the board, refreshed; null if there is none of that name. `name` empty: the only one. A board lives as long
  // as this object, so that its attachments are never confused with those of another one.
  Board* find(const std::string& name);
  [[nodiscard]] const std::string& only() const noexcept { return only_; }

 private:
  [[nodiscard]] bool is_local(const std::string& name) const;

  std::string only_;
  const RemotePoller* remote_;
  std::size_t reader_;
  tools::PlantWatch* watch_;
  std::unordered_multimap<std::string, std::unique_ptr<Board>> boards_;  // those requested so far, by name
};

}  // namespace indurop::serve
