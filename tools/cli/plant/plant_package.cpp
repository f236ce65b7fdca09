// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/plant_package.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/descriptor.h"
#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "tools/client/process/child.h"

namespace indurop::tools {
namespace {

using base::Problem;
using Path = std::filesystem::path;

// Of all files of a package and of its changelog: a package does not tell when it was made.
constexpr const char* kPackageEpoch = "SOURCE_DATE_EPOCH=946684800";
constexpr const char* kPackageDate = "Sat, 01 Jan 2000 00:00:00 +0000";

// Returns the text as lines of a description.
std::string description_of(const std::string& text) {
  constexpr std::size_t kWidth = 76;
  std::istringstream words(text);
  std::string lines;
  std::size_t width = kWidth;
  for (std::string word; words >> word; width += word.size() + 1) {
    if (width + word.size() > kWidth) {
      lines += lines.empty() ? " " : "\n ";
      width = 0;
    }
    lines += " " + word;
  }
  return lines;
}

std::string control_of(const PlantPackage& package) {
  const std::string comment =
      package.comment.empty() ? std::string() : fmt::format(" .\n{}\n", description_of("Comment: " + package.comment));
  return fmt::format(
      "Package: {}\nVersion: {}\nArchitecture: all\nMaintainer: {}\nDepends: indurop (>= {})\nSection: science\n"
      "Priority: optional\nDescription: plant {} for boards with InduRoP\n"
      " Manifest, modules and data of deployment {}.\n{}"
      " .\n Installing it changes nothing on the boards. This command deploys it:\n .\n"
      "  indurop deploy\n  /{}\n",
      package_name(package.plant), package.version, package.maintainer, INDUROP_VERSION, package.plant,
      package.deployment.substr(0, 12), comment, installed_bundle(package.plant).string());
}

std::string changelog_of(const PlantPackage& package) {
  return fmt::format("{} ({}) stable; urgency=medium\n\n  * Deployment\n    {}.\n\n -- {}  {}\n",
                     package_name(package.plant), package.version, package.deployment, package.maintainer,
                     kPackageDate);
}

std::string copyright_of(const PlantPackage& package) {
  return fmt::format(
      "The files of the plant {} belong to their authors; this package says nothing about their copyright.\n",
      package.plant);
}

Result<void, Problem> write_text(const Path& file, const std::string& text) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (const auto written = base::replace_file(file, text, base::Durable::No); !written) {
    return Problem{base::cannot_write(file, written.error())};
  }
  return {};
}

// Runs a program whose output goes to the file `output`.
Result<void, Problem> run_tool(const std::vector<std::string>& words, const Path& output) {
  const base::Descriptor to(::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (to.get() < 0) {
    return Problem{fmt::format("cannot write {}", output.string())};
  }
  const auto code = run_child(words, to.get());
  if (!code) {
    return code.error();
  }
  if (*code == 0) {
    return {};
  }
  const auto printed = base::read_file(output);
  return Problem{fmt::format("{} failed ({}): {}", fmt::join(words, " "), *code, printed ? *printed : std::string())};
}

// Folders 0755 and files 0644, whatever the umask is.
void set_modes(const Path& tree) {
  using std::filesystem::perms;
  constexpr perms kFile = perms::owner_read | perms::owner_write | perms::group_read | perms::others_read;
  constexpr perms kFolder = kFile | perms::owner_exec | perms::group_exec | perms::others_exec;
  std::error_code error;
  std::filesystem::permissions(tree, kFolder, error);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tree, error)) {
    std::filesystem::permissions(entry.path(), entry.is_directory() ? kFolder : kFile, error);
  }
}

Result<void, Problem> add_files(const PlantPackage& package, const Path& tree) {
  const Path documents = Path("usr/share/doc") / package_name(package.plant);
  const Path control = tree / "DEBIAN";
  const Path changelog = tree / documents / "changelog";
  const Path sums = control / "md5sums";
  const std::array<std::pair<Path, std::string>, 3> texts{{{control / "control", control_of(package)},
                                                           {tree / documents / "copyright", copyright_of(package)},
                                                           {changelog, changelog_of(package)}}};
  for (const auto& [file, text] : texts) {
    if (auto written = write_text(file, text); !written) {
      return written;
    }
  }
  if (auto zipped = run_tool({"gzip", "-9n", changelog.string()}, control / "gzip.log"); !zipped) {
    return zipped;
  }
  std::error_code error;
  std::filesystem::remove(control / "gzip.log", error);
  return run_tool({"env", "-C", tree.string(), "md5sum", (documents / "changelog.gz").string(),
                   (documents / "copyright").string(), installed_bundle(package.plant).string()},
                  sums);
}

}  // namespace

std::string package_name(const std::string& plant) {
  std::string name = "indurop-plant-";
  for (const char c : plant) {
    if (c >= 'A' && c <= 'Z') {
      name += fmt::format("+{}", static_cast<char>(c - 'A' + 'a'));
    } else {
      name += c == '_' ? '.' : c;
    }
  }
  return name;
}

std::string version_problem(const std::string& version) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '+' || c == '~'; };
  return !version.empty() && std::isdigit(static_cast<unsigned char>(version[0])) != 0 &&
                 std::all_of(version.begin(), version.end(), allowed)
             ? std::string()
             : "a version begins with a digit and has letters, digits, '.', '+' and '~', for example 1.2";
}

std::string maintainer_problem(const std::string& maintainer) {
  const std::size_t open = maintainer.find(" <");
  const std::size_t at = maintainer.find('@', open == std::string::npos ? 0 : open);
  const bool plain = std::none_of(maintainer.begin(), maintainer.end(), [](unsigned char c) { return c < ' '; });
  return plain && open != 0 && open != std::string::npos && at != std::string::npos && maintainer.back() == '>'
             ? std::string()
             : "write NAME <ADDRESS>, for example 'Cell Team <cell@factory.example>'";
}

Path installed_bundle(const std::string& plant) {
  return "usr/share/indurop/plants/" + plant + ".bundle";
}

Result<void, Problem> write_plant_package(const PlantPackage& package, const Path& tree, const Path& file) {
  if (auto added = add_files(package, tree); !added) {
    return added;
  }
  set_modes(tree);
  const Path unfinished = file.string() + ".part";
  const std::vector<std::string> words{"env",  kPackageEpoch, "dpkg-deb",    "--root-owner-group", "--threads-max=1",
                                       "-Zxz", "-b",          tree.string(), unfinished.string()};
  auto result = run_tool(words, tree.string() + ".log");
  std::error_code error;
  if (result) {
    std::filesystem::rename(unfinished, file, error);
    if (error) {
      result = Problem{fmt::format("cannot write {}: {}", file.string(), error.message())};
    }
  }
  std::filesystem::remove(unfinished, error);
  return result;
}

}  // namespace indurop::tools
