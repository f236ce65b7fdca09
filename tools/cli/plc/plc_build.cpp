// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_build.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "control/plc/front/compiler.h"
#include "control/plc/front/library_file.h"
#include "core/base/program_folder.h"
#include "core/base/replace_file.h"
#include "tools/cli/plc/plc_compiler.h"
#include "tools/cli/plc/plc_file.h"
#include "tools/cli/plc/plc_retained.h"
#include "tools/cli/plc/plc_sources.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

struct PlcRequest {
  plc::CompileOptions compile;
  std::string folder = ".";  // -o
  bool only_sources = false;
  std::string version;  // for a library
};

bool save(Context& context, const fs::path& path, const std::string& text) {
  const auto saved = base::replace_file(path, text, base::Durable::No);
  if (!saved) {
    context.out.error(base::cannot_write(path, saved.error()));
  }
  return saved.ok();
}

// The programs, library and headers of InduRoP: in the folder of this program, in a build directory as well as in an
// installation.
struct BuildParts {
  fs::path glb2idl;
  fs::path headers;
  fs::path library;
};

bool find_parts(Context& context, BuildParts& parts) {
  const fs::path programs = base::program_folder();
  const fs::path prefix = programs.parent_path();
  std::error_code error;
  parts.glb2idl = programs / "glb2idl";
  parts.headers = prefix / "include";
  std::vector<fs::path> folders{prefix / "lib", prefix / "lib64"};
  for (const auto& entry : fs::directory_iterator(prefix / "lib", error)) {
    folders.push_back(entry.path());  // lib/x86_64-linux-gnu
  }
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / "libindurop.so", error)) {
      parts.library = folder;
    }
  }
  for (const fs::path& needed : {parts.glb2idl, parts.headers / "indurop/indurop.h"}) {
    if (!fs::exists(needed, error)) {
      context.out.error(fmt::format("{} is not there; is InduRoP installed completely?", needed.string()));
      return false;
    }
  }
  if (parts.library.empty()) {
    context.out.error(
        fmt::format("there is no libindurop.so in {}/lib; is InduRoP installed completely?", prefix.string()));
  }
  return !parts.library.empty();
}

std::string compiler() {
  const char* chosen = std::getenv("CXX");  // NOLINT(concurrency-mt-unsafe): one thread
  return chosen != nullptr && *chosen != '\0' ? chosen : "g++";
}

std::string names_of(const std::vector<std::string>& files) {
  std::string out;
  for (const std::string& one : files) {
    out += (out.empty() ? "" : ", ") + one;
  }
  return out;
}

bool build_modules(Context& context, const plc::CompileOptions& options, const plc::Compiled& compiled,
                   const fs::path& folder) {
  BuildParts parts;
  if (!find_parts(context, parts)) {
    return false;
  }
  const fs::path generated = folder / (compiled.name + ".generated");
  std::vector<std::string> glb{parts.glb2idl.string(), "-o", generated.string()};
  glb.insert(glb.end(), options.glb_files.begin(), options.glb_files.end());
  glb.push_back((folder / (compiled.name + ".glb")).string());
  const std::string sources = names_of(options.files);
  if (!run_compiler(context, glb, folder / (compiled.name + ".glb"), sources)) {
    return false;
  }
  for (const plc::ModuleText& one : compiled.modules) {
    const fs::path module = folder / (one.name + ".so");
    const fs::path code = folder / (one.name + ".cpp");
    // The flags of indurop_add_module(). Watched programs are compiled with -O1, for which g++ needs a third less time;
    // without strict aliasing the code would look up the program's address again after each power value.
    std::vector<std::string> arguments{compiler(),
                                       "-std=c++20",
                                       options.debug || options.watch ? "-O1" : "-O2",
                                       "-g1",
                                       "-fPIC",
                                       "-fno-gnu-unique",
                                       "-shared",
                                       "-Wl,--no-undefined",
                                       "-isystem" + parts.headers.string(),
                                       "-isystem" + generated.string(),
                                       code.string(),
                                       "-o",
                                       module.string(),
                                       "-L" + parts.library.string(),
                                       "-lindurop",
                                       "-Wl,-rpath," + parts.library.string()};
    if (options.watch) {
      arguments.emplace_back("-fstrict-aliasing");
    }
    if (arguments[0].find("clang") == std::string::npos) {  // g++ collects garbage earlier than by default
      arguments.insert(arguments.end(), {"--param", options.watch ? "ggc-min-expand=30" : "ggc-min-expand=50"});
    }
    if (!run_compiler(context, arguments, code, sources)) {
      return false;
    }
  }
  return true;
}

// Compiles and prints the diagnostics. Unlike a module a library may have no PROGRAM.
plc::Compiled compile(Context& context, plc::CompileOptions options, bool library) {
  options.library = library;
  const auto files = with_project_files(context, options.files);
  if (!files) {
    return {};
  }
  options.files = *files;
  const EndsAtOnce ends;
  plc::Compiled compiled = plc::compile(options);
  print_diagnostics(context, compiled.diagnostics);
  return compiled;
}

