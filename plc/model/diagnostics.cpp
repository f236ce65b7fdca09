// SPDX-License-Identifier: Apache-2.0
#include "plc/model/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace indurop::plc {
namespace {

constexpr std::size_t kLimit = 100;

std::string_view file_of(const Place& place) noexcept {
  return place.file ? std::string_view(*place.file) : std::string_view();
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
  }
  if (errors_ > kLimit) {
    out += fmt::format("indurop plc: error: too many errors, the first {} are shown\n", kLimit);
  }
  return out;
}

}  // namespace indurop::plc
