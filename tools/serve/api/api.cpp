// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/api/api.h"

#include "tools/serve/boards/board.h"

namespace indurop::serve {

const tools::KnownUses& Api::uses_of(const Board& board) {
  static const tools::KnownUses none;
  if (board.remote() != nullptr) {
    return none;
  }
  const auto run = board.run();
  const std::int64_t started = run ? run->block().started_wall_ns : 0;
  const auto known = uses_.find(board.name());
  if (known != uses_.end() && known->second.started_wall_ns == started) {
    return known->second.uses;
  }
  Cached& fresh = uses_[board.name()];
  fresh = {started, tools::known_uses(board.name())};
  return fresh.uses;
}

}  // namespace indurop::serve
