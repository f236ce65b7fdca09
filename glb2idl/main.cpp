// SPDX-License-Identifier: Apache-2.0
// The program glb2idl: .glb files to IDL, C++ header and layout table.

#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"
#include "glb2idl/output.h"

namespace {

using namespace indurop::glb2idl;

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsage = 2;

constexpr const char* kHelp = R"(Usage: glb2idl [options] FILE.glb ...

Turns shared variables (.glb) into IDL, a C++ header and a layout table:
DIR/<name>.idl, DIR/<name>.glb.h, DIR/<name>.layout.txt for each file and the
files it includes, and DIR/indurop/generated.h, which includes all headers.
Files that would not change are left alone.

  -o, --out-dir DIR    where to write (default: .)
      --depfile FILE   also write a Makefile rule with all files that were read
      --ros2 DIR       also write packages of ROS 2 messages into DIR
      --check          only report errors, write nothing
  -h, --help           this text
      --version        version

Exit code: 0 done, 1 errors in the files or while writing, 2 wrong usage.
)";

struct Options {
  std::string folder = ".";
  std::string depfile;
  std::string ros2;
  bool check = false;
  std::vector<std::string> files;
};

int usage_error(const std::string& text) {
  std::fprintf(stderr, "glb2idl: error: %s; see glb2idl --help\n", text.c_str());
  return kUsage;
}

// The value of an option written as "--name VALUE", "--name=VALUE", or nullopt if `argument` is another one.
class Arguments {
 public:
  explicit Arguments(std::span<char*> all) : all_(all) {}
  [[nodiscard]] bool done() const noexcept { return at_ == all_.size(); }
  std::string_view take() noexcept { return all_[at_++]; }

  enum class Match { No, Yes, MissingValue };
  Match value(std::string_view argument, std::string_view name, std::string& to) {
    if (argument == name) {
      if (done()) {
        return Match::MissingValue;
      }
      to = take();
      return to.empty() ? Match::MissingValue : Match::Yes;
    }
    const bool with_sign = name.starts_with("--") && argument.size() > name.size() && argument.starts_with(name) &&
                           argument[name.size()] == '=';
    if (!with_sign) {
      return Match::No;
    }
    to = argument.substr(name.size() + 1);
    return to.empty() ? Match::MissingValue : Match::Yes;
  }

 private:
  std::span<char*> all_;
  std::size_t at_ = 0;
};

// An exit code if the program ends here.
std::optional<int> parse(Arguments arguments, Options& options) {
  bool only_files = false;
  while (!arguments.done()) {
    const std::string_view argument = arguments.take();
    if (only_files || !argument.starts_with('-')) {
      options.files.emplace_back(argument);
      continue;
    }
    if (argument == "--") {
      only_files = true;
      continue;
    }
    if (argument == "-h" || argument == "--help") {
      std::fputs(kHelp, stdout);
      return kOk;
    }
    if (argument == "--version") {
      std::puts("glb2idl (InduRoP) " INDUROP_VERSION);
      return kOk;
    }
    if (argument == "--check") {
      options.check = true;
      continue;
    }
    using Match = Arguments::Match;
    Match match = arguments.value(argument, "-o", options.folder);
    match = match == Match::No ? arguments.value(argument, "--out-dir", options.folder) : match;
    match = match == Match::No ? arguments.value(argument, "--depfile", options.depfile) : match;
    match = match == Match::No ? arguments.value(argument, "--ros2", options.ros2) : match;
    if (match == Match::MissingValue) {
      return usage_error("a value is missing behind " + std::string(argument));
    }
    if (match == Match::No) {
      return usage_error("unknown option " + std::string(argument));
    }
  }
  if (options.files.empty()) {
    return usage_error("no .glb file given");
  }
  return std::nullopt;
}

int run(const Options& options) {
  const Compilation compilation = compile(options.files);
  if (!compilation.ok) {
    std::fputs(compilation.messages.c_str(), stderr);
    return kFailed;
  }
  const RosPackages ros2 = options.ros2.empty() ? RosPackages{} : emit_ros2(compilation.program);
  if (!ros2.problems.empty()) {
    std::fputs(ros2.problems.c_str(), stderr);
    return kFailed;
  }
  if (options.check) {
    return kOk;
  }
  const std::vector<Output> outputs = emit_all(compilation.program);
  std::string error;
  if (!options.depfile.empty()) {
    error = write_file(options.depfile, depfile_text(options.folder + "/" + outputs.back().path, compilation.files));
  }
  if (error.empty()) {
    error = write_all(options.folder, outputs);
  }
  if (error.empty()) {
    error = write_all(options.ros2, ros2.outputs);
  }
  if (!error.empty()) {
    std::fprintf(stderr, "glb2idl: error: %s\n", error.c_str());
    return kFailed;
  }
  return kOk;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    const std::span<char*> all(argv, static_cast<std::size_t>(argc));
    if (const auto code = parse(Arguments(all.subspan(all.empty() ? 0 : 1)), options)) {
      return *code;
    }
    return run(options);
  } catch (const std::exception& error) {  // out of memory and the like
    std::fprintf(stderr, "glb2idl: error: %s\n", error.what());
    return kFailed;
  }
}
