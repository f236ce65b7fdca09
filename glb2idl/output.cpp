// SPDX-License-Identifier: Apache-2.0
// Writes generated texts to files.

#include "glb2idl/output.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::glb2idl {
namespace {

namespace fs = std::filesystem;

bool holds(const fs::path& path, std::string_view text) {
  const auto content = base::read_file(path, text.size());
  return content && *content == text;
}

std::string failure(const fs::path& path, const std::string& reason) {
  return fmt::format("cannot write '{}': {}, check the folder and its rights", path.string(), reason);
}

}  // namespace

std::string write_file(const std::string& path, std::string_view text) {
  const fs::path target(path);
  if (holds(target, text)) {
    return {};
  }
  std::error_code failed;
  if (target.has_parent_path()) {
    fs::create_directories(target.parent_path(), failed);
    if (failed) {
      return failure(target.parent_path(), failed.message());
    }
  }
  const auto written = base::replace_file(target, text, base::Durable::No);
  return written ? std::string{} : failure(target, written.error().text);
}

std::string write_all(const std::string& folder, const std::vector<Output>& outputs) {
  for (const Output& output : outputs) {
    std::string error = write_file((fs::path(folder) / output.path).string(), output.text);
    if (!error.empty()) {
      return error;
    }
  }
  return {};
}

std::string depfile_text(const std::string& target, const std::vector<std::string>& files) {
  const auto escaped = [](const std::string& path) {
    std::string out;
    for (const char c : path) {
      if (c == ' ' || c == '#' || c == '\\') {
        out += '\\';
      } else if (c == '$') {
        out += '$';
      }
      out += c;
    }
    return out;
  };
  std::string out = escaped(target) + ":";
  for (const std::string& file : files) {
    std::error_code failed;
    const fs::path absolute = fs::absolute(file, failed);
    out += " \\\n  " + escaped(failed ? file : absolute.lexically_normal().string());
  }
  return out + "\n";
}

}  // namespace indurop::glb2idl
