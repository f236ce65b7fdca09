// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/release_bundle.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <utility>

#include "core/base/descriptor.h"
#include "core/base/read_file.h"
#include "core/base/spawn.h"
#include "core/base/text.h"
#include "core/keys/participant_keys.h"
#include "deploy/bundle/bundle.h"

namespace indurop::tools {

std::string version_of_installation(const std::filesystem::path& prefix) {
  const std::filesystem::path program = prefix / "bin/indurop-agent";
  const base::Descriptor output(::memfd_create("indurop-version", MFD_CLOEXEC));
  const auto pid = base::spawn({.words = {program.string(), "--version"}, .program = program, .output = output.get()});
  int status = 0;
  if (!pid || ::waitpid(*pid, &status, 0) != *pid || base::exit_code_of(status) != kOk) {
    return {};
  }
  std::array<char, 100> text{};
  const ssize_t got = ::pread(output.get(), text.data(), text.size(), 0);
  return std::string(base::trimmed({text.data(), got > 0 ? static_cast<std::size_t>(got) : 0}));
}

Result<void, base::Problem> write_release(Context& context, const deploy::PackedPlant& packed, const std::string& keys,
                                          const std::filesystem::path& file) {
  deploy::BundleSignature signature;
  if (keys.empty()) {
    context.out.note("not signed: no keys. Plants with keys do not accept this release; --keys signs it");
  } else {
    auto made = deploy::sign_package(packed.text, keys);
    if (!made) {
      return std::move(made).error();
    }
    signature = std::move(made).value();
  }
  return deploy::write_bundle(packed, signature, file);
}

Result<ReleaseBundle, Failure> read_release(const std::string& file, const std::filesystem::path& keys) {
  if (const auto opened = base::open_file(file); !opened) {
    return Failure{kFailed, base::cannot_read(file, opened.error())};
  }
  ReleaseBundle bundle{{}, std::make_unique<base::TemporaryFolder>()};
  if (bundle.temporary->path().empty()) {
    return Failure{kFailed, bundle.temporary->problem()};
  }
  auto opened = deploy::open_bundle(file, bundle.temporary->path());
  if (!opened) {
    return Failure{kFailed, std::move(opened).error().text};
  }
  if (opened->packed.package.release.empty()) {
    return Failure{kUsage, fmt::format("{} is a plant; indurop deploy takes it", file)};
  }
  if (!keys.empty()) {
    const keys::ParticipantKeys own(keys);
    const auto authority = base::read_file(own.authority);
    const auto revoked = base::read_file(own.revoked);
    const std::string refusal =
        deploy::bundle_refusal(opened->signature, opened->packed.text, authority ? *authority : std::string(),
                               revoked ? *revoked : std::string());
    if (!refusal.empty()) {
      return Failure{kFailed, fmt::format("{}: {}", file, refusal)};
    }
  }
  bundle.packed = std::move(opened->packed);
  return bundle;
}

std::optional<deploy::BlobServer::Blob> blob_of(const deploy::PackedPlant& packed, const std::string& name) {
  if (name == packed.id) {
    return deploy::BlobServer::Blob{{}, packed.text};
  }
  const auto found = packed.sources.find(name);
  return found != packed.sources.end() ? std::optional(deploy::BlobServer::Blob{found->second, {}}) : std::nullopt;
}

}  // namespace indurop::tools
