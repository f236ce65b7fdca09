// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/verbs/new_templates.h"

#include <fmt/format.h>

#include <array>

namespace indurop::tools {
namespace {

constexpr const char* kCMakeLists = R"text(# Builds the modules of @NAME@ into build/. `make` does all of it.
cmake_minimum_required(VERSION 3.25)
project(@NAME@ LANGUAGES C CXX)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()
find_package(InduRoP @VERSION@ REQUIRED)

# Shared variables: targets that name the one below can include <indurop/generated.h>.
indurop_add_glb(variables FILES @NAMESPACE@.glb)

# Thread modules (.so) run inside the node, process modules (.exe) in processes of their own.
indurop_add_module(wave SOURCES src/wave.cpp GLB variables)
indurop_add_module(smooth SOURCES src/smooth.cpp GLB variables)
indurop_add_module(monitor PROCESS SOURCES src/monitor.cpp GLB variables)
@PLC@
# Tests in virtual time, where GoogleTest is installed (Debian: libgtest-dev): `make test`.
find_package(InduRoP @VERSION@ REQUIRED COMPONENTS testing)
find_package(GTest)
if(GTest_FOUND)
  enable_testing()
  add_executable(@NAME@_test tests/@NAME@_test.cpp)
  target_link_libraries(@NAME@_test PRIVATE indurop::testing variables GTest::gtest_main)
  target_compile_definitions(@NAME@_test PRIVATE CONFIGURATION="${CMAKE_CURRENT_SOURCE_DIR}/module.xml")
  add_test(NAME @NAME@ COMMAND @NAME@_test)
endif()
)text";

constexpr const char* kMakefile =
    R"text(# make: build    make check: look for mistakes    make test    make run: run until Ctrl-C    make clean
# Where InduRoP was when this project was made; if it is there no more, CMake and PATH are searched.
INDUROP_PACKAGE ?= @PACKAGE@
INDUROP_PROGRAMS ?= @PROGRAMS@
INDUROP = $(firstword $(wildcard $(INDUROP_PROGRAMS)/indurop) indurop)

MAKEFLAGS += --no-print-directory
.PHONY: all check test run clean
all:
	@cmake -S . -B build $(if $(wildcard $(INDUROP_PACKAGE)/InduRoPConfig.cmake),"-DInduRoP_DIR=$(INDUROP_PACKAGE)")
	@cmake --build build

check: all
	@"$(INDUROP)" check module.xml

test: all
	@cd build && ctest --output-on-failure --output-junit tests.xml

run: all
	@"$(INDUROP)" run module.xml

clean:
	@rm -rf build
)text";

constexpr const char* kGlb =
    R"text(// Variables that all modules of @NAME@ share. A comment behind a declaration is its description.
namespace @NAMESPACE@;

double gain = 1.0 @range(0, 10);  // amplitude of the wave: try `indurop set gain 2.5`
double wave @unit("mm");          // written by wave, every millisecond
double smoothed @unit("mm");      // written by smooth, every 10 milliseconds
uint32_t starts = 0 @retain;      // how often this project was started; outlives the power

struct {
  double lowest @unit("mm");
  double highest @unit("mm");
  uint32_t samples;
} seen;  // written by monitor, every 100 milliseconds
)text";

constexpr const char* kWave = R"text(// Thread module, every millisecond: makes a sine wave.
#include <indurop/indurop.h>
#include <indurop/generated.h>

#include <cmath>
#include <numbers>

using namespace @NAMESPACE@;

namespace {
double seconds_per_wave = 2.0;
double phase = 0;
}  // namespace

// What the next run needs: recordings can begin in the middle, and `indurop reload wave` goes on from here.
INDUROP_STATE(phase)

// Before the first run and not real-time: the place for files, memory, properties.
void on_start() {
  seconds_per_wave = irp::property("seconds per wave", 2.0);
  ++starts;
}

