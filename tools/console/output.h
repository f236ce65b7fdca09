// SPDX-License-Identifier: Apache-2.0
// The output of a verb: data to stdout, messages to stderr. Handles terminals, colour, a reader that has gone (no
// message) and a full disk (an error).

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/client/failure.h"
#include "tools/client/messages.h"
#include "tools/client/text/style.h"

namespace indurop::tools {

enum class ColorWhen { Auto, Always, Never };

// Terminal width and height of stdout; 80 x 24 if it is not a terminal.
struct Extent {
  int columns = 80;
  int rows = 24;
};

class Output final : public Messages {
 public:
  explicit Output(ColorWhen when = ColorWhen::Auto, bool quiet = false);

  void configure(ColorWhen when, bool quiet);

  // Appends to the pending output; flush() or the end of the program sends it.
  void write(std::string_view text) {
    pending_ += text;
    written_ = written_ || !text.empty();
  }
  void line(std::string_view text = {}) {
    pending_ += text;
    pending_ += '\n';
    written_ = true;
  }
  // Returns whether anything was written to stdout.
  [[nodiscard]] bool written() const noexcept { return written_; }
  // The first 100 messages of error() and message_line(), for output that a program reads.
  [[nodiscard]] const std::vector<std::string>& errors() const noexcept { return errors_; }
  // Returns false once stdout accepts no more output.
  bool flush();
  // Returns true if the reader of stdout has gone: stop working, this is not a failure.
  [[nodiscard]] bool reader_gone() const noexcept { return reader_gone_; }
  [[nodiscard]] int write_errno() const noexcept { return write_errno_; }

  // Messages, one line each, to stderr, after the pending output to stdout.
  void error(std::string_view text) override;
  void note(std::string_view text) override;  // silent with -q
  void message_line(std::string_view text);   // to stderr unchanged

  [[nodiscard]] bool terminal() const noexcept { return terminal_; }
  [[nodiscard]] bool unicode() const noexcept { return unicode_; }
  [[nodiscard]] bool quiet() const noexcept { return quiet_; }
  [[nodiscard]] Extent extent() const;
  [[nodiscard]] std::string paint(Style style, std::string_view text) const;

 private:
  void message(std::string_view kind, Style style, std::string_view text);
  void send(std::string_view text);
  void keep(std::string_view text);

  std::vector<std::string> errors_;
  std::string pending_;
  bool written_ = false;
  bool terminal_ = false;
  bool unicode_ = false;
  bool color_ = false;
  bool color_messages_ = false;
  bool quiet_ = false;
  bool reader_gone_ = false;
  int write_errno_ = 0;
};

// Prints the failure and returns the exit code.
inline int report(Output& out, const Failure& failure) {
  if (!failure.text.empty()) {
    out.error(failure.text);
  }
  return failure.code;
}

}  // namespace indurop::tools