// Prints the diagnostics, else one line.
int check_plc(Context& context, const PlcRequest& request) {
  const plc::Compiled compiled = compile(context, request.compile, true);
  if (!compiled.ok) {
    return kCheckFailed;
  }
  context.out.note(compiled.modules.empty() ? "a library without a PROGRAM, no errors"
                                            : fmt::format("{} module{}, no errors", compiled.modules.size(),
                                                          compiled.modules.size() == 1 ? "" : "s"));
  return kOk;
}

// The folder for <filename> of a module.xml in the working directory: ./build, ../build or /build.
std::string from_here(const fs::path& folder) {
  std::string path = folder.lexically_normal().string();
  while (path.size() > 1 && path.back() == '/') {
    path.pop_back();
  }
  return path == "." || path.starts_with('/') || path.starts_with("..") ? path : "./" + path;
}

// Writes <name>.glb and, for each task, .cpp and .so; prints the modules for a module.xml in the working directory.
int build_plc(Context& context, const PlcRequest& request) {
  const plc::Compiled compiled = compile(context, request.compile, false);
  if (!compiled.ok) {
    return kCheckFailed;
  }
  if (!write_modules(context, request.compile, compiled, request.folder, request.only_sources)) {
    return kFailed;
  }
  for (const plc::ModuleText& one : compiled.modules) {
    if (!request.only_sources) {
      context.out.note("made " + (fs::path(request.folder) / (one.name + ".so")).string());
    }
  }
  if (!context.out.quiet()) {
    context.out.write(plc::module_xml(compiled.modules, from_here(request.folder)));
  }
  return kOk;
}

// Writes <name>-<version>.plclib.
int build_library(Context& context, const PlcRequest& request) {
  if (!plc::is_version(request.version)) {
    context.out.error(fmt::format("'{}' is not a version, write --version 1.2.0", request.version));
    return kUsage;
  }
  const plc::Compiled compiled = compile(context, request.compile, true);
  if (!compiled.ok) {
    return kCheckFailed;
  }
  if (!compiled.modules.empty()) {
    context.out.error("a library has no PROGRAM, leave it out, or use indurop plc build");
    return kCheckFailed;
  }
  plc::LibraryFile library;
  library.name = compiled.name;
  library.version = request.version;
  library.dialect = request.compile.dialect.value_or(compiled.dialect);
  const auto files = with_project_files(context, request.compile.files);
  for (const std::string& one : files.value_or(std::vector<std::string>())) {
    if (one.ends_with(".plcproj")) {  // it only has names of files
      context.out.error(fmt::format("{} is a project, name its files instead", one));
      return kUsage;
    }
    plc::LibrarySource& source = library.sources.emplace_back();
    source.name = fs::path(one).filename().string();
    if (!read_plc_file(context, one, source.text)) {
      return kFailed;
    }
  }
  const fs::path file = fs::path(request.folder) / fmt::format("{}-{}.plclib", library.name, library.version);
  if (!save(context, file, to_text(library))) {
    return kFailed;
  }
  context.out.note("made " + file.string());
  return kOk;
}

}  // namespace

bool write_modules(Context& context, const plc::CompileOptions& options, const plc::Compiled& compiled,
                   const fs::path& folder, bool only_sources) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    context.out.error(fmt::format("cannot make {}: {}", folder.string(), error.message()));
    return false;
  }
  const fs::path glb = folder / (compiled.name + ".glb");
  print_diagnostics(context, retained_changes(glb, compiled.glb, options.glb_files));
  bool saved = save(context, glb, compiled.glb);
  for (const plc::ModuleText& one : compiled.modules) {
    saved = saved && save(context, folder / (one.name + ".cpp"), one.cpp);
  }
  return saved && (only_sources || build_modules(context, options, compiled, folder));
}

void add_plc_build(base::Options& app, const std::shared_ptr<Action>& chosen) {
  const auto request = std::make_shared<PlcRequest>();
  const auto verb = [&](const char* name, const char* help, int (*action)(Context&, const PlcRequest&)) {
    base::Options& made = app.command(name, help, [request, chosen, action] {
      *chosen = [request, action](Context& c) { return action(c, *request); };
    });
    add_plc_sources(made, request->compile);
    return &made;
  };
  base::Options* build = verb("build", "Compile a program into modules (.so) and shared variables (.glb)", &build_plc);
  build->add("-o,--output", "DIR", request->folder, "Where to write them (default: here)");
  build->flag("--watch", request->compile.watch,
              "Let `indurop plc watch` see its variables and the power in its networks");
  build->flag("--debug", request->compile.debug,
              "Let `indurop plc debug` stop it at any line; slow, only for simulations");
  build->flag("--coverage", request->compile.coverage,
              "Count how often its statements run, for `indurop plc coverage`; the counters go to the folder that "
              "INDUROP_PLC_COVERAGE names");
  build->flag("--only-sources", request->only_sources, "Write .glb and .cpp, do not compile them");
  verb("check", "Report the errors in a program", &check_plc);
  base::Options* lib = verb("lib", "Create a library (.plclib) for --lib from files without a PROGRAM", &build_library);
  lib->add("--version", "VERSION", request->version, "Version of the library, e.g. 1.2.0").required();
  lib->add("-o,--output", "DIR", request->folder, "Where to write it (default: here)");
}

}  // namespace indurop::tools
