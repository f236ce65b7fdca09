// SPDX-License-Identifier: Apache-2.0
#include "node/modules/file_mark.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <string_view>

namespace indurop::node {
namespace {

bool is_script(const std::filesystem::path& file) {
  std::array<char, 2> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == "#!";
}

}  // namespace

FileMark mark_of(const std::filesystem::path& file) {
  struct stat info {};
  constexpr std::int64_t kSecondNs = 1'000'000'000;
  return ::stat(file.c_str(), &info) != 0
             ? FileMark{}
             : FileMark{info.st_dev, info.st_ino, info.st_size, info.st_mtim.tv_sec * kSecondNs + info.st_mtim.tv_nsec};
}

bool executes(int pid, const std::filesystem::path& file, const FileMark& mark) {
  const FileMark executed = mark_of(fmt::format("/proc/{}/exe", pid));
  return executed == mark || executed == FileMark{} || is_script(file);
}

}  // namespace indurop::node
