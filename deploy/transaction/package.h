// SPDX-License-Identifier: Apache-2.0
// What travels to the boards of a plant: the manifest and every file it names, each by its digest. The package is told
// as a text whose digest is the deployment's id, so an id stands for one exact content.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.h"
#include "config/model/plant.h"

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
  std::string comment;              // of whoever deploys it
};

std::string to_text(const Package& package);
// Everything in it is checked, whoever sent it; a problem if it is not a sound package.
Result<Package, base::Problem> read_package(std::string_view text);

struct PackedPlant {
  Package package;
  std::string text;
  std::string id;
  std::map<std::string, std::filesystem::path> sources;  // digest -> file here
};
// Every board gets all files, for each checks the whole plant itself. File names beginning with '/' mean the board's
// own files and do not travel. What lies outside of the manifest's folder and of the folders `also`, links followed,
// travels only if it is a module or a library of types: a project of somebody else must not take files of this machine
// along. A problem names all files that cannot be read or must not travel. Not real-time safe.
Result<PackedPlant, base::Problem> pack_plant(const config::Plant& plant,
                                              const std::vector<std::filesystem::path>& also = {},
                                              const std::string& comment = {});

}  // namespace indurop::deploy
