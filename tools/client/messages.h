// SPDX-License-Identifier: Apache-2.0
// Messages for people from functions that have several of them, or that continue afterwards: the program decides how
// they are shown.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace indurop::tools {

class Messages {
 public:
  Messages() = default;
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  virtual ~Messages() = default;

  virtual void error(std::string_view text) = 0;  // the call fails
  virtual void note(std::string_view text) = 0;   // the call continues
};

// Keeps them, for programs that return them as part of an answer.
class KeptMessages final : public Messages {
 public:
  void error(std::string_view text) override { texts.emplace_back(text); }
  void note(std::string_view text) override { texts.emplace_back(text); }

  std::vector<std::string> texts;
};

}  // namespace indurop::tools
