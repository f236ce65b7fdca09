// SPDX-License-Identifier: Apache-2.0
// The line of a job file that is being read: its tokens one after another, and its errors.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "control/robot/job/text.h"
#include "control/robot/kinematics/geometry.h"
#include "core/base/diagnostics.h"
#include "core/base/source_place.h"

namespace indurop::robot {

class JobLine {
 public:
  explicit JobLine(base::Diagnostics& errors) : errors_(errors) {}

  // Begins a file, before its first line.
  void begin(const std::string& file);
  // Goes to the next line.
  void next(std::string_view text);

  // A token of the present line that was taken because it is this word, such as MOVL.
  struct Keyword {
    std::size_t column = 0;
    std::string_view word;
  };
  [[nodiscard]] const std::vector<Keyword>& keywords() const noexcept { return keywords_; }

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  [[nodiscard]] base::SourcePlace place(const JobToken& token) const noexcept;

  [[nodiscard]] const JobToken& peek() const { return tokens_[at_]; }
  // Returns the token after peek(); the end of the line remains the last one.
  [[nodiscard]] const JobToken& after() const { return tokens_[at_ + 1 < tokens_.size() ? at_ + 1 : at_]; }
  [[nodiscard]] const JobToken& before() const { return tokens_[at_ - 1]; }
  [[nodiscard]] const JobToken& first() const { return tokens_.front(); }
  [[nodiscard]] bool at_end() const { return peek().kind == JobToken::Kind::End; }
  JobToken take() { return at_end() ? tokens_[at_] : tokens_[at_++]; }
  // Takes the token if it is this word or sign, which must outlive the line.
  bool accept(std::string_view word);
  // Returns whether a token of this line is this word, which must outlive the line.
  bool is_word(const JobToken& token, std::string_view word);
  // Takes the tokens of a unit, such as mm/s. Where it does not come next, some of them may have been taken.
  bool accept_unit(std::string_view unit);
  void expect_end();

  // Returns whether so many numbers come next, with or without commas, and no other part of an expression after them.
  [[nodiscard]] bool numbers_ahead(int count) const;
  // Parses finite numbers, with or without commas. False: an error says what was expected.
  bool numbers(int count, double* to, const char* what);
  // Parses "0.5s", "200 ms".
  bool duration(double& seconds);
  // Parses "RPY r p y" after the word RPY, in degrees.
  bool rpy(Quat& orientation);
  // Parses "x y z RPY r p y", in mm and degrees.
  bool pose(Pose& pose);

  // Adds an error; only the first one of a line counts.
  void error(const JobToken& at, const std::string& text);
  void error_in(const std::string& file, std::size_t line, std::size_t column, const std::string& text);
  [[nodiscard]] bool failed() const noexcept { return failed_; }
  // Returns true if further errors are only counted: their texts need no search for a similar name.
  [[nodiscard]] bool full() const noexcept { return errors_.full(); }
  // Returns the token as error messages show it.
  [[nodiscard]] static std::string shown(const JobToken& token);

 private:
  base::Diagnostics& errors_;
  std::string file_;
  std::vector<JobToken> tokens_;
  std::vector<Keyword> keywords_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
  bool failed_ = false;
};

}  // namespace indurop::robot
