// SPDX-License-Identifier: Apache-2.0
// A plant as one file: the package, every file it lists, and who packed it. A tar archive compressed by zstd, so `tar
// tf cell.bundle` shows it. Members in this order: package.json (deploy/transaction/package.h), signature.json, and
// files/DIGEST for each different file. Two bundles of the same files differ in their signatures only.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "deploy/transaction/package.h"

namespace indurop::deploy {

// Who packed a bundle: the signature over package.json by the key that `certificate` (PEM) belongs to. Both are empty
// in a bundle that was packed without keys.
struct BundleSignature {
  std::string certificate;
  std::string signature;
};

// Returns the signature of `package_text` by the participant whose keys are in `folder`. Errors: no keys, keys that
// cannot sign.
Result<BundleSignature, base::Problem> sign_package(const std::string& package_text,
                                                    const std::filesystem::path& folder);

// Returns why the signature does not count for a plant with this authority (PEM) and its revocation list (may be
// empty); empty if it was made over `package_text` by a deployer of that plant.
std::string bundle_refusal(const BundleSignature& signature, const std::string& package_text,
                           const std::string& authority, const std::string& revoked);

// Returns why `file` must not be written: it is a file of the package, or no file at all; empty if it may.
std::string output_refusal(const PackedPlant& packed, const std::filesystem::path& file);

// Writes the file under another name first, so `file` is either complete or as it was before. Errors: a file of the
// package cannot be read or has changed since it was packed; the bundle cannot be written.
Result<void, base::Problem> write_bundle(const PackedPlant& packed, const BundleSignature& signature,
                                         const std::filesystem::path& file);

// Returns true if the file begins as a bundle does.
bool is_bundle(const std::filesystem::path& file);

// Returns true for what indurop pack, platform pack and package write, also for what they have not finished.
bool is_packed_plant(const std::filesystem::path& file);

struct OpenedBundle {
  PackedPlant packed;  // its sources are files in `folder`
  BundleSignature signature;
  std::filesystem::path manifest;  // in `folder`
};
// Unpacks a bundle into `folder`, which must be empty, with the paths that the package names. Everything is checked,
// regardless of who made the file: members, order, sizes, digests. Nothing outside of `folder` is written. Errors:
// damaged, incomplete or not a bundle; of another format; the files cannot be written.
Result<OpenedBundle, base::Problem> open_bundle(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace indurop::deploy
