// SPDX-License-Identifier: Apache-2.0
// Uses comments as descriptions.

#include "glb2idl/description.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::glb2idl {
namespace {

bool lies_before(const Comment& comment, std::uint32_t offset) noexcept {
  return comment.offset < offset;
}

}  // namespace

std::string Descriptions::find(const TokenReader& in, std::size_t begin) const {
  const Span last = in.previous().at;
  const auto behind = std::lower_bound(comments_.begin(), comments_.end(), last.offset + last.length, lies_before);
  if (behind != comments_.end() && behind->first_line == sources_.line_of(last) &&
      behind->offset < in.peek().at.offset && !behind->text.empty()) {
    return behind->text;
  }
  // A comment above a line describes the first declaration of the line.
  return in.at(begin).newline_before ? above(in.at(begin).at) : std::string();
}

std::string Descriptions::above(Span first) const {
  const std::string& path = sources_.file(file_).path;
  const std::string_view file_name = std::string_view(path).substr(path.rfind('/') + 1);
  int line = sources_.line_of(first);
  std::vector<std::string_view> lines;  // from below
  auto i = std::lower_bound(comments_.begin(), comments_.end(), first.offset, lies_before);
  while (i != comments_.begin()) {
    --i;
    if (!i->own_line || i->last_line + 1 != line || i->text == file_name) {
      break;
    }
    lines.emplace_back(i->text);
    line = i->first_line;
  }
  std::string text;
  for (auto one = lines.rbegin(); one != lines.rend(); ++one) {
    text += (text.empty() || one->empty() ? "" : " ") + std::string(*one);
  }
  return text;
}

}  // namespace indurop::glb2idl
