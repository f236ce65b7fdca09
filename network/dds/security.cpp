// SPDX-License-Identifier: Apache-2.0
#include "network/dds/security.h"

#include <fmt/format.h>
#include <link.h>

#include <array>
#include <string_view>
#include <vector>

#include "core/base/read_file.h"
#include "core/base/xml_text.h"

namespace indurop::dds {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "libddsc.so";
constexpr std::array<const char*, 3> kPlugins = {"libdds_security_auth.so", "libdds_security_ac.so",
                                                 "libdds_security_crypto.so"};

int note_library(dl_phdr_info* info, std::size_t /*size*/, void* into) {
  if (std::string_view(info->dlpi_name).find(kLibrary) == std::string_view::npos) {
    return 0;
  }
  *static_cast<std::string*>(into) = info->dlpi_name;
  return 1;
}

bool has_plugins(const fs::path& folder) {
  std::error_code ignored;
  for (const char* plugin : kPlugins) {
    if (!fs::exists(folder / plugin, ignored)) {
      return false;
    }
  }
  return true;
}

std::string library(const char* file, const char* name, const fs::path& plugins) {
  return fmt::format(R"(<Library path="{}" initFunction="init_{}" finalizeFunction="finalize_{}"/>)",
                     base::xml_text((plugins / file).string()), name, name);
}

std::string file(const char* element, const std::string& path) {
  return path.empty() ? std::string{} : fmt::format("<{0}>file:{1}</{0}>", element, base::xml_text(path));
}

}  // namespace

fs::path security_plugins() {
  std::string loaded;
  ::dl_iterate_phdr(&note_library, &loaded);
  std::error_code ignored;
  const fs::path folder = fs::path(loaded).parent_path();
  // Debian has a plugin folder named after the library's version, Cyclone's own installation has none.
  std::vector<fs::path> places{folder};
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with("libddsc") && entry.is_directory(ignored)) {
      places.push_back(entry.path());
    }
  }
  for (const fs::path& place : places) {
    if (has_plugins(place)) {
      return place;
    }
  }
  return {};
}

std::string security_configuration(const Security& security, const fs::path& plugins) {
  if (!security.on()) {
    return {};
  }
  return "<Security><Authentication>" + library(kPlugins[0], "authentication", plugins) +
         file("IdentityCA", security.authority) + file("IdentityCertificate", security.certificate) +
         file("PrivateKey", security.key) + file("CRL", security.revoked) + "</Authentication><AccessControl>" +
         library(kPlugins[1], "access_control", plugins) + file("PermissionsCA", security.authority) +
         file("Governance", security.governance) + file("Permissions", security.permissions) +
         "</AccessControl><Cryptographic>" + library(kPlugins[2], "crypto", plugins) + "</Cryptographic></Security>";
}

Result<void, base::Problem> security_usable(const Security& security, const fs::path& plugins) {
  if (!security.on()) {
    return {};
  }
  if (plugins.empty()) {
    return base::Problem{
        fmt::format("the plant is secured, but {} and the other two plugins of DDS Security are not next to {}; "
                    "install the package libddsc0debian",
                    kPlugins[0], kLibrary)};
  }
  for (const std::string* name : {&security.authority, &security.certificate, &security.key, &security.governance,
                                  &security.permissions, &security.revoked}) {
    if (name->empty()) {
      continue;
    }
    if (const auto opened = base::open_file(*name); !opened) {
      return base::Problem{fmt::format("the plant is secured, but {} cannot be read: {}", *name, opened.error().text)};
    }
  }
  return {};
}

}  // namespace indurop::dds
