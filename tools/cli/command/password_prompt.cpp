// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/password_prompt.h"

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <optional>

#include "core/base/print.h"

namespace indurop::tools {
namespace {

// While it exists, the terminal does not show what is typed.
class NoEcho {
 public:
  NoEcho() : known_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (known_) {
      termios silent = before_;
      silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
    }
  }
  NoEcho(const NoEcho&) = delete;
  NoEcho& operator=(const NoEcho&) = delete;
  ~NoEcho() {
    if (known_) {
      (void)::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
    }
  }

 private:
  termios before_{};
  bool known_;
};

std::optional<std::string> read_line() {
  std::string line;
  return std::getline(std::cin, line) ? std::optional(line) : std::nullopt;
}

std::optional<std::string> ask(const std::string& prompt) {
  base::print(stderr, "{}: ", prompt);
  (void)std::fflush(stderr);
  auto line = read_line();
  base::print(stderr, "\n");
  return line;
}

}  // namespace

Result<std::string, base::Problem> read_new_password(const std::string& what) {
  constexpr const char* kNoLine = "there is no password: type it, or pass it as a line of standard input";
  if (::isatty(STDIN_FILENO) != 1) {
    auto line = read_line();
    return line ? Result<std::string, base::Problem>(std::move(*line)) : base::Problem{kNoLine};
  }
  const NoEcho silent;
  auto first = ask(what);
  const auto second = first ? ask("again") : std::nullopt;
  if (!second) {
    return base::Problem{kNoLine};
  }
  if (*first != *second) {
    return base::Problem{"the two passwords differ; nothing was changed"};
  }
  return std::move(*first);
}

}  // namespace indurop::tools
