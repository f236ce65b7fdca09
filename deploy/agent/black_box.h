// SPDX-License-Identifier: Apache-2.0
// Saves the shared memory of a node that died to disk before the next node replaces it: what ran when, overruns,
// measurements, faults. `indurop log --from FILE` and similar verbs show it.

#pragma once

#include <filesystem>
#include <string>

namespace indurop::deploy {

class BlackBox {
 public:
  static constexpr std::size_t kKept = 8;  // number of newest files kept

  BlackBox(std::filesystem::path folder, std::string board) : folder_(std::move(folder)), board_(std::move(board)) {}
  // Returns where it was saved, as text for people; if it cannot be written, the reason.
  [[nodiscard]] std::string keep() const;

 private:
  std::filesystem::path folder_;
  std::string board_;
};

}  // namespace indurop::deploy
