// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/format.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "control/robot/job/parser.h"
#include "core/base/text.h"

namespace indurop::robot {

namespace {

// Begins the next part of a block, in the column of its first part.
bool begins_part(const std::vector<JobLine::Keyword>& words) {
  constexpr std::string_view kParts[] = {"ELSE", "ELSEIF", "CASE", "DEFAULT", "RECOVER"};
  return !words.empty() && std::find(std::begin(kParts), std::end(kParts), words.front().word) != std::end(kParts);
}

class JobFormat {
 public:
  explicit JobFormat(const JobFile& file) : errors_("", found_, 0), parser_(book_, errors_, {}) { parser_.begin(file); }

  void add(std::string_view line) {
    const std::string_view content = base::trimmed(line);
    if (content.empty()) {
      waits_.emplace_back();
      return;
    }
    const std::size_t depth = parser_.depth();
    parser_.read_line(line);
    const auto& words = parser_.keywords();
    if (content.front() == '#' || content.starts_with("//")) {
      waits_.emplace_back(content);
      return;
    }
    std::string text(line);
    for (const JobLine::Keyword& each : words) {
      text.replace(each.column - 1, each.word.size(), each.word);
    }
    const bool part = begins_part(words) && depth > 0;
    add_waiting(part ? depth - 1 : depth);
    add(base::trimmed(text), part ? depth - 1 : std::min(depth, parser_.depth()));
  }
  std::string end() {
    add_waiting(parser_.depth());
    return std::move(text_);
  }

 private:
  // Comments belong to what follows them.
  void add_waiting(std::size_t depth) {
    for (const std::string& each : waits_) {
      add(each, each.empty() ? 0 : depth);
    }
    waits_.clear();
  }
  void add(std::string_view line, std::size_t depth) {
    if (line.empty()) {
      empty_ = !text_.empty();
      return;
    }
    text_ += empty_ ? "\n" : "";
    text_ += std::string(2 * depth, ' ');
    text_ += line;
    text_ += '\n';
    empty_ = false;
  }

  JobBook book_;
  std::vector<base::Diagnostic> found_;
  base::Diagnostics errors_;
  JobParser parser_;
  std::vector<std::string> waits_;  // comments and empty lines
  bool empty_ = false;              // an empty line waits for another one after it
  std::string text_;
};

}  // namespace

std::string format_job(const JobFile& file) {
  JobFormat format(file);
  for (JobLines lines(file.text); !lines.at_end();) {
    format.add(lines.take());
  }
  return format.end();
}

}  // namespace indurop::robot
