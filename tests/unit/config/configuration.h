// SPDX-License-Identifier: Apache-2.0
// Short ways to configurations and their diagnostics for the tests of this folder.

#pragma once

#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "config/check/check.h"
#include "config/xml/reader.h"

namespace indurop::config {

inline std::vector<std::string> lines(const std::vector<base::Diagnostic>& diagnostics) {
  std::vector<std::string> all;
  for (const base::Diagnostic& d : diagnostics) {
    all.push_back(base::to_string(d));
  }
  return all;
}

inline std::vector<std::string> errors_of(std::string_view xml) {
  return lines(read_config_text(xml, "m.xml").diagnostics);
}

// A periodic thread module in one line; `more` are further elements.
inline std::string periodic(const std::string& file, const std::string& period, int priority,
                            const std::string& more = "") {
  return "<module><filename>" + file +
         "</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>" + "<period>" + period +
         "</period><priority>" + std::to_string(priority) + "</priority>" + more + "</module>\n";
}
inline std::string sporadic(const std::string& file, const std::string& type, int priority,
                            const std::string& more = "") {
  return "<module><filename>" + file + "</filename><moduletype>" + type +
         "</moduletype><operationtype>sporadic</operationtype><deadline>1ms</deadline><priority>" +
         std::to_string(priority) + "</priority>" + more + "</module>\n";
}
inline std::string non_real(const std::string& file, const std::string& more = "") {
  return "<module><filename>" + file +
         "</filename><moduletype>process</moduletype><operationtype>non-real</operationtype>" + more + "</module>\n";
}
inline std::string root(const std::string& content) {
  return "<root>\n" + content + "</root>\n";
}

// Requires that reading finds no errors.
inline Config config_of(const std::string& xml, const std::filesystem::path& file = "m.xml") {
  ReadResult read = read_config_text(xml, file);
  EXPECT_THAT(lines(read.diagnostics), testing::IsEmpty());
  return std::move(read.config);
}

struct Checked {
  Config config;
  CheckResult result;
  [[nodiscard]] std::vector<std::string> lines() const { return config::lines(result.diagnostics); }
};
inline Checked check(const std::string& xml, const CheckOptions& options, const std::filesystem::path& file = "m.xml") {
  Checked checked{config_of(xml, file), {}};
  checked.result = check_config(checked.config, options);
  return checked;
}

}  // namespace indurop::config