// Real-time: no memory allocation, no files, no waiting.
void on_run() {
  constexpr double kPeriod = 0.001;
  phase += 2 * std::numbers::pi * kPeriod / seconds_per_wave;
  phase = std::fmod(phase, 2 * std::numbers::pi);
  wave = gain * std::sin(phase);
}

INDUROP_MODULE(start = &::on_start, run = &::on_run, name = "wave")
)text";

constexpr const char* kSmooth = R"text(// Thread module, every 10 milliseconds: smooths the wave.
#include <indurop/indurop.h>
#include <indurop/generated.h>

using namespace @NAMESPACE@;

INDUROP_STATE()  // keeps nothing of its own between two runs

void on_run() {
  constexpr double kPart = 0.2;
  smoothed += kPart * (wave - smoothed);
}

INDUROP_MODULE(run = &::on_run, name = "smooth")
)text";

constexpr const char* kMonitor =
    R"text(// Process module, every 100 milliseconds: watches the smoothed wave. A crash here does not touch the other modules.
#include <indurop/indurop.h>
#include <indurop/generated.h>

#include <algorithm>

INDUROP_STATE()  // keeps nothing of its own between two runs

int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;  // the reason was printed
  }
  while (irp::waitPeriod()) {
    const double now = @NAMESPACE@::smoothed;
    auto seen = lock(@NAMESPACE@::seen);  // one commit when the scope ends
    seen->lowest = std::min(seen->lowest, now);
    seen->highest = std::max(seen->highest, now);
    seen->samples += 1;
    if (seen->samples % 10 == 0) {
      irp::printf("smoothed %6.3f mm, between %6.3f and %6.3f\n", now, seen->lowest, seen->highest);
    }
  }
  return 0;
}
)text";

constexpr const char* kTest = R"text(// What the modules of @NAME@ do together, in virtual time: the same on every run.
#include <@GTEST@>
#include <indurop/generated.h>
#include <indurop/testing.h>

using namespace @NAMESPACE@;
using namespace std::chrono_literals;

TEST(Wave, Is_as_high_as_gain_says) {
  irp::testing::Plant p(CONFIGURATION);
  p.set("gain", 2.5);
  p.run(500ms);  // a quarter of a wave
  EXPECT_NEAR(wave, 2.5, 0.01) << "variables of the header are those of the plant";
  EXPECT_NEAR(p.get<double>("wave"), 2.5, 0.01) << "and the same by name";
  EXPECT_EQ(p.module("wave").runs, 500u);
}

TEST(Monitor, Is_started_again_after_a_crash) {
  irp::testing::Plant p(CONFIGURATION);
  p.run(1s);
  EXPECT_EQ(p.get<int>("seen.samples"), 10);
  p.kill("monitor");
  EXPECT_TRUE(p.run_until([&] { return p.get<int>("seen.samples") == 15; }, 5s));
  EXPECT_EQ(p.module("monitor").restarts, 1u);
  EXPECT_EQ(p.module("wave").faults, 0u);
}
)text";

constexpr const char* kPlcProgram =
    R"text((* PLC program, every 20 milliseconds: the lamp is on while the wave has been high for 200 ms. *)
VAR_GLOBAL
  lamp : BOOL;
END_VAR

PROGRAM logic
VAR_EXTERNAL
  smoothed : LREAL;
END_VAR
VAR
  delay : TON;
END_VAR
  delay(IN := smoothed > 0.5, PT := T#200ms);
  lamp := delay.Q;
END_PROGRAM
)text";

constexpr const char* kPlcBuild = R"text(
# A program of IEC 61131-3 becomes a thread module. Its variables are @NAMESPACE@_plc::..., and `indurop plc watch` shows it.
indurop_add_plc(logic SOURCES src/logic.st GLB variables NAMESPACE @NAMESPACE@_plc WATCH)
)text";

