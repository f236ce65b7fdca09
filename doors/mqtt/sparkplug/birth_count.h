// SPDX-License-Identifier: Apache-2.0
// The number of births of an edge node (bdSeq, 0 to 255): kept in a file, so that it goes on after a restart and a host
// can tell the will of an earlier connection from that of the present one.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace indurop::mqtt {

class BirthCount {
 public:
  explicit BirthCount(std::filesystem::path file);
  // Returns the number of the next connection. It is on the disk before it is returned, or problem() says why not.
  std::uint64_t next();
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  std::filesystem::path file_;
  std::uint64_t next_ = 0;
  std::string problem_;
};

}  // namespace indurop::mqtt
