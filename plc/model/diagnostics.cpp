// SPDX-License-Identifier: Apache-2.0
#include "plc/model/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "glb2idl/source_line.h"

namespace indurop::plc {
namespace {

constexpr std::size_t kLimit = 100;

std::string_view file_of(const Place& place) noexcept {
  return place.file ? std::string_view(*place.file) : std::string_view();
}

bool is_word(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

void Diagnostics::add(bool is_error, const Place& at, std::string text) {
  const auto same = [&](const Message& m) {
    return m.at.line == at.line && m.at.column == at.column && m.text == text && file_of(m.at) == file_of(at);
  };
  if (std::any_of(messages_.begin(), messages_.end(), same)) {
    return;
  }
  errors_ += is_error ? 1U : 0U;
  if (messages_.size() < kLimit) {
    messages_.push_back({is_error, at, std::move(text)});
  }
}

std::string Diagnostics::picture(const Place& at) const {
  const auto text = at.file == nullptr ? texts_.end() : texts_.find(*at.file);
  if (text == texts_.end() || at.line == 0 || at.column == 0) {
    return {};
  }
  std::string_view rest = text->second;
  for (std::uint32_t line = 1; line < at.line; ++line) {
    const std::size_t end = rest.find('\n');
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  std::string_view line = rest.substr(0, rest.find('\n'));
  line = line.substr(0, line.find('\r'));
  // The mark is as long as the word there.
  std::size_t width = 1;
  for (std::size_t i = at.column; i < line.size() && is_word(line[i]) && is_word(line[at.column - 1]); ++i) {
    ++width;
  }
  return glb2idl::picture_of_line(line, at.column, width);
}

std::string Diagnostics::render() const {
  std::vector<std::string_view> files;
  for (const Message& m : messages_) {
    if (std::find(files.begin(), files.end(), file_of(m.at)) == files.end()) {
      files.push_back(file_of(m.at));
    }
  }
  std::vector<const Message*> sorted;
  for (const Message& m : messages_) {
    sorted.push_back(&m);
  }
  const auto key = [&](const Message* m) {
    return std::tuple(std::find(files.begin(), files.end(), file_of(m->at)) - files.begin(), m->at.line, m->at.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Message* a, const Message* b) { return key(a) < key(b); });
  std::string out;
  for (const Message* m : sorted) {
    const std::string place = to_string(m->at);
    out += fmt::format("{}{}: ", place.empty() ? "indurop plc" : place, m->is_error ? ": error" : ": warning");
    out += m->at.within ? fmt::format("{}: {}\n", *m->at.within, m->text) : m->text + "\n";
    out += picture(m->at);
  }
  if (errors_ > kLimit) {
    out += fmt::format("indurop plc: error: too many errors, the first {} are shown\n", kLimit);
  }
  return out;
}

}  // namespace indurop::plc
