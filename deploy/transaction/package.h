// SPDX-License-Identifier: Apache-2.0
// The package that is sent to the boards of a plant: the manifest and every file it names, each by its digest. The
// package is written as a text whose digest is the deployment's id, so an id identifies one exact content.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/model/plant.h"
#include "core/base/problem.h"

namespace indurop::deploy {

struct PackageFile {
  std::string path;  // relative, without ".."; in the deployment's folder
  std::string digest;
  std::uint64_t size = 0;
  bool executable = false;
};

struct Package {
  std::string plant;
  std::string manifest;             // path of the manifest among `files`
  std::vector<std::string> boards;  // boards of the plant, in file order
  std::vector<PackageFile> files;   // by path
  std::string comment;              // comment of the user who deploys it
  // Version of the platform of which these files are the programs and libraries, for boards of any plant: plant,
  // manifest and boards are empty then. Empty: a plant.
  std::string release;
};

std::string to_text(const Package& package);
// Checks everything in the text, regardless of the sender; returns a problem if it is not a valid package.
Result<Package, base::Problem> read_package(std::string_view text);

// Returns true if the package names the plant and exactly the boards of this plant, which its manifest describes.
bool is_package_of(const Package& package, const config::Plant& plant);

// Returns true for a path that a package may contain: relative, normal, without "..".
bool is_package_path(const std::string& path);

// Returns true for a file that begins as an ELF file does.
bool is_program(const std::filesystem::path& file);

struct PackedPlant {
  Package package;
  std::string text;
  std::string id;
  std::map<std::string, std::filesystem::path> sources;  // digest -> local file
};
// Packs all files for every board, because each checks the whole plant. File names that begin with '/' refer to the
// board's own files and are not sent. A file outside of the manifest's folder and of the folders `also`, links
// followed, is sent only if it is a module or a library of types: another user's project must not pick up files of this
// machine. `more`: files that travel too, by their path in the package. A problem names all files that cannot be read
// or must not be sent. Not real-time safe.
Result<PackedPlant, base::Problem> pack_plant(const config::Plant& plant,
                                              const std::vector<std::filesystem::path>& also = {},
                                              const std::string& comment = {},
                                              const std::map<std::string, std::filesystem::path>& more = {});

}  // namespace indurop::deploy
