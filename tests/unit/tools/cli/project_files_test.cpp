// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/project_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tools/client/process/temporary_folder.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "text\n";
}

// A folder that is no work tree of git.
TEST(ProjectFiles, Recordings_and_what_was_built_are_no_sources) {
  const TemporaryFolder folder;
  for (const char* file : {"CMakeLists.txt", "plant.xml", "src/tick.cpp", "run.mcap", "recordings/night.2.mcap",
                           "build/tick.o", "build-arm64/tick.o", ".cache/index", "mcap/notes.txt"}) {
    put(folder.path() / file);
  }
  config::Plant plant;
  plant.file = folder.path() / "plant.xml";
  const auto project = find_project(plant);
  ASSERT_TRUE(project.ok() && project->has_value());
  std::vector<std::string> paths;
  for (const deploy::ProjectFile& file : (*project)->files) {
    paths.push_back(file.path);
  }
  EXPECT_THAT(paths, testing::UnorderedElementsAre("CMakeLists.txt", "plant.xml", "src/tick.cpp", "mcap/notes.txt"));
}

}  // namespace
}  // namespace indurop::tools
