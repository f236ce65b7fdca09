// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/command/screen.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "core/base/utf8.h"

namespace indurop::tools {

Screen::Screen(Output& output) : output_(output) {
  if (isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &before_) == 0 &&
      tcgetpgrp(STDIN_FILENO) == getpgrp()) {  // a background job must not touch the terminal
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    keys_ = tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
  }
  output_.write("\x1b[?25l");
}

Screen::~Screen() {
  output_.write("\x1b[?25h");
  output_.flush();
  if (keys_) {
    tcsetattr(STDIN_FILENO, TCSANOW, &before_);
  }
}

void Screen::paint(const std::vector<std::string>& lines) {
  if (painted_ > 0) {
    output_.write(fmt::format("\x1b[{}A", painted_));
  }
  const auto columns = static_cast<std::size_t>(output_.extent().columns);
  for (const std::string& line : lines) {
    output_.write("\r" + cut_to_width(line, columns) + "\x1b[K\n");
  }
  output_.write("\x1b[J");
  painted_ = lines.size();
}

char Screen::key() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char c = 0;
  if (!keys_ || poll(&input, 1, 0) <= 0) {
    return 0;
  }
  if (::read(STDIN_FILENO, &c, 1) <= 0) {
    keys_ = false;  // closed: stop polling it
    tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    return 0;
  }
  return c;
}

std::string cut_to_width(const std::string& text, std::size_t columns) {
  std::string out;
  std::size_t width = 0;
  bool cut = false;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '\x1b') {
      const std::size_t end = text.find('m', i);
      const std::size_t length = end == std::string::npos ? text.size() - i : end - i + 1;
      out += text.substr(i, length);
      i += length;
      continue;
    }
    std::size_t length = 1;
    while (i + length < text.size() && base::continues_utf8(text[i + length])) {
      ++length;
    }
    cut = cut || width == columns;
    if (!cut) {
      out += text.substr(i, length);
      ++width;
    }
    i += length;
  }
  return out;
}

}  // namespace indurop::tools
