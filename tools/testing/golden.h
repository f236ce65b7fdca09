// SPDX-License-Identifier: Apache-2.0
// Values over ticks, and their comparison with a golden file that was reviewed once.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace indurop::testing {

class Trace {
 public:
  void begin(std::vector<std::string> names);
  [[nodiscard]] bool on() const noexcept { return !names_.empty(); }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  // Adds the values after a tick; they are stored only if they differ from the previous ones.
  void add(std::uint64_t tick, std::vector<std::string> values);

  [[nodiscard]] std::string csv() const;
  // Returns the first difference, "tick 12: gain is 5, was 4"; empty: none. Throws std::runtime_error if the file
  // cannot be read or written.
  [[nodiscard]] std::string difference_to(const std::filesystem::path& file) const;

 private:
  struct Row {
    std::uint64_t tick;
    std::vector<std::string> values;
  };
  std::vector<std::string> names_;
  std::vector<Row> rows_;
};

}  // namespace indurop::testing
