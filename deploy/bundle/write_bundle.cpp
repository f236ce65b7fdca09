// SPDX-License-Identifier: Apache-2.0
// Packing: libarchive writes the archive, with the same bytes for the same content.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "core/archives/archive.h"
#include "core/base/file_problem.h"
#include "core/base/json.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/keys/digest.h"
#include "deploy/bundle/bundle.h"
#include "deploy/bundle/members.h"

namespace indurop::deploy {
namespace {

using base::Problem;

constexpr std::size_t kPortion = std::size_t{1} << 18U;

// Copies a file of the package into the bundle. The problem is empty if the bundle could not be written.
Result<void, Problem> add_file(archives::ArchiveWriter& bundle, const PackageFile& file,
                               const std::filesystem::path& source) {
  const Problem changed{fmt::format("{} has changed while it was packed; pack again", source.string())};
  const auto opened = base::open_file(source);
  if (!opened) {
    return Problem{base::cannot_read(source, opened.error())};
  }
  if (!bundle.begin(file_member(file.digest), file.size)) {
    return Problem{};
  }
  keys::Digest digest;
  std::array<char, kPortion> portion{};
  std::uint64_t rest = file.size;
  while (rest > 0) {
    const ssize_t got = ::read(opened->file.get(), portion.data(), std::min<std::uint64_t>(rest, portion.size()));
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      return changed;
    }
    const std::string_view bytes(portion.data(), static_cast<std::size_t>(got));
    digest.add({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    if (!bundle.add(bytes)) {
      return Problem{};
    }
    rest -= bytes.size();
  }
  return digest.finish() == file.digest ? Result<void, Problem>() : changed;
}

Result<void, Problem> write_members(archives::ArchiveWriter& bundle, const PackedPlant& packed,
                                    const BundleSignature& signature) {
  const base::Json about{{"indurop_bundle", kBundleFormat},
                         {"deployment", packed.id},
                         {"certificate", signature.certificate},
                         {"signature", signature.signature}};
  if (!bundle.text(kPackageMember, packed.text) || !bundle.text(kSignatureMember, about.dump())) {
    return Problem{};
  }
  std::set<std::string> written;
  for (const PackageFile& file : packed.package.files) {
    if (!written.insert(file.digest).second) {
      continue;
    }
    if (auto added = add_file(bundle, file, packed.sources.at(file.digest)); !added) {
      return added;
    }
  }
  return bundle.close() ? Result<void, Problem>() : Problem{};
}

}  // namespace

std::string output_refusal(const PackedPlant& packed, const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return {};
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    return fmt::format("cannot write {}: it is not a regular file", file.string());
  }
  const bool ours = std::any_of(packed.sources.begin(), packed.sources.end(), [&](const auto& source) {
    return std::filesystem::equivalent(source.second, file, error);
  });
  return ours ? fmt::format("{} is a file of the plant and would be lost; name another file with -o", file.string())
              : std::string();
}

Result<void, Problem> write_bundle(const PackedPlant& packed, const BundleSignature& signature,
                                   const std::filesystem::path& file) {
  if (std::string refusal = output_refusal(packed, file); !refusal.empty()) {
    return Problem{std::move(refusal)};
  }
  const std::filesystem::path unfinished = file.string() + ".part";
  archives::ArchiveWriter bundle;
  Result<void, Problem> result = Problem{};
  if (bundle.open(unfinished)) {
    result = write_members(bundle, packed, signature);
  }
  if (!result && result.error().text.empty()) {
    result = Problem{fmt::format("cannot write {}: {}", file.string(), bundle.message())};
  }
  std::error_code error;
  if (result) {
    if (const auto synced = base::sync_to_disk(unfinished); !synced) {
      result = Problem{base::cannot_write(file, synced.error())};
    }
  }
  if (result) {
    std::filesystem::rename(unfinished, file, error);
    if (error) {
      result = Problem{fmt::format("cannot write {}: {}", file.string(), error.message())};
    }
  }
  if (!result) {
    std::filesystem::remove(unfinished, error);
  }
  return result;
}

}  // namespace indurop::deploy
