// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/diagnostics.h"

#include <string_view>
#include <utility>

#include "core/base/source_line.h"

namespace indurop::plc {
namespace {

bool is_word(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

void Diagnostics::add(base::Diagnostic::Severity severity, const Place& at, std::string text) {
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): the rest of the place has fields of its own below
  const std::size_t before = found_.size();
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): the rest of the place has fields of its own below
  all_.add({severity, at.file ? *at.file : std::string(), at, std::move(text)});
  if (found_.size() > before) {  // otherwise it is a duplicate, or there are too many
    found_.back().within = at.within ? *at.within : std::string();
    found_.back().picture = picture(at);
  }
}

std::string Diagnostics::picture(const Place& at) const {
  const auto text = at.file == nullptr ? texts_.end() : texts_.find(*at.file);
  if (text == texts_.end() || at.line == 0 || at.column == 0) {
    return {};
  }
  std::string_view rest = text->second;
  for (int line = 1; line < at.line; ++line) {
    const std::size_t end = rest.find('\n');
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  std::string_view line = rest.substr(0, rest.find('\n'));
  line = line.substr(0, line.find('\r'));
  // The marker is as long as the word there.
  const auto column = static_cast<std::size_t>(at.column);
  std::size_t width = 1;
  for (std::size_t i = column; i < line.size() && is_word(line[i]) && is_word(line[column - 1]); ++i) {
    ++width;
  }
  return base::picture_of_line(line, column, width);
}

std::vector<base::Diagnostic> Diagnostics::list() const {
  std::vector<base::Diagnostic> list = found_;
  base::sort_by_file(list);
  all_.add_summary(list);
  return list;
}

}  // namespace indurop::plc
