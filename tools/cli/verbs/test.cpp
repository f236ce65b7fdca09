// SPDX-License-Identifier: Apache-2.0
// indurop test: builds a project and runs its tests, with a JUnit file and the coverage of PLC programs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "core/base/program_folder.h"
#include "tools/cli/command/package_folder.h"
#include "tools/cli/plc/plc_coverage.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/process/child.h"

namespace indurop::tools {
namespace {

namespace fs = std::filesystem;

struct TestOptions {
  fs::path folder = ".";
  fs::path build;  // empty: FOLDER/build
  std::string select;
  fs::path junit;  // empty: tests.xml in the build folder
  std::string lcov;
  int jobs = 0;
};

// Returns false after an error message: the program could not be started, or failed and printed why.
bool run(Context& context, const std::vector<std::string>& words, int& code) {
  const auto ended = run_child(words);
  if (!ended) {
    context.out.error(ended.error().text);
    code = kFailed;
    return false;
  }
  code = *ended;
  return code == 0;
}

bool build(Context& context, const TestOptions& options, const fs::path& folder) {
  int code = 0;
  std::error_code ignored;
  if (!fs::exists(folder / "CMakeCache.txt", ignored)) {
    std::vector<std::string> words{"cmake", "-S", options.folder.string(), "-B", folder.string()};
    if (const fs::path package = package_folder(base::program_folder()); !package.empty()) {
      words.push_back("-DInduRoP_DIR=" + package.string());
    }
    if (!run(context, words, code)) {
      context.out.error(fmt::format("{} cannot be configured", options.folder.string()));
      return false;
    }
  }
  std::vector<std::string> words{"cmake", "--build", folder.string(), "--parallel"};
  if (options.jobs > 0) {
    words.push_back(std::to_string(options.jobs));
  }
  if (!run(context, words, code)) {
    context.out.error(fmt::format("{} cannot be built: no test ran", options.folder.string()));
    return false;
  }
  return true;
}

bool has_counters(const fs::path& folder) {
  std::error_code ignored;
  const fs::directory_iterator files(folder, ignored);
  return std::any_of(begin(files), end(files),
                     [](const fs::directory_entry& file) { return file.path().extension() == ".plccov"; });
}

int test(Context& context, const TestOptions& options) {
  std::error_code error;
  if (!fs::exists(options.folder / "CMakeLists.txt", error)) {
    context.out.error(
        fmt::format("there is no project in {}: a CMakeLists.txt is expected there; indurop new makes one",
                    fs::absolute(options.folder, error).string()));
    return kUsage;
  }
  const fs::path folder = fs::absolute(options.build.empty() ? options.folder / "build" : options.build, error);
  if (!build(context, options, folder)) {
    return kFailed;
  }
  // The coverage is that of these tests alone.
  const fs::path counters = folder / "coverage";
  fs::remove_all(counters, error);
  fs::create_directories(counters, error);
  const fs::path junit = fs::absolute(options.junit.empty() ? folder / "tests.xml" : options.junit, error);
  std::vector<std::string> words{"cmake",
                                 "-E",
                                 "env",
                                 "INDUROP_PLC_COVERAGE=" + counters.string(),
                                 "ctest",
                                 "--test-dir",
                                 folder.string(),
                                 "--output-on-failure",
                                 "--no-tests=error",
                                 "--output-junit",
                                 junit.string()};
  if (!options.select.empty()) {
    words.insert(words.end(), {"-R", options.select});
  }
  if (options.jobs > 0) {
    words.insert(words.end(), {"-j", std::to_string(options.jobs)});
  }
  int code = 0;
  const bool passed = run(context, words, code);
  if (has_counters(counters)) {
    context.out.line();
    if (const int shown = show_coverage(context, counters, options.lcov); shown != kOk && passed) {
      return shown;
    }
  } else if (!options.lcov.empty()) {
    context.out.error("--lcov: no PLC program of this project counts what runs; name COVERAGE in indurop_add_plc");
    return kFailed;
  }
  context.out.note(fmt::format("{}; see {}", passed ? "all tests passed" : "not all tests passed", junit.string()));
  return passed ? kOk : kCheckFailed;
}

Action declare_test(base::Options& app, Context& /*context*/) {
  auto options = std::make_shared<TestOptions>();
  app.add("folder", "FOLDER", options->folder,
          "Folder of the project, with its CMakeLists.txt (default: current folder)")
      .completes(base::Completion::Folder);
  app.add("--build", "FOLDER", options->build, "Build folder (default: build in the project)")
      .completes(base::Completion::Folder);
  app.add("-R,--select", "REGEX", options->select, "Only tests whose names match");
  app.add("--junit", "FILE", options->junit,
          "Write the results to this file as JUnit XML (default: tests.xml in the build folder)")
      .completes(base::Completion::File);
  app.add("--lcov", "FILE.info", options->lcov, "Write the coverage of PLC programs for lcov, genhtml and others")
      .completes(base::Completion::File);
  app.add("-j,--jobs", "N", options->jobs, "Number of compilers and tests to run in parallel");
  return [options](Context& c) { return test(c, *options); };
}

}  // namespace

const Verb kTestVerb{
    "test", "Before it runs", "Build a project and run its tests in virtual time",
    "Configures and builds the project with CMake if necessary, runs its tests with ctest and writes a JUnit\n"
    "file. Tests use <indurop/testing.h> (docs/testing.md) to run modules, PLC programs and whole plants in\n"
    "virtual time. For PLC programs that were added with COVERAGE it shows which lines, rungs and branches the\n"
    "tests covered.\n"
    "Exit code 4 if a test failed or there are no tests, 1 if the project could not be built.\n"
    "Examples:\n"
    "  indurop test\n"
    "  indurop test cell --select Stops --junit results.xml\n"
    "  indurop test cell --lcov coverage.info\n",
    &declare_test};

}  // namespace indurop::tools
