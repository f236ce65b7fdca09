// SPDX-License-Identifier: Apache-2.0
// What a node that died has left in shared memory, kept on disk before the next one takes its place: what ran when,
// overruns, figures, faults. `indurop log --from FILE` and the like show it.

#pragma once

#include <filesystem>
#include <string>

namespace indurop::deploy {

class BlackBox {
 public:
  static constexpr std::size_t kKept = 8;  // newest files

  BlackBox(std::filesystem::path folder, std::string board) : folder_(std::move(folder)), board_(std::move(board)) {}
  // Where it is now, as text for people; why it is nowhere, if it cannot be written.
  [[nodiscard]] std::string keep() const;

 private:
  std::filesystem::path folder_;
  std::string board_;
};

}  // namespace indurop::deploy
