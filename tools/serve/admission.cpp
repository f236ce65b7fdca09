// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/admission.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "tools/client/process/random_word.h"

namespace indurop::serve {
namespace {

constexpr std::size_t kShortestToken = 20;
constexpr std::size_t kLongestToken = 200;
constexpr std::string_view kReadOnly = "read";  // what earlier releases call the role `look`

bool sound(std::string_view token) {
  const auto allowed = [](unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_';
  };
  return token.size() >= kShortestToken && token.size() <= kLongestToken &&
         std::all_of(token.begin(), token.end(), allowed);
}

// Removes the first word and the blanks after it from `text`; returns the word.
std::string_view next_word(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  text = base::trimmed(text.substr(word.size()));
  return word;
}

// Returns the role that a line of a token file names; nothing if there is no such role.
std::optional<Role> role_of(std::string_view word) {
  for (const Role role : {Role::Look, Role::Operate, Role::Tune, Role::Program, Role::Administer}) {
    if (word == word_of(role)) {
      return role;
    }
  }
  return word.empty() ? std::optional(Role::Program) : word == kReadOnly ? std::optional(Role::Look) : std::nullopt;
}

// Returns addresses and name of this machine.
std::vector<std::string> own_names() {
  std::vector<std::string> names;
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) == 0) {
    std::string name = host.data();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    names.push_back(std::move(name));
  }
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) {
    return names;
  }
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* address = nullptr;
    const int family = one->ifa_addr != nullptr ? one->ifa_addr->sa_family : AF_UNSPEC;
    if (family == AF_INET) {
      address = &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr;
    } else if (family == AF_INET6) {
      address = &reinterpret_cast<const sockaddr_in6*>(one->ifa_addr)->sin6_addr;
    }
    if (address != nullptr && inet_ntop(family, address, text.data(), text.size()) != nullptr) {
      names.emplace_back(text.data());
    }
  }
  freeifaddrs(all);
  return names;
}

Result<std::vector<Token>, base::Problem> tokens_of(const std::filesystem::path& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0 && errno == ENOENT) {
    const auto made = base::create_file(file, fmt::format("operator {}\n", tools::random_word()), S_IRUSR | S_IWUSR);
    if (!made) {
      return base::Problem{base::cannot_write(file.string(), made.error())};
    }
  } else if ((info.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return base::Problem{
        fmt::format("{} can be read by others than its owner; chmod 600 '{}'", file.string(), file.string())};
  }
  const auto text = base::read_file(file);
  if (!text) {
    return base::Problem{base::cannot_read(file.string(), text.error())};
  }
  auto tokens = parse_tokens(*text);
  if (!tokens) {
    return base::Problem{fmt::format("{}:{}", file.string(), tokens.error().text)};
  }
  return tokens;
}

tools::Failure usage(std::string text) {
  return {kUsage, std::move(text)};
}

}  // namespace

bool is_loopback(std::string_view address) noexcept {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

Result<std::vector<Token>, base::Problem> parse_tokens(std::string_view text) {
  std::vector<Token> tokens;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const auto end = text.find('\n');
    const std::string_view words = base::trimmed(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (words.empty() || words.starts_with('#')) {
      continue;
    }
    std::string_view rest = words;
    const std::string_view name = next_word(rest);
    const std::string_view token = next_word(rest);
    const auto role = role_of(rest);
    if (!sound(token) || !role) {
      return base::Problem{
          fmt::format("{}: error: a line is a name, a token of {} to {} letters, digits, '-' or '_', and a role: look, "
                      "operate, tune, program (if it names none) or administer",
                      line, kShortestToken, kLongestToken)};
    }
    tokens.push_back({std::string(name), std::string(token), *role});
  }
  if (tokens.empty()) {
    return base::Problem{"1: error: there is no token"};
  }
  return tokens;
}

Result<Admission, tools::Failure> admission_of(const tools::ServeOptions& options) {
  Admission admission;
  AccessGateSettings& gate = admission.gate;
  gate.loopback = is_loopback(options.bind);
  gate.tls = !options.cert.empty();
  gate.write = options.write;
  if (options.cert.empty() != options.key.empty()) {
    return usage("--cert and --key belong together");
  }
  if (!options.client_ca.empty() && !gate.tls) {
    return usage("--client-ca needs --cert and --key");
  }
  if (!options.revoked.empty() && options.client_ca.empty()) {
    return usage("--revoked is about certificates of --client-ca");
  }
  if (!gate.loopback && !gate.tls) {
    return usage(fmt::format("{} can be reached from other machines: that needs --cert and --key", options.bind));
  }
  if (!gate.loopback && options.token_file.empty() && options.client_ca.empty() && options.users.empty()) {
    return usage(fmt::format(
        "{} can be reached from other machines: say who may, with --users, --token-file or --client-ca", options.bind));
  }
  if (!options.token_file.empty()) {
    auto tokens = tokens_of(options.token_file);
    if (!tokens) {
      return tools::Failure{kFailed, tokens.error().text};
    }
    gate.tokens = std::move(tokens).value();
  } else if (options.write && options.client_ca.empty() && options.users.empty()) {
    gate.tokens.push_back({"operator", tools::random_word()});
  }
  if (!options.client_ca.empty()) {
    auto authority = ClientCertificates::open(options.client_ca, options.revoked);
    if (!authority) {
      return tools::Failure{kFailed, std::move(authority).error().text};
    }
    admission.authority = std::move(authority).value();
  }
  gate.hosts = {"localhost", "127.0.0.1", "::1", options.bind};
  if (!gate.loopback) {
    const auto own = own_names();
    gate.hosts.insert(gate.hosts.end(), own.begin(), own.end());
  }
  gate.hosts.insert(gate.hosts.end(), options.hosts.begin(), options.hosts.end());
  for (std::string& name : gate.hosts) {
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  }
  gate.origins = options.origins;
  return admission;
}

}  // namespace indurop::serve
