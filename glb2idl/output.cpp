// SPDX-License-Identifier: Apache-2.0
// Files of generated texts.

#include "glb2idl/output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace indurop::glb2idl {
namespace {

namespace fs = std::filesystem;

bool holds(const fs::path& path, std::string_view text) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed) || fs::file_size(path, failed) != text.size() || failed) {
    return false;
  }
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return in.good() && content.view() == text;
}

std::string failure(const fs::path& path, int number) {
  return fmt::format("cannot write '{}': {}, check the folder and its rights", path.string(),
                     std::generic_category().message(number));
}

// 0, or errno.
int write_bytes(int fd, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      return errno;
    }
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return 0;
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
      return failure(target.parent_path(), failed.value());
    }
  }
  const std::string temporary = fmt::format("{}.{}.tmp", path, ::getpid());
  constexpr mode_t kMode = 0666;  // less the user's umask
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (fd < 0) {
    return failure(target, errno);
  }
  int error = write_bytes(fd, text);
  if (::close(fd) != 0 && error == 0) {
    error = errno;
  }
  if (error == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) {
    ::unlink(temporary.c_str());
    return failure(target, error);
  }
  return {};
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
