// SPDX-License-Identifier: Apache-2.0
// What travels to the boards of a plant: the manifest and every file it names, each by its digest. The package is told
// as a text whose digest is the deployment's id, so an id stands for one exact content.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "deploy/plant.h"

namespace indurop::deploy {

struct PackageFile {
  std::string path;  // relative, without ".."; below the deployment's folder
  std::string digest;
  std::uint64_t size = 0;
  bool executable = false;
};

struct Package {
  std::string plant;
  std::string manifest;             // path of the manifest among `files`
  std::vector<std::string> boards;  // of the plant, in file order
  std::vector<PackageFile> files;   // by path
};

std::string to_text(const Package& package);
// Empty, and `problem` says why, if the text is not a sound package: everything in it is checked, whoever sent it.
std::optional<Package> read_package(std::string_view text, std::string& problem);

struct PackedPlant {
  Package package;
  std::string text;
  std::string id;
  std::map<std::string, std::filesystem::path> sources;  // digest -> file here
};
// Every board gets all files, for each checks the whole plant itself. File names beginning with '/' mean the board's
// own files and do not travel. Empty, and `problem` says why, if a file cannot be read. Not real-time safe.
std::optional<PackedPlant> pack_plant(const Plant& plant, std::string& problem);

}  // namespace indurop::deploy