// In the order of their priorities.
constexpr std::array<ProjectModule, 3> kModules{{{"wave", R"text(  <module>
    <filename>./build/wave.so</filename>
    <moduletype>thread</moduletype>
    <operationtype>periodic</operationtype>
    <period>1ms</period>
    <priority>1</priority>
    <property>
      <value name="seconds per wave">2.0</value>
    </property>
  </module>
)text"},
                                                 {"smooth", R"text(  <module>
    <filename>./build/smooth.so</filename>
    <moduletype>thread</moduletype>
    <operationtype>periodic</operationtype>
    <period>10ms</period>
    <priority>2</priority>
  </module>
)text"},
                                                 {"monitor", R"text(  <module>
    <filename>./build/monitor.exe</filename>
    <moduletype>process</moduletype>
    <operationtype>periodic</operationtype>
    <period>100ms</period>
    <priority>3</priority>
  </module>
)text"}}};

constexpr ProjectModule kPlcModule{"logic", R"text(  <module>
    <filename>./build/logic.so</filename>
    <moduletype>thread</moduletype>
    <operationtype>periodic</operationtype>
    <period>20ms</period>
    <priority>4</priority>
  </module>
)text"};

constexpr const char* kModuleXmlHead = R"text(<?xml version="1.0" encoding="UTF-8"?>
<!-- What runs, how often and in which order: the lowest priority value comes first in each period. -->
<root>
)text";

constexpr const char* kReadme = R"text(# @NAME@

An InduRoP project: modules that share variables.

| file | what it is |
|---|---|
| `@NAMESPACE@.glb` | the shared variables |
| `src/wave.cpp`, `src/smooth.cpp` | thread modules |
| `src/monitor.cpp` | process module |
@PLC_ROW@| `module.xml` | periods, priorities, properties |
@PLANT_ROW@| `tests/@NAME@_test.cpp` | what they do together, tested in virtual time |

    make                      # builds into build/
    indurop check             # mistakes, who reads and writes what
    indurop plan              # which module runs in which basic period
    make test                 # in virtual time; needs GoogleTest (Debian: libgtest-dev)
    indurop run --detach      # runs module.xml in the background
    indurop status
    indurop watch '@NAMESPACE@::*'   # q quits
    indurop set gain 2.5
    indurop jitter
    indurop stop

Real time needs privileges; without them, timing is not guaranteed. `indurop doctor` lists what is missing.
If `indurop` is not found, put it into PATH: `export PATH=@PROGRAMS@:$PATH`.
)text";

constexpr const char* kGitignore = "build/\n";

constexpr std::array<ProjectFile, 9> kFiles{{{"CMakeLists.txt", kCMakeLists},
                                             {"Makefile", kMakefile},
                                             {"@NAMESPACE@.glb", kGlb},
                                             {"src/wave.cpp", kWave},
                                             {"src/smooth.cpp", kSmooth},
                                             {"src/monitor.cpp", kMonitor},
                                             {"tests/@NAME@_test.cpp", kTest},
                                             {"README.md", kReadme},
                                             {".gitignore", kGitignore}}};

}  // namespace

std::span<const ProjectFile> project_files() {
  return kFiles;
}

ProjectFile plc_file() {
  return {"src/logic.st", kPlcProgram};
}

std::string plc_build() {
  return kPlcBuild;
}

std::vector<ProjectModule> project_modules(bool with_plc) {
  std::vector<ProjectModule> modules(kModules.begin(), kModules.end());
  if (with_plc) {
    modules.push_back(kPlcModule);
  }
  return modules;
}

std::string module_xml(const std::vector<ProjectModule>& modules) {
  std::string text = kModuleXmlHead;
  for (const ProjectModule& module : modules) {
    text += module.xml;
  }
  return text + "</root>\n";
}

std::string plant_xml(const std::vector<ProjectModule>& modules, std::size_t boards) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- Which module runs on which board. indurop run plant.xml --local runs all boards here. -->\n"
      "<plant name=\"@NAME@\">\n";
  for (std::size_t board = 0; board < boards; ++board) {
    text += fmt::format("<board name=\"board{}\">\n", board + 1);
    for (std::size_t i = board; i < modules.size(); i += boards) {
      text += modules[i].xml;
    }
    text += "</board>\n";
  }
  return text + "</plant>\n";
}

}  // namespace indurop::tools
