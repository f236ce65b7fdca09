// SPDX-License-Identifier: Apache-2.0
#include "core/base/line_journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/base/descriptor.h"
#include "core/base/read_file.h"

namespace indurop::base {
namespace {

std::filesystem::path before(const std::filesystem::path& file) {
  return file.string() + ".1";
}

}  // namespace

std::string append_line(const LineJournal& journal, std::string line) {
  std::error_code error;
  std::filesystem::create_directories(journal.file.parent_path(), error);
  if (const auto size = std::filesystem::file_size(journal.file, error); !error && size > journal.max_bytes) {
    std::filesystem::rename(journal.file, before(journal.file), error);
  }
  line += '\n';
  const Descriptor fd(::open(journal.file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, journal.mode));
  const bool good = fd.is_open() && ::write(fd.get(), line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
                    (journal.durable == Durable::No || ::fdatasync(fd.get()) == 0);
  return good ? std::string() : std::strerror(errno);
}

void each_line(const std::filesystem::path& file, const std::function<void(std::string_view)>& use) {
  for (const std::filesystem::path& part : {before(file), file}) {
    const auto text = read_file(part);
    std::string_view rest = text ? std::string_view(*text) : std::string_view();
    while (!rest.empty()) {
      const auto end = std::min(rest.find('\n'), rest.size());
      use(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
}

}  // namespace indurop::base
