// SPDX-License-Identifier: Apache-2.0
// indurop run: becomes indurop-node, so exit code and signals are the node's own.
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tools/self.h"
#include "tools/verbs.h"

namespace indurop::tools {
namespace {

constexpr const char* kProgram = "indurop-node";

bool executable(const std::filesystem::path& file) {
  return access(file.c_str(), X_OK) == 0;
}

// Beside this program, in ../libexec/indurop, then along PATH.
std::filesystem::path find_node_program() {
  const auto here = program_folder();
  std::vector<std::filesystem::path> places;
  if (!here.empty()) {
    places = {here / kProgram, here / "../libexec/indurop" / kProgram};
  }
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const auto folder = rest.substr(0, colon);
    if (!folder.empty()) {
      places.emplace_back(std::filesystem::path(folder) / kProgram);
    }
    rest = colon == std::string_view::npos ? "" : rest.substr(colon + 1);
  }
  for (const auto& place : places) {
    if (executable(place)) {
      return place;
    }
  }
  return {};
}

// Does `arguments` name a configuration, or ask for something that needs none?
bool complete(const std::vector<std::string>& arguments) {
  constexpr std::array kWithValue{"--node", "--duration", "--report", "--core", "--spin"};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (std::find(kWithValue.begin(), kWithValue.end(), word) != kWithValue.end()) {
      ++i;
    } else if (word.empty() || word[0] != '-' || word == "-h" || word == "--help" || word == "--version") {
      return true;
    }
  }
  return false;
}

int run(Context& context, const std::vector<std::string>& arguments) {
  const auto program = find_node_program();
  if (program.empty()) {
    context.out.error(fmt::format("{} was found neither beside this program nor in PATH", kProgram));
    return kFailed;
  }
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::error_code ignored;
  if (!complete(arguments) && std::filesystem::exists("module.xml", ignored)) {
    words.emplace_back("module.xml");
  }
  std::vector<char*> raw;
  for (std::string& word : words) {
    raw.push_back(word.data());
  }
  raw.push_back(nullptr);
  context.out.flush();
  signal(SIGPIPE, SIG_DFL);  // ignoring it would be inherited
  execv(program.c_str(), raw.data());
  context.out.error(fmt::format("cannot start {}: {}", program.string(), std::strerror(errno)));
  return kFailed;
}

}  // namespace

const Verb kRunVerb{.name = "run",
                    .group = "Start and stop",
                    .summary = "Run a configuration (becomes indurop-node; see indurop run --help)",
                    .details = "",
                    .declare = nullptr,
                    .pass_through = &run};

}  // namespace indurop::tools
