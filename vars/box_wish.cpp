// SPDX-License-Identifier: Apache-2.0
#include "vars/box_wish.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/read_file.h"
#include "base/replace_file.h"
#include "vars/retain.h"

namespace indurop::vars {
namespace {

constexpr std::size_t kLongest = 400;

std::filesystem::path file_of(const std::string& node) {
  return state_directory(node) / "keep-box";
}

}  // namespace

Status wish_box(const std::string& node, const std::string& why) {
  const std::filesystem::path file = file_of(node);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  const auto written = base::replace_file(file, why.substr(0, kLongest), base::Durable::No);
  return written ? Status() : Status(Error{Errc::System, EIO, "folder of the node"});
}

std::optional<std::string> take_box_wish(const std::string& node) {
  const std::filesystem::path file = file_of(node);
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return std::nullopt;
  }
  auto text = base::read_file(file, kLongest);
  std::filesystem::remove(file, error);
  if (!text) {
    return std::nullopt;
  }
  std::replace_if(
      text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return std::move(text).value();
}

}  // namespace indurop::vars
