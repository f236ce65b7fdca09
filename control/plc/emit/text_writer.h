// SPDX-License-Identifier: Apache-2.0
// Lines of generated code with their indentation.

#pragma once

#include <string>
#include <string_view>

namespace indurop::plc {

class TextWriter {
 public:
  void line(std::string_view text = {}) {
    if (!text.empty()) {
      text_.append(static_cast<std::size_t>(depth_) * 2, ' ');
      text_ += text;
    }
    text_ += '\n';
  }
  // Writes a line that opens braces; the following lines are indented until close().
  void open(std::string_view text) {
    line(std::string(text) + " {");
    ++depth_;
  }
  void close(std::string_view behind = {}) {
    --depth_;
    line("}" + std::string(behind));
  }
  // "} else {"
  void reopen(std::string_view text) {
    --depth_;
    line("} " + std::string(text) + " {");
    ++depth_;
  }
  // Writes text unchanged, not indented.
  void raw(std::string_view text) { text_ += text; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
  int depth_ = 0;
};

}  // namespace indurop::plc
