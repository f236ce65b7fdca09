// SPDX-License-Identifier: Apache-2.0
#include "tools/console/output.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

#include "core/base/printable.h"

namespace indurop::tools {
namespace {

bool utf8_locale() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && *value != '\0') {
      const std::string_view text(value);
      return text.find("UTF-8") != std::string_view::npos || text.find("utf8") != std::string_view::npos;
    }
  }
  return false;
}

bool wants_color(ColorWhen when, int fd) {
  if (when != ColorWhen::Auto) {
    return when == ColorWhen::Always;
  }
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return isatty(fd) == 1 && (no_color == nullptr || *no_color == '\0') &&
         (term == nullptr || std::string_view(term) != "dumb");
}

constexpr std::string_view kPlain = "\x1b[0m";

const char* code_of(Style style) {
  switch (style) {
    case Style::None:
      return "";
    case Style::Bold:
      return "\x1b[1m";
    case Style::Dim:
      return "\x1b[2m";
    case Style::Good:
      return "\x1b[32m";
    case Style::Warn:
      return "\x1b[33m";
    case Style::Bad:
      return "\x1b[1;31m";
    case Style::Accent:
      return "\x1b[36m";
  }
  return "";
}

std::string painted(bool color, Style style, std::string_view text) {
  if (!color || style == Style::None || text.empty()) {
    return std::string(text);
  }
  std::string out = code_of(style);
  out += text;
  out += kPlain;
  return out;
}

constexpr std::array kOurStyles{Style::Bold, Style::Dim, Style::Good, Style::Warn, Style::Bad, Style::Accent};
constexpr std::array<std::string_view, 4> kOfScreen{"\x1b[?25l", "\x1b[?25h", "\x1b[H\x1b[J", "\x1b[J"};

// Returns the length of the escape sequence at the beginning if it is one of this program: of paint(), or of Screen,
// which writes its own at the beginning of a line.
std::size_t length_of_ours(std::string_view text, bool line_begins) {
  for (const Style style : kOurStyles) {
    if (const std::string_view code = code_of(style); text.starts_with(code)) {
      return code.size();
    }
  }
  constexpr std::string_view kRestOfLine = "\x1b[K";
  for (const std::string_view code : {kPlain, kRestOfLine}) {
    if (text.starts_with(code)) {
      return code.size();
    }
  }
  for (const std::string_view code : kOfScreen) {
    if (line_begins && text.starts_with(code)) {
      return code.size();
    }
  }
  const std::size_t up = text.find_first_not_of("0123456789", 2);
  return line_begins && text.starts_with("\x1b[") && up != std::string_view::npos && text[up] == 'A' ? up + 1 : 0;
}

// Makes text of others harmless, so that it cannot move the cursor: all output to a terminal passes through this.
std::string harmless(std::string_view text, std::string_view kept) {
  std::string out;
  bool line_begins = true;
  while (!text.empty()) {
    const std::size_t escape = text.find('\x1b');
    const std::string plain = base::printable(text.substr(0, escape), kept);
    line_begins = plain.empty() ? line_begins : plain.back() == '\n';
    out += plain;
    text.remove_prefix(std::min(escape, text.size()));
    if (!text.empty()) {
      const std::size_t length = length_of_ours(text, line_begins);
      out += length > 0 ? text.substr(0, length) : "?";
      text.remove_prefix(std::max<std::size_t>(length, 1));
    }
  }
  return out;
}

// Returns 0 or errno.
int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n >= 0) {
      text.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      pollfd wait{fd, POLLOUT, 0};
      constexpr int kSlowReaderMs = 1000;
      poll(&wait, 1, kSlowReaderMs);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

Output::Output(ColorWhen when, bool quiet) {
  configure(when, quiet);
}

void Output::configure(ColorWhen when, bool quiet) {
  terminal_ = isatty(STDOUT_FILENO) == 1;
  unicode_ = utf8_locale();
  color_ = wants_color(when, STDOUT_FILENO);
  color_messages_ = wants_color(when, STDERR_FILENO);
  quiet_ = quiet;
}

bool Output::flush() {
  if (write_errno_ == 0 && !pending_.empty()) {
    write_errno_ = write_all(STDOUT_FILENO, terminal_ ? harmless(pending_, "\n\t\r") : pending_);
    reader_gone_ = write_errno_ == EPIPE;
  }
  pending_.clear();
  return write_errno_ == 0;
}

void Output::send(std::string_view text) {
  flush();
  static_cast<void>(
      write_all(STDERR_FILENO, harmless(text, "\n\t") + '\n'));  // there is no place to report that stderr is broken
}

void Output::keep(std::string_view text) {
  constexpr std::size_t kMaxErrors = 100;
  if (errors_.size() < kMaxErrors) {
    errors_.emplace_back(text);
  }
}

void Output::message_line(std::string_view text) {
  keep(text);
  send(text);
}

void Output::message(std::string_view kind, Style style, std::string_view text) {
  send("indurop: " + painted(color_messages_, style, kind) + std::string(text));
}

void Output::error(std::string_view text) {
  keep(text);
  message("error: ", Style::Bad, text);
}

void Output::note(std::string_view text) {
  if (!quiet_) {
    message("", Style::None, text);
  }
}

Extent Output::extent() const {
  winsize size{};
  if (terminal_ && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0) {
    return {size.ws_col, size.ws_row};
  }
  return {};
}

std::string Output::paint(Style style, std::string_view text) const {
  return painted(color_, style, text);
}

}  // namespace indurop::tools
