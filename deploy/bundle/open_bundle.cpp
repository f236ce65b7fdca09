// SPDX-License-Identifier: Apache-2.0
// Unpacking: the file may come from anybody.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "core/archives/archive.h"
#include "core/base/clone_file.h"
#include "core/base/json.h"
#include "core/base/new_file.h"
#include "core/base/read_file.h"
#include "core/keys/digest.h"
#include "deploy/bundle/bundle.h"
#include "deploy/bundle/members.h"

namespace indurop::deploy {
namespace {

using base::Json;
using base::Problem;

constexpr std::size_t kMaxTextBytes = std::size_t{64} << 20U;  // of package.json: 10 000 files have long paths
constexpr std::string_view kZstdBegin = "\x28\xB5\x2F\xFD";

// The file that is read, for messages.
class BundleReader : public archives::ArchiveReader {
 public:
  explicit BundleReader(std::filesystem::path file) : file_(std::move(file)) {}
  [[nodiscard]] Problem problem(std::string_view what) const { return {fmt::format("{}: {}", file_.string(), what)}; }
  [[nodiscard]] Problem damaged() const { return problem("the bundle is damaged; copy or pack it again"); }

 private:
  std::filesystem::path file_;
};

// Creates the file of one member at the first of `places`; the others get a copy. Returns false if it cannot be
// written, or if its content is not what the package says.
class Unpacking {
 public:
  Unpacking(BundleReader& bundle, const std::filesystem::path& folder, OpenedBundle& out)
      : bundle_(bundle), folder_(folder), out_(out) {
    for (const PackageFile& file : out.packed.package.files) {
      missing_[file.digest].push_back(&file);
    }
  }

  Result<void, Problem> run() {
    while (bundle_.next()) {
      const std::string name = bundle_.name();
      const auto found = name.starts_with(kFilesFolder)
                             ? missing_.find(name.substr(std::string_view(kFilesFolder).size()))
                             : missing_.end();
      if (found == missing_.end() || !bundle_.is_regular()) {
        return bundle_.damaged();
      }
      if (auto done = unpack(found->second); !done) {
        return done;
      }
      missing_.erase(found);
    }
    if (bundle_.failed()) {
      return bundle_.damaged();
    }
    return missing_.empty() ? Result<void, Problem>()
                            : bundle_.problem(fmt::format("the bundle ends before {}; copy or pack it again",
                                                          missing_.begin()->second.front()->path));
  }

 private:
  Result<void, Problem> unpack(const std::vector<const PackageFile*>& files) {
    const PackageFile& first = *files.front();
    const std::filesystem::path place = folder_ / first.path;
    std::error_code error;
    std::filesystem::create_directories(place.parent_path(), error);
    base::NewFile to(place);
    keys::Digest digest;
    std::uint64_t size = 0;
    const bool read = bundle_.read(first.size, [&](std::string_view bytes) {
      digest.add({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
      size += bytes.size();
      return to.write(bytes);
    });
    if (const auto written = to.close(); !written) {
      return bundle_.problem(base::cannot_write(place, written.error()));
    }
    if (!read || size != first.size || digest.finish() != first.digest) {
      return bundle_.problem(fmt::format("{} is damaged in the bundle; copy or pack it again", first.path));
    }
    out_.packed.sources.emplace(first.digest, place);
    return place_all(files, place);
  }

  Result<void, Problem> place_all(const std::vector<const PackageFile*>& files, const std::filesystem::path& first) {
    using std::filesystem::perms;
    for (const PackageFile* file : files) {
      const std::filesystem::path place = folder_ / file->path;
      std::error_code error;
      if (place != first) {
        std::filesystem::create_directories(place.parent_path(), error);
        if (const auto copied = base::clone_file(first, place); !copied) {
          return bundle_.problem(copied.error().text);
        }
      }
      if (!error) {
        std::filesystem::permissions(
            place, perms::owner_read | perms::owner_write | (file->executable ? perms::owner_exec : perms::none),
            error);
      }
      if (error) {
        return bundle_.problem(fmt::format("cannot write {}: {}", place.string(), error.message()));
      }
    }
    return {};
  }

  BundleReader& bundle_;
  const std::filesystem::path& folder_;
  OpenedBundle& out_;
  std::map<std::string, std::vector<const PackageFile*>> missing_;  // by digest
};

}  // namespace

bool is_bundle(const std::filesystem::path& file) {
  const auto opened = base::open_file(file);
  std::array<char, kZstdBegin.size()> begin{};
  return opened && ::pread(opened->file.get(), begin.data(), begin.size(), 0) == static_cast<ssize_t>(begin.size()) &&
         std::string_view(begin.data(), begin.size()) == kZstdBegin;
}

bool is_packed_plant(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.starts_with("indurop-plant-") && (name.ends_with(".deb") || name.ends_with(".deb.part"))) {
    return true;
  }
  archives::ArchiveReader archive;
  return is_bundle(file) && archive.open(file) && archive.next() && archive.name() == kPackageMember;
}

Result<OpenedBundle, Problem> open_bundle(const std::filesystem::path& file, const std::filesystem::path& folder) {
  BundleReader bundle(file);
  if (!is_bundle(file)) {
    return bundle.problem("it is not a bundle made by indurop pack");
  }
  if (!bundle.open(file)) {
    return bundle.damaged();
  }
  const auto package_text = bundle.text(kPackageMember, kMaxTextBytes);
  const auto about_text = package_text ? bundle.text(kSignatureMember, kMaxTextBytes) : std::nullopt;
  const Json about = about_text ? Json::parse(*about_text).value_or(Json()) : Json();
  std::uint64_t format = 0;
  if (!base::read(about, "indurop_bundle", format)) {
    return bundle.damaged();
  }
  if (format != kBundleFormat) {
    return bundle.problem(fmt::format("the bundle has format {}, this release reads {}; use the release that packed it",
                                      format, kBundleFormat));
  }
  auto package = read_package(*package_text);
  if (!package) {
    return bundle.problem(package.error().text);
  }
  OpenedBundle out;
  out.packed.package = std::move(package).value();
  out.packed.text = *package_text;
  out.packed.id = keys::digest_of(*package_text);
  out.manifest = folder / out.packed.package.manifest;
  std::string id;
  if (!base::read(about, "deployment", id) || id != out.packed.id ||
      !base::read(about, "certificate", out.signature.certificate) ||
      !base::read(about, "signature", out.signature.signature)) {
    return bundle.damaged();
  }
  if (auto unpacked = Unpacking(bundle, folder, out).run(); !unpacked) {
    return std::move(unpacked).error();
  }
  return out;
}

}  // namespace indurop::deploy
