// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/boxes_text.h"

#include <system_error>

#include "core/base/json.h"
#include "history/recorder/boxes.h"

namespace indurop::deploy {

std::string boxes_text(const std::string& board) {
  using base::Json;
  Json list = Json::array();
  for (const recorder::Box& box : recorder::boxes_of(board)) {
    list.push_back(
        {{"name", box.file.filename().string()}, {"reason", box.reason}, {"bytes", box.bytes}, {"end_ns", box.end_ns}});
  }
  return Json{{"boxes", list}}.dump();
}

std::optional<std::filesystem::path> box_file(const std::string& board, const std::string& name) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(recorder::box_folder(board), ignored)) {
    if (entry.path().filename() == name && entry.path().extension() == ".mcap" && entry.is_regular_file(ignored)) {
      return entry.path();
    }
  }
  return std::nullopt;
}

}  // namespace indurop::deploy
