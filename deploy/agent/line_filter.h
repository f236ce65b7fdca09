// SPDX-License-Identifier: Apache-2.0
// Leaves out the lines that begin with given text, from text that arrives in pieces.

#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace indurop::deploy {

class LineFilter {
 public:
  // `begin`: how the lines begin that are left out; empty: none are.
  explicit LineFilter(std::string begin) : begin_(std::move(begin)) {}

  // Returns what of `text` and of earlier pieces is known to stay.
  std::string pass(std::string_view text) {
    std::string out;
    for (const char c : text) {
      if (at_ == Place::Begin && matched_ < begin_.size() && c == begin_[matched_]) {
        ++matched_;
        at_ = matched_ == begin_.size() ? Place::LeftOut : Place::Begin;
        continue;
      }
      if (at_ == Place::Begin) {
        out.append(begin_, 0, matched_);
        at_ = Place::Stays;
      }
      if (at_ == Place::Stays) {
        out += c;
      }
      if (c == '\n') {
        at_ = Place::Begin;
        matched_ = 0;
      }
    }
    return out;
  }

  // Returns what is left of a line that will not end.
  std::string rest() {
    const std::string out = at_ == Place::Begin ? begin_.substr(0, matched_) : "";
    at_ = Place::Begin;
    matched_ = 0;
    return out;
  }

 private:
  enum class Place { Begin, Stays, LeftOut };  // in the line that has not ended

  std::string begin_;
  std::size_t matched_ = 0;  // characters of the line that are those of begin_
  Place at_ = Place::Begin;
};

}  // namespace indurop::deploy
