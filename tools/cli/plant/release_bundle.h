// SPDX-License-Identifier: Apache-2.0
// A release of the platform as one file (indurop platform pack).

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/base/problem.h"
#include "core/base/temporary_folder.h"
#include "deploy/link/blob_server.h"
#include "deploy/transaction/package.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Asks the agent of an installation for its version; empty: it cannot be run here.
std::string version_of_installation(const std::filesystem::path& prefix);

// Writes a release, signed with the deployer's keys in `keys`; without keys it is not signed, which a note says.
// Errors: keys that cannot sign, files that cannot be read or written.
Result<void, base::Problem> write_release(Context& context, const deploy::PackedPlant& packed, const std::string& keys,
                                          const std::filesystem::path& file);

struct ReleaseBundle {
  deploy::PackedPlant packed;
  std::unique_ptr<base::TemporaryFolder> temporary;  // its files
};
// Unpacks and checks a file of write_release(). With `keys`, the folder of a deployer, only one that a deployer of the
// same plant has signed. Errors: no such file, damaged, a plant instead of a release, signed by another authority.
Result<ReleaseBundle, Failure> read_release(const std::string& file, const std::filesystem::path& keys);

// Returns what a board requests by name: the package itself, or a file in it.
std::optional<deploy::BlobServer::Blob> blob_of(const deploy::PackedPlant& packed, const std::string& name);

}  // namespace indurop::tools
