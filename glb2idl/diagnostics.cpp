// SPDX-License-Identifier: Apache-2.0
// Messages with source line and caret.

#include "glb2idl/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "glb2idl/source_line.h"

namespace indurop::glb2idl {
void Diagnostics::add(std::optional<Span> at, std::string text) {
  const auto same = [&](const Message& m) {
    return m.text == text && m.at.has_value() == at.has_value() &&
           (!at || (m.at->file == at->file && m.at->offset == at->offset));
  };
  if (std::any_of(messages_.begin(), messages_.end(), same) || errors_++ >= kLimit) {
    return;
  }
  messages_.push_back({at, std::move(text)});
}

std::string Diagnostics::place(Span at) const {
  return fmt::format("{}:{}", sources_.file(at.file).path, sources_.line_of(at));
}

std::string Diagnostics::render() const {
  std::vector<const Message*> sorted;
  for (const Message& m : messages_) {
    sorted.push_back(&m);
  }
  const auto key = [](const Message* m) {
    return m->at ? std::pair<std::int64_t, std::uint32_t>(m->at->file, m->at->offset)
                 : std::pair<std::int64_t, std::uint32_t>(-1, 0);
  };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Message* a, const Message* b) { return key(a) < key(b); });
  std::string out;
  for (const Message* m : sorted) {
    if (!m->at) {
      out += fmt::format("glb2idl: error: {}\n", m->text);
      continue;
    }
    const LineColumn place = sources_.place_of(*m->at);
    out += fmt::format("{}:{}:{}: error: {}\n", sources_.file(m->at->file).path, place.line, place.column, m->text);
    out += picture_of_line(sources_.line_text(m->at->file, place.line), place.column, m->at->length);
  }
  if (errors_ > kLimit) {
    out += fmt::format("glb2idl: error: too many errors, the first {} are shown\n", kLimit);
  }
  return out;
}

}  // namespace indurop::glb2idl
