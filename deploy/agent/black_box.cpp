// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/black_box.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <system_error>
#include <vector>

#include "core/base/replace_file.h"
#include "deploy/agent/run_image.h"
#include "history/recorder/boxes.h"

namespace indurop::deploy {

std::string BlackBox::keep() const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const std::filesystem::path file =
      folder_ / fmt::format("{:%Y%m%dT%H%M%S}.{:03}Z.run", fmt::gmtime(std::chrono::system_clock::to_time_t(now)),
                            now.time_since_epoch().count() % 1000);
  if (const auto written = base::replace_file(file, run_image(board_), base::Durable::Yes); !written) {
    return fmt::format("its black box could not be kept: {}", base::cannot_write(file.string(), written.error()));
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    files.push_back(entry.path());
  }
  recorder::sort_oldest_first(files, file);
  for (std::size_t i = 0; i + kKept < files.size(); ++i) {
    std::filesystem::remove(files[i], error);
  }
  return fmt::format("its black box is in {}", file.string());
}

}  // namespace indurop::deploy
