// SPDX-License-Identifier: Apache-2.0
#include "deploy/transaction/release_package.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/keys/digest.h"

namespace indurop::deploy {
namespace {

namespace fs = std::filesystem;
using base::Problem;

constexpr std::array kNeededPrograms{"indurop", "indurop-agent", "indurop-node"};
constexpr std::array kFurtherPrograms{"indurop-serve", "indurop-iceoryx", "indurop-pools"};
constexpr const char* kAgentProgram = "/bin/indurop-agent";

bool is_library(const std::string& name) {
  return name.starts_with("libindurop.so.") || name.starts_with("libindurop-c.so.") || name == "libiodispat.so";
}

// Files by their path in the package.
using Files = std::map<std::string, fs::path>;

// A problem: this user may not read a part of the installation. A release without it would be another one.
Result<void, Problem> may_read(const fs::path& prefix) {
  std::vector<fs::path> parts{prefix / "lib", prefix / "lib64", prefix / "share/indurop"};
  for (const char* name : kNeededPrograms) {
    parts.push_back(prefix / "bin" / name);
  }
  for (const char* name : kFurtherPrograms) {
    parts.push_back(prefix / "bin" / name);
  }
  for (const fs::path& part : parts) {
    std::error_code ignored;
    if (::access(part.c_str(), fs::is_directory(part, ignored) ? R_OK | X_OK : R_OK) != 0 && errno == EACCES) {
      return Problem{base::cannot_read(part, base::file_problem(EACCES))};
    }
  }
  return {};
}

void add_libraries(const fs::path& prefix, const fs::path& folder, const std::string& architecture, Files& files) {
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    std::error_code ignored;
    if (is_library(at->path().filename().string()) && fs::is_regular_file(at->path(), ignored)) {
      files.emplace(architecture + "/" + at->path().lexically_relative(prefix).string(), at->path());
    }
  }
}

void add_shared(const fs::path& prefix, const std::string& architecture, Files& files) {
  std::error_code error;
  for (fs::recursive_directory_iterator at(prefix / "share/indurop", error), end; !error && at != end;
       at.increment(error)) {
    std::error_code ignored;
    if (fs::is_regular_file(at->path(), ignored)) {
      files.emplace(architecture + "/" + at->path().lexically_relative(prefix).string(), at->path());
    }
  }
}

Result<void, Problem> add_installation(const fs::path& prefix, Files& files) {
  if (auto able = may_read(prefix); !able) {
    return able;
  }
  const std::string architecture = architecture_of(prefix / "bin/indurop-agent");
  std::error_code error;
  for (const char* name : kNeededPrograms) {
    const fs::path program = prefix / "bin" / name;
    if (architecture.empty() || architecture_of(program) != architecture) {
      return Problem{fmt::format(
          "{} is no installation of the platform: bin/{} is missing, or of another architecture than amd64 and arm64",
          prefix.string(), name)};
    }
    if (!files.emplace(architecture + "/bin/" + name, program).second) {
      return Problem{fmt::format("{} is the second installation for {}; name one for each architecture",
                                 prefix.string(), architecture)};
    }
  }
  for (const char* name : kFurtherPrograms) {
    if (architecture_of(prefix / "bin" / name) == architecture) {
      files.emplace(architecture + "/bin/" + name, prefix / "bin" / name);
    }
  }
  const std::size_t programs = files.size();
  for (const char* library : {"lib", "lib64"}) {
    add_libraries(prefix, prefix / library, architecture, files);
    for (fs::directory_iterator at(prefix / library, error), end; !error && at != end; at.increment(error)) {
      if (at->is_directory(error)) {
        add_libraries(prefix, at->path(), architecture, files);
      }
    }
    error.clear();
  }
  if (files.size() == programs) {
    return Problem{fmt::format("{} is no installation of the platform: lib/ has no libindurop.so", prefix.string())};
  }
  add_shared(prefix, architecture, files);
  return {};
}

}  // namespace

std::string architecture_of(const fs::path& program) {
  constexpr std::size_t kMachineAt = 18;  // e_machine, little endian
  constexpr unsigned kAmd64 = 62;
  constexpr unsigned kArm64 = 183;
  const auto opened = base::open_file(program);
  std::array<std::uint8_t, kMachineAt + 2> begin{};
  if (!opened || !is_program(program) ||
      ::pread(opened->file.get(), begin.data(), begin.size(), 0) != static_cast<ssize_t>(begin.size())) {
    return {};
  }
  const unsigned machine = begin[kMachineAt] | static_cast<unsigned>(begin[kMachineAt + 1]) << 8U;
  return machine == kAmd64 ? "amd64" : machine == kArm64 ? "arm64" : "";
}

std::string own_architecture() {
  return architecture_of("/proc/self/exe");
}

Result<PackedPlant, Problem> pack_release(const std::vector<fs::path>& prefixes, const std::string& version,
                                          const std::string& comment) {
  Files files;
  for (const fs::path& prefix : prefixes) {
    if (auto added = add_installation(fs::absolute(prefix).lexically_normal(), files); !added) {
      return std::move(added).error();
    }
  }
  PackedPlant packed;
  packed.package.release = version;
  packed.package.comment = comment;
  for (const auto& [path, file] : files) {
    auto digest = keys::digest_of_file(file);
    if (!digest) {
      return Problem{base::cannot_read(file, digest.error())};
    }
    packed.package.files.push_back({path, digest->digest, digest->size, ::access(file.c_str(), X_OK) == 0});
    packed.sources.emplace(digest->digest, file);
  }
  packed.text = to_text(packed.package);
  packed.id = keys::digest_of(packed.text);
  if (auto valid = read_package(packed.text); !valid) {
    return std::move(valid).error();
  }
  return packed;
}

std::vector<std::string> architectures_of(const Package& release) {
  std::vector<std::string> names;
  for (const PackageFile& file : release.files) {
    if (file.path.ends_with(kAgentProgram)) {
      names.push_back(file.path.substr(0, file.path.size() - std::string_view(kAgentProgram).size()));
    }
  }
  return names;
}

}  // namespace indurop::deploy
