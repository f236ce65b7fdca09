// SPDX-License-Identifier: Apache-2.0
#include "store/operate/node_json.h"

#include <filesystem>
#include <system_error>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "store/vars/retain.h"

namespace indurop::operate {

Status write_json(const std::string& node, const char* name, const base::Json& json) {
  const std::filesystem::path file = vars::state_directory(node) / name;
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  const auto written = base::replace_file(file, json.dump(), base::Durable::No);
  return written ? Status() : Status(Error{Errc::System, written.error().sys_errno, "folder of the node"});
}

std::optional<base::Json> read_json(const std::string& node, const char* name) {
  const auto text = base::read_file(vars::state_directory(node) / name);
  return text ? base::Json::parse(*text) : std::nullopt;
}

std::optional<base::Json> take_json(const std::string& node, const char* name) {
  auto json = read_json(node, name);
  std::error_code ignored;
  std::filesystem::remove(vars::state_directory(node) / name, ignored);
  return json;
}

}  // namespace indurop::operate
