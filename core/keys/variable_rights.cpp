// SPDX-License-Identifier: Apache-2.0
#include "core/keys/variable_rights.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::keys {
namespace {

constexpr const char* kRead = "read ";
constexpr const char* kWrite = "write ";

bool fits(char c) noexcept {
  constexpr std::string_view kMarks = "_:.*?[]!-";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         kMarks.find(c) != std::string_view::npos;
}

// Names of variables become paths of topics.
std::string topic_of(const std::string& pattern) {
  std::string topic;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const bool colons = pattern.compare(i, 2, "::") == 0;
    topic += colons || pattern[i] == '.' ? '/' : pattern[i];
    i += colons ? 1 : 0;
  }
  return topic;
}

}  // namespace

std::vector<std::string> pattern_list(const std::string& text) {
  std::vector<std::string> patterns;
  std::istringstream in(text);
  for (std::string each; std::getline(in, each, ',');) {
    patterns.emplace_back(base::trimmed(each));
  }
  if (patterns.empty()) {
    patterns.emplace_back();  // it is no pattern; no patterns at all would be no limit
  }
  return patterns;
}

std::string pattern_problem(const std::string& pattern) {
  if (!pattern.empty() && std::all_of(pattern.begin(), pattern.end(), fits)) {
    return {};
  }
  return base::in_quotes(pattern) + " is no pattern of variables; write a full name, or one with '*', such as cell::*";
}

std::string rights_text(const VariableRights& rights) {
  std::string text;
  for (const auto& [word, patterns] : {std::pair(kRead, &rights.read), std::pair(kWrite, &rights.write)}) {
    for (const std::string& pattern : *patterns) {
      text += word + pattern + "\n";
    }
  }
  return text;
}

Result<VariableRights, base::Problem> read_rights(const std::filesystem::path& file) {
  const auto text = base::read_file(file);
  if (!text) {
    return base::Problem{fmt::format("cannot read {}: {}", file.string(), text.error().text)};
  }
  VariableRights rights;
  std::istringstream in(*text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::string words(base::trimmed(line));
    if (words.empty()) {
      continue;
    }
    const bool reads = words.starts_with(kRead);
    if (!reads && !words.starts_with(kWrite)) {
      return base::Problem{fmt::format("{}:{}:1: error: {} is neither \"read PATTERN\" nor \"write PATTERN\"",
                                       file.string(), number, base::in_quotes(words))};
    }
    std::string pattern(base::trimmed(words.substr(words.find(' '))));
    if (const std::string wrong = pattern_problem(pattern); !wrong.empty()) {
      return base::Problem{fmt::format("{}:{}:1: error: {}", file.string(), number, wrong)};
    }
    (reads ? rights.read : rights.write).push_back(std::move(pattern));
  }
  return rights;
}

std::vector<std::string> variable_topics(const std::vector<std::string>& patterns) {
  std::vector<std::string> topics;
  for (const std::string& pattern : patterns) {
    topics.push_back(topic_of(pattern));
    topics.push_back("rt/" + topic_of(pattern));
  }
  return topics;
}

}  // namespace indurop::keys
