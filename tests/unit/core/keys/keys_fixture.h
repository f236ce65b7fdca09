// SPDX-License-Identifier: Apache-2.0
// A folder with the keys of a plant of two boards.

#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "core/keys/deploy_list.h"
#include "core/keys/plant_keys.h"
#include "tests/unit/config/configuration.h"
#include "tests/unit/config/module_file.h"

namespace indurop::keys {

namespace fs = std::filesystem;
using std::chrono::days;

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class Keys : public testing::Test {
 protected:
  Keys() : sut(folder_ / "keys") {}
  void make(days valid = days(100)) { ASSERT_TRUE(sut.make("cell", {"a", "b"}, now + valid)); }
  KeyCheck check(const fs::path& folder, const std::string& board = "a", days later = days(0)) const {
    return check_board_keys(folder, "cell", board, now + later);
  }
  KeyListing listed(const std::string& name) const {
    for (const KeyListing& each : sut.list(now)) {
      if (each.name == name) {
        return each;
      }
    }
    ADD_FAILURE() << "nothing of " << name;
    return {};
  }
  std::vector<std::string> checked(const std::string& security, const config::CheckOptions& options = {}) const {
    config::ReadPlant read = config::read_plant_text(
        "<plant name=\"cell\">" + security + "<board name=\"a\"></board><board name=\"b\"></board></plant>",
        folder_ / "plant.xml");
    EXPECT_TRUE(read.ok()) << testing::PrintToString(config::lines(read.diagnostics));
    return config::lines(config::check_plant(read.plant, options).diagnostics);
  }

  config::ModuleFolder folder_;
  const Instant now = instant_now();
  PlantKeys sut;
};

}  // namespace indurop::keys
