// SPDX-License-Identifier: Apache-2.0
// What is deployed: the manifest of a plant with its files, or a bundle that `indurop pack` made of them.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/temporary_folder.h"
#include "deploy/bundle/bundle.h"
#include "deploy/transaction/package.h"
#include "tools/cli/command/verb.h"
#include "tools/cli/plant/project_files.h"

namespace indurop::tools {

struct PlantSource {
  config::Plant plant;
  deploy::PackedPlant packed;
  std::optional<Project> project;                    // whose sources travel; a bundle has packed its own
  std::optional<deploy::BundleSignature> signature;  // of a bundle
  std::unique_ptr<base::TemporaryFolder> temporary;  // the files of a bundle, or the archive of the sources
};

// Reads and checks a manifest, or a bundle, and packs its files and sources. Prints the diagnostics. `also` and
// `comment`: see deploy::pack_plant(); a bundle has its own. Errors: no such file, not a manifest (kUsage); the check
// found errors (kCheckFailed, without a text); files cannot be read, a damaged bundle (kFailed).
Result<PlantSource, Failure> read_plant_source(Context& context, const std::string& file,
                                               const std::vector<std::string>& also, const std::string& comment);

// Returns the failure of read_plant_source() with what was not done: "nothing was deployed".
Failure not_done(const Failure& failure, const char* act);

// Writes the bundle of a manifest, signed with the deployer's keys in `keys`, else in the folder of <security>; without
// keys it is not signed, which a note says. Errors: keys that cannot sign, files that cannot be read or written.
Result<void, base::Problem> write_signed_bundle(Context& context, const PlantSource& source, const std::string& keys,
                                                const std::filesystem::path& file);

// Returns why the bundle must not be deployed with the keys in `keys` (the folder of a deployer; empty: none); empty
// if it may.
std::string bundle_refusal(const PlantSource& source, const std::filesystem::path& keys);

}  // namespace indurop::tools
