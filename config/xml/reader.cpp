// SPDX-License-Identifier: Apache-2.0
#include "config/xml/reader.h"

#include "config/xml/document.h"
#include "config/xml/interpret.h"

namespace indurop::config {

bool ReadResult::ok() const noexcept {
  return !base::has_error(diagnostics);
}

ReadResult read_config(const std::filesystem::path& file) {
  const auto bytes = read_bytes(file, kModuleXml);
  if (bytes) {
    return read_config_text(*bytes, file);
  }
  ReadResult result;
  result.config.file = file;
  result.diagnostics.push_back(bytes.error());
  return result;
}

ReadResult read_config_text(std::string_view xml, const std::filesystem::path& pretend_file) {
  ReadResult result;
  result.config.file = pretend_file;
  if (const auto root = read_document(xml, pretend_file, kModuleXml, result.diagnostics)) {
    config::interpret(*root, result.config, result.diagnostics);
  }
  return result;
}

}  // namespace indurop::config
