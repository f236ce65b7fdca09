// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/node_output.h"

#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <string_view>

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxLineLength = 500;

}  // namespace

void NodeOutput::close() noexcept {
  if (pipe_ >= 0) {
    ::close(pipe_);
  }
  pipe_ = -1;
  line_.clear();
  (void)others_.rest();
}

void NodeOutput::add(char c, bool replace) {
  if (c != '\n') {
    if (line_.size() < kMaxLineLength) {
      line_ += c;
    }
    return;
  }
  if (line_.find("error: ") != std::string::npos && (replace || last_error_.empty())) {
    last_error_ = line_;
  }
  line_.clear();
}

void NodeOutput::copy(bool replace) {
  if (pipe_ < 0) {
    return;
  }
  std::array<char, 4096> block{};
  ssize_t got = 0;
  while ((got = ::read(pipe_, block.data(), block.size())) > 0) {
    const std::string_view text(block.data(), static_cast<std::size_t>(got));
    const std::string others = others_.pass(text);
    std::fwrite(others.data(), 1, others.size(), stderr);
    for (const char c : text) {
      add(c, replace);
    }
  }
  if (got == 0) {
    add('\n', replace);  // nothing ends the line of a node that died in it
    std::fputs(others_.rest().c_str(), stderr);
    close();
  }
}

}  // namespace indurop::deploy
