// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/board.h"

#include <fmt/format.h>

#include <atomic>

namespace indurop::serve {
namespace {

// A number for each store that any board attaches: a name may be on this host at one time and on another one later.
std::uint64_t next_attachment() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

}  // namespace

std::string Board::layout() const {
  return store_ ? fmt::format("{:016x}", store_->layout_hash()) : std::string();
}

void Board::attach(vars::Store store, std::uint64_t generation) {
  store_ = std::move(store);
  generation_ = generation;
  attachment_ = next_attachment();
}

void Board::detach() {
  store_.reset();
  attachment_ = next_attachment();
}

}  // namespace indurop::serve
