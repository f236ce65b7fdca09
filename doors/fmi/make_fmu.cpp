// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/make_fmu.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <chrono>
#include <optional>
#include <utility>

#include "core/archives/archive.h"
#include "core/base/program_folder.h"
#include "core/base/read_file.h"
#include "core/keys/digest.h"
#include "deploy/transaction/package.h"
#include "doors/fmi/contents/contents.h"
#include "doors/fmi/description/description.h"

namespace indurop::fmi {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr const char* kLibrary = "libindurop-fmi.so";
constexpr std::size_t kMostBytes = std::size_t{1} << 30U;  // of one file

// Names of the folder for the library, as the standards define them; FMI 2 knows x86 only.
#if defined(__x86_64__)
constexpr const char* kFolder2 = "linux64";
constexpr const char* kFolder3 = "x86_64-linux";
#else
constexpr const char* kFolder2 = "aarch64-linux";
constexpr const char* kFolder3 = "aarch64-linux";
#endif

Result<fs::path, Problem> find_library() {
  const fs::path programs = base::program_folder();
  std::error_code error;
  for (const fs::path& place :
       {programs / ".." / INDUROP_LIBRARIES / "indurop" / kLibrary, programs / ".." / "lib" / kLibrary}) {
    if (fs::is_regular_file(place, error)) {
      return place.lexically_normal();
    }
  }
  return Problem{fmt::format("{} is not where {} expects it: install the package indurop-fmu again", kLibrary,
                             (programs / "indurop-fmu").string())};
}

Contents contents_of(const Configuration& configuration, const Choice& choice, const deploy::Package& package) {
  Contents contents;
  contents.configuration = package.manifest;
  contents.plant = configuration.is_plant;
  const fs::path programs = base::program_folder();
  contents.programs = ::access((programs / "indurop-node").c_str(), X_OK) == 0 ? programs.string() : std::string();
  for (const deploy::PackageFile& file : package.files) {
    if (file.executable) {
      contents.executables.push_back(file.path);
    }
  }
  for (const ChosenVariable& one : choice.variables) {
    contents.variables.push_back({one.part.name, one.shared->boards, one.input});
  }
  return contents;
}

std::string description_of(const Description& description, Version version) {
  return version == Version::Fmi2 ? fmi2_description(description) : fmi3_description(description);
}

// Returns a digest in the form of a UUID, as most tools write it.
std::string token_of(const std::string& text) {
  const std::string digest = keys::digest_of(text);
  return fmt::format("{{{}-{}-{}-{}-{}}}", digest.substr(0, 8), digest.substr(8, 4), digest.substr(12, 4),
                     digest.substr(16, 4), digest.substr(20, 12));
}

Result<void, Problem> add_file(archives::ArchiveWriter& archive, const std::string& member, const fs::path& source,
                               bool executable) {
  const auto bytes = base::read_file(source, kMostBytes);
  if (!bytes) {
    return Problem{base::cannot_read(source, bytes.error())};
  }
  return archive.text(member, *bytes, executable) ? Result<void, Problem>() : Problem{archive.message()};
}

struct Members {
  std::string description;
  std::string contents;
  fs::path library;
  std::string library_member;
};

Result<void, Problem> write_members(archives::ArchiveWriter& archive, const Members& members,
                                    const deploy::PackedPlant& packed) {
  if (!archive.text("modelDescription.xml", members.description) ||
      !archive.text(fmt::format("resources/{}", kContentsName), members.contents)) {
    return Problem{archive.message()};
  }
  if (auto added = add_file(archive, members.library_member, members.library, true); !added) {
    return added;
  }
  for (const deploy::PackageFile& file : packed.package.files) {
    const std::string member = fmt::format("resources/{}/{}", kConfigurationFolder, file.path);
    if (auto added = add_file(archive, member, packed.sources.at(file.digest), file.executable); !added) {
      return added;
    }
  }
  return archive.close() ? Result<void, Problem>() : Problem{archive.message()};
}

Result<void, Problem> write_archive(const Members& members, const deploy::PackedPlant& packed, const fs::path& output) {
  const fs::path unfinished = output.string() + ".part";
  archives::ArchiveWriter archive;
  auto result = archive.open(unfinished, archives::ArchiveForm::Zip)
                    ? write_members(archive, members, packed)
                    : Result<void, Problem>(Problem{archive.message()});
  std::error_code error;
  if (result) {
    fs::rename(unfinished, output, error);
    result = error ? Result<void, Problem>(Problem{error.message()}) : std::move(result);
  }
  if (!result) {
    fs::remove(unfinished, error);
    return Problem{fmt::format("cannot write {}: {}", output.string(), result.error().text)};
  }
  return result;
}

}  // namespace

std::string identifier_of(const fs::path& output) {
  std::string name = output.stem().string();
  for (char& c : name) {
    c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 ? "_" + name : name;
}

Result<void, Problem> make_fmu(const Configuration& configuration, const Choice& choice, const FmuRequest& request) {
  const auto library = find_library();
  if (!library) {
    return library.error();
  }
  const auto packed = deploy::pack_plant(configuration.plant, request.also);
  if (!packed) {
    return packed.error();
  }
  const bool is_fmi2 = request.version == Version::Fmi2;
  Contents contents = contents_of(configuration, choice, packed->package);
  Description description{configuration.plant.name,
                          identifier_of(request.output),
                          {},
                          request.tool,
                          std::chrono::duration<double>(configuration.basic_period).count(),
                          choice.variables};
  contents.token = token_of(packed->text + to_text(contents) + description_of(description, request.version));
  description.token = contents.token;
  const Members members{description_of(description, request.version), to_text(contents), *library,
                        fmt::format("binaries/{}/{}.so", is_fmi2 ? kFolder2 : kFolder3, description.identifier)};
  return write_archive(members, *packed, request.output);
}

}  // namespace indurop::fmi
