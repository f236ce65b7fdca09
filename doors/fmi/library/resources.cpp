// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/resources.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <string_view>
#include <utility>

#include "core/base/read_file.h"

namespace indurop::fmi {
namespace {

namespace fs = std::filesystem;

// Returns resources/ of the FMU that this library is a part of: it is in binaries/PLATFORM/.
fs::path own_resources() {
  Dl_info info{};
  std::error_code error;
  if (::dladdr(reinterpret_cast<const void*>(&own_resources), &info) == 0 || info.dli_fname == nullptr) {
    return {};
  }
  return fs::absolute(info.dli_fname, error).parent_path().parent_path().parent_path() / "resources";
}

Result<void, base::Problem> make_executable(const fs::path& file) {
  std::error_code error;
  if (::access(file.c_str(), X_OK) != 0) {
    fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add, error);
  }
  if (::access(file.c_str(), X_OK) != 0) {
    return base::Problem{fmt::format(
        "{} cannot be made executable: unpack the FMU as this user, on a disk that allows programs", file.string())};
  }
  return {};
}

}  // namespace

fs::path path_of_uri(const std::string& uri) {
  constexpr std::string_view kScheme = "file:";
  std::string_view rest = uri;
  if (!rest.starts_with(kScheme)) {
    return rest.find("://") == std::string_view::npos ? fs::path(rest) : fs::path();
  }
  rest.remove_prefix(kScheme.size());
  if (rest.starts_with("//")) {  // the host, which may be empty
    const std::string_view host = rest.substr(2, rest.find('/', 2) - 2);
    if (!host.empty() && host != "localhost") {
      return {};
    }
    rest.remove_prefix(2 + host.size());
  }
  constexpr std::size_t kDigits = 2;
  constexpr int kHexadecimal = 16;
  std::string path;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    unsigned int code = 0;
    const char* const digits = rest.data() + i + 1;
    if (rest[i] == '%' && i + kDigits < rest.size() &&
        std::from_chars(digits, digits + kDigits, code, kHexadecimal).ptr == digits + kDigits && code != 0) {
      path += static_cast<char>(code);
      i += kDigits;
    } else {
      path += rest[i];
    }
  }
  return path;
}

Result<Resources, base::Problem> open_resources(const fs::path& named) {
  Resources resources{named, {}};
  std::error_code error;
  if (named.empty() || !fs::is_regular_file(named / kContentsName, error)) {
    resources.folder = own_resources();
  }
  const fs::path file = resources.folder / kContentsName;
  const auto text = base::read_file(file);
  if (!text) {
    return base::Problem{fmt::format("{}; the resources of an unpacked FMU are needed, and '{}' has none",
                                     base::cannot_read(file, text.error()), named.string())};
  }
  auto contents = read_contents(*text);
  if (!contents) {
    return std::move(contents).error();
  }
  resources.contents = std::move(*contents);
  for (const std::string& program : resources.contents.executables) {
    if (auto made = make_executable(resources.folder / kConfigurationFolder / program); !made) {
      return std::move(made).error();
    }
  }
  return resources;
}

}  // namespace indurop::fmi
