// SPDX-License-Identifier: Apache-2.0
// Names of the members of a bundle.

#pragma once

#include <string>

namespace indurop::deploy {

inline constexpr int kBundleFormat = 1;
inline constexpr const char* kPackageMember = "package.json";
inline constexpr const char* kSignatureMember = "signature.json";
inline constexpr const char* kFilesFolder = "files/";

inline std::string file_member(const std::string& digest) {
  return kFilesFolder + digest;
}

}  // namespace indurop::deploy
