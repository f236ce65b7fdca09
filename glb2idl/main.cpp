// SPDX-License-Identifier: Apache-2.0
// The program glb2idl: compiles .glb files to IDL, a C++ header and a layout table.

#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "core/base/exit_code.h"
#include "core/base/options.h"
#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"
#include "glb2idl/output.h"

namespace {

using namespace indurop;
using namespace indurop::glb2idl;

struct Request {
  std::string folder = ".";
  std::string depfile;
  std::string ros2;
  std::string python;
  bool c = false;
  bool check = false;
  std::vector<std::string> files;
};

std::string not_empty(const std::string& text) {
  return text.empty() ? "a value is missing" : "";
}

// Returns an exit code if the program ends here.
std::optional<int> parse(int argc, char** argv, Request& request) {
  base::Options line("glb2idl", "Compile shared variables (.glb) to IDL, a C++ header and a layout table");
  line.version("glb2idl (InduRoP) " INDUROP_VERSION);
  line.add("files", "FILE.glb", request.files, "Files to compile; what they include is compiled too");
  line.add("-o,--out-dir", "DIR", request.folder, "Where to write (default: .)").check(not_empty);
  line.add("--depfile", "FILE", request.depfile, "Also write a Makefile rule with all files that were read")
      .check(not_empty);
  line.flag("--c", request.c, "Also write headers for modules in C: DIR/<name>.glb.c.h, DIR/indurop/generated.c.h");
  line.add("--ros2", "DIR", request.ros2, "Also write ROS 2 message packages to DIR").check(not_empty);
  line.add("--python", "FILE", request.python, "Also write a Python module with the types of all variables to FILE")
      .check(not_empty);
  line.flag("--check", request.check, "Only report errors, write nothing");
  line.details(
      "Writes DIR/<name>.idl, DIR/<name>.glb.h, DIR/<name>.layout.txt for each file and the files it includes, and\n"
      "DIR/indurop/generated.h, which includes all headers. Files that would not change are left alone.\n");
  line.exit_codes({kOk, kFailed, kUsage});
  if (const auto code = line.parse_program(argc, argv)) {
    return code;
  }
  if (request.files.empty()) {
    std::fputs("glb2idl: error: no .glb file given; see glb2idl --help\n", stderr);
    return kUsage;
  }
  return std::nullopt;
}

void print(const std::vector<base::Diagnostic>& diagnostics) {
  std::fputs(base::to_text(diagnostics, "glb2idl").c_str(), stderr);
}

int run(const Request& request) {
  const Compilation compilation = compile(request.files);
  if (!compilation.ok) {
    print(compilation.diagnostics);
    return kFailed;
  }
  print(compilation.notes);
  const RosPackages ros2 = request.ros2.empty() ? RosPackages{} : emit_ros2(compilation.program);
  if (!ros2.problems.empty()) {
    print(ros2.problems);
    return kFailed;
  }
  if (request.check) {
    return kOk;
  }
  const std::vector<Output> outputs = emit_all(compilation.program);
  std::string error;
  if (!request.depfile.empty()) {
    error = write_file(request.depfile, depfile_text(request.folder + "/" + outputs.back().path, compilation.files));
  }
  if (error.empty()) {
    error = write_all(request.folder, outputs);
  }
  if (error.empty() && request.c) {
    error = write_all(request.folder, emit_c(compilation.program));
  }
  if (error.empty() && !request.python.empty()) {
    error = write_file(request.python, emit_python(compilation.program));
  }
  if (error.empty()) {
    error = write_all(request.ros2, ros2.outputs);
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
    Request request;
    if (const auto code = parse(argc, argv, request)) {
      return *code;
    }
    return run(request);
  } catch (const std::exception& error) {  // out of memory and similar
    std::fprintf(stderr, "glb2idl: error: %s\n", error.what());
    return kFailed;
  }
}
