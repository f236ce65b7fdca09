// SPDX-License-Identifier: Apache-2.0
#include "control/io/fmu/fmu_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "core/archives/archive.h"
#include "core/base/printable.h"
#include "core/base/text.h"

namespace indurop::io::fmu {

namespace {

namespace fs = std::filesystem;
using archives::ArchiveForm;
using archives::ArchiveReader;

constexpr const char* kDescription = "modelDescription.xml";
constexpr std::uint64_t kMaxDescription = std::uint64_t{64} << 20U;
constexpr std::uint64_t kMaxUnpacked = std::uint64_t{4} << 30U;
constexpr std::size_t kMaxMembers = 100'000;

#if defined(__x86_64__)
constexpr const char* kFolder2 = "linux64";
constexpr const char* kFolder3 = "x86_64-linux";
#elif defined(__aarch64__)
constexpr const char* kFolder2 = "aarch64-linux";  // FMI 2 has no name for it; tools use that of FMI 3
constexpr const char* kFolder3 = "aarch64-linux";
#else
constexpr const char* kFolder2 = "riscv64-linux";
constexpr const char* kFolder3 = "riscv64-linux";
#endif

const char* folder_of(Version version) {
  return version == Version::Fmi2 ? kFolder2 : kFolder3;
}

// "binaries/linux64/press.so": linux64.
void note_platform(FmuFile& fmu, const std::string& member) {
  constexpr std::string_view kBinaries = "binaries/";
  const std::size_t end = member.find('/', kBinaries.size());
  if (!member.starts_with(kBinaries) || end == std::string::npos || end + 1 == member.size()) {
    return;
  }
  std::string platform = member.substr(kBinaries.size(), end - kBinaries.size());
  if (std::find(fmu.platforms.begin(), fmu.platforms.end(), platform) == fmu.platforms.end()) {
    fmu.platforms.push_back(std::move(platform));
  }
}

// Every part of the name is that of a file in its folder.
bool stays_inside(const std::string& member) {
  const fs::path path(member);
  return !member.empty() && member.find('\\') == std::string::npos && member.find('\0') == std::string::npos &&
         path.is_relative() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

std::string shown(const std::string& member) {
  constexpr std::size_t kShown = 80;
  return base::in_quotes(base::shortened(base::printable(member), kShown));
}

// Writes one member; returns what is wrong.
std::string unpack_member(ArchiveReader& archive, const fs::path& to, std::uint64_t& left) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (fs::exists(fs::symlink_status(to, error))) {
    return "is there twice";
  }
  std::ofstream out(to, std::ios::binary);
  const bool whole = archive.read(left, [&](std::string_view bytes) {
    left -= bytes.size();
    return static_cast<bool>(out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())));
  });
  out.close();
  if (!out) {
    return fmt::format("cannot be written to {}", to.parent_path().string());
  }
  if (!whole) {
    return fmt::format("is damaged, or all of it is larger than {} GB", kMaxUnpacked >> 30U);
  }
  const auto owner = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(to, archive.is_executable() ? owner | fs::perms::owner_exec : owner, error);
  return {};
}

}  // namespace

FmuFile read_fmu(const fs::path& file) {
  FmuFile fmu;
  const auto failed = [&](std::string text) {
    fmu.diagnostics.push_back({base::Diagnostic::Severity::Error, file.string(), {}, std::move(text)});
    return std::move(fmu);
  };
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return failed("no such file; name the FMU");
  }
  ArchiveReader archive;
  if (!archive.open(file, ArchiveForm::Zip)) {
    return failed("is no ZIP archive, as an FMU is");
  }
  std::optional<std::string> xml;
  for (std::size_t members = 0; archive.next(); ++members) {
    const std::string member = archive.name();
    if (members >= kMaxMembers) {
      return failed(fmt::format("has more than {} members; an FMU has fewer", kMaxMembers));
    }
    note_platform(fmu, member);
    fmu.has_sources = fmu.has_sources || member.starts_with("sources/");
    if (member == kDescription && !xml) {
      std::string& text = xml.emplace();
      if (!archive.read(kMaxDescription, [&text](std::string_view bytes) {
            text += bytes;
            return true;
          })) {
        return failed(fmt::format("{} is damaged, or larger than {} MB", kDescription, kMaxDescription >> 20U));
      }
    }
  }
  if (!xml) {
    return failed(archive.failed() ? "is no ZIP archive, as an FMU is, or damaged"
                                   : "has no modelDescription.xml: this is no FMU");
  }
  ReadDescription read = read_description(*xml, (file / kDescription).string());
  fmu.description = std::move(read.description);
  fmu.diagnostics = std::move(read.diagnostics);
  return fmu;
}

std::string library_member(const Description& description) {
  return fmt::format("binaries/{}/{}.so", folder_of(description.version), description.identifier);
}

std::string missing_library(const FmuFile& file) {
  const char* const wanted = folder_of(file.description.version);
  if (std::find(file.platforms.begin(), file.platforms.end(), wanted) != file.platforms.end()) {
    return {};
  }
  return fmt::format("it has no library for this machine (binaries/{}); it has {}. Export it for Linux{}", wanted,
                     file.platforms.empty() ? "none" : base::enumerate(file.platforms),
                     file.has_sources ? ", or compile its sources" : "");
}

Result<void, std::string> unpack_fmu(const fs::path& file, const fs::path& folder) {
  ArchiveReader archive;
  if (!archive.open(file, ArchiveForm::Zip)) {
    return fmt::format("{} is no ZIP archive, as an FMU is", file.string());
  }
  std::uint64_t left = kMaxUnpacked;
  for (std::size_t members = 0; archive.next(); ++members) {
    const std::string member = archive.name();
    if (!stays_inside(member) || members >= kMaxMembers) {
      return fmt::format("{}: its member {} would be written outside of its folder, or there are too many of them",
                         file.string(), shown(member));
    }
    if (member.ends_with('/')) {
      continue;  // a folder
    }
    std::string wrong =
        archive.is_regular() ? unpack_member(archive, folder / member, left) : "is neither a file nor a folder";
    if (!wrong.empty()) {
      return fmt::format("{}: its member {} {}", file.string(), shown(member), wrong);
    }
  }
  if (archive.failed()) {
    return fmt::format("{} is a damaged ZIP archive", file.string());
  }
  return {};
}

}  // namespace indurop::io::fmu
