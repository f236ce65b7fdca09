// SPDX-License-Identifier: Apache-2.0
#include "history/recorder/boxes.h"

#include <algorithm>
#include <iterator>
#include <system_error>

#include "history/recording/mcap_reader.h"
#include "store/vars/retain.h"

namespace indurop::recorder {

Box read_box(const std::filesystem::path& file, const std::string& node) {
  std::error_code ignored;
  Box box{file, node, "", std::filesystem::file_size(file, ignored)};
  const auto reader = recording::McapReader::open(file);
  if (!reader) {
    box.reason = reader.error().text;
    return box;
  }
  box.reason = reader->contents().has_summary ? "" : "not complete";
  box.end_ns = reader->contents().span_ns().second;
  for (const auto& index : reader->contents().metadata) {
    if (const auto about = reader->metadata(index); about && about->values.contains("reason")) {
      box.reason = about->values.at("reason");
    }
  }
  return box;
}

namespace {

void sort_newest_first(std::vector<Box>& boxes) {
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& a, const Box& b) { return a.file.filename() > b.file.filename(); });
}

}  // namespace

void sort_oldest_first(std::vector<std::filesystem::path>& files, const std::filesystem::path& next) {
  const auto earlier = std::partition(files.begin(), files.end(), [&next](const auto& one) { return one > next; });
  std::sort(files.begin(), earlier);
  std::sort(earlier, files.end());
}

std::filesystem::path box_folder(const std::string& node) {
  return vars::state_directory(node) / "boxes";
}

std::vector<Box> boxes_of(const std::string& node) {
  std::vector<Box> boxes;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(box_folder(node), ignored)) {
    if (entry.path().extension() == ".mcap") {
      boxes.push_back(read_box(entry.path(), node));
    }
  }
  sort_newest_first(boxes);
  return boxes;
}

std::vector<Box> boxes_here() {
  std::vector<Box> boxes;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(vars::state_directory("x").parent_path(), ignored)) {
    auto more = boxes_of(entry.path().filename().string());
    std::move(more.begin(), more.end(), std::back_inserter(boxes));
  }
  sort_newest_first(boxes);
  return boxes;
}

}  // namespace indurop::recorder
