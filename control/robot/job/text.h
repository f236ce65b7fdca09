// SPDX-License-Identifier: Apache-2.0
// One line of a job file as words, numbers and signs, with the columns that error messages name.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::robot {

struct JobToken {
  enum class Kind { Word, Number, Sign, Text, Junk, End };
  Kind kind = Kind::End;
  std::string_view text;
  double value = 0;
  std::size_t column = 1;
};

// The lines of a text, without a byte order mark.
class JobLines {
 public:
  explicit JobLines(std::string_view text) noexcept;
  [[nodiscard]] bool at_end() const noexcept { return rest_.empty(); }
  std::string_view take() noexcept;

 private:
  std::string_view rest_;
};

// The last token is always an End; a Text has its quotes. Comments begin with # or //.
std::vector<JobToken> split_job_line(std::string_view line);
// Compares ASCII letters regardless of case; keywords may be written in lower case.
bool same_word(std::string_view a, std::string_view b) noexcept;

std::string in_quotes(std::string_view text);

}  // namespace indurop::robot
