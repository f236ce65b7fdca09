// SPDX-License-Identifier: Apache-2.0
#include "deploy/reader.h"

#include "deploy/document.h"

namespace indurop::deploy {

bool ReadResult::ok() const noexcept {
  return !has_error(diagnostics);
}

ReadResult read_config(const std::filesystem::path& file) {
  std::string problem;
  const std::string bytes = read_bytes(file, kModuleXml, problem);
  if (problem.empty()) {
    return read_config_text(bytes, file);
  }
  ReadResult result;
  result.config.file = file;
  result.diagnostics.push_back({Diagnostic::Severity::Error, file.string(), {}, std::move(problem)});
  return result;
}

ReadResult read_config_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  ReadResult result;
  result.config.file = pretend_file;
  if (const auto root = read_document(xml, pretend_file, kModuleXml, result.diagnostics)) {
    interpret(*root, result.config, result.diagnostics);
  }
  return result;
}

}  // namespace indurop::deploy
