// SPDX-License-Identifier: Apache-2.0
// PLC programs with variables that are larger than the stack of a thread.
#include <gmock/gmock.h>
#include <sys/mount.h>

#include "fixture.h"

namespace indurop::test {
namespace {

struct Kind {
  const char* name;
  const char* type;                // of the module
  std::vector<std::string> how{};  // of the run
};

class PlcLarge : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (IsSkipped()) {
      return;
    }
    ASSERT_EQ(::mount("tmpfs", "/dev/shm", "tmpfs", MS_REMOUNT | MS_NOSUID | MS_NODEV, "size=1g,mode=1777"), 0);
    put(file("program"), R"(#!/bin/sh
# g++ that makes a program of a module
for a; do
  shift
  case "$a" in
    -shared) ;;
    *.so) set -- "$@" "${a%.so}.exe";;
    *.cpp)
      echo "#include \"$a\"" > "$a.main.cpp"
      echo 'int main() { if (irp::initPeriodExe() < 0) return 1; while (irp::waitPeriod()) POU_PROGRAM(); }' >> "$a.main.cpp"
      set -- "$@" "$a.main.cpp";;
    *) set -- "$@" "$a";;
  esac
done
exec g++ "$@"
)");
    std::filesystem::permissions(file("program"), std::filesystem::perms::owner_all);
  }
  static std::string file(const std::string& name) { return (scratch() / name).string(); }
  static long long value(const std::string& name) {
    return std::stoll("0" + indurop({"get", "--node", "large", "--quiet", name}).out);
  }

  // Builds and runs it; each scan has to add `parts` times its number to the sum.
  static void expect_runs(const std::string& program, int parts, const Kind& kind) {
    SCOPED_TRACE(kind.name);
    const bool process = std::string(kind.type) == "process";
    put(file("large.st"), program);
    const Outcome built = indurop({"plc", "build", file("large.st"), "-o", file("large")},
                                  process ? Environment{.variables = {"CXX=" + file("program")}} : Environment{});
    ASSERT_EQ(built.code, 0) << built.err;
    std::string module = built.out;
    if (process) {
      module.replace(module.find("thread"), 6, "process");
      module.replace(module.find(".so"), 3, ".exe");
    }
    module.insert(module.find("</module>"), "<budget>off</budget>");  // a busy machine may hold a process up
    put(file("large/module.xml"), "<root>\n" + module + "</root>\n");
    std::vector<std::string> run{"run", file("large/module.xml"), "-q", "--node", "large", "--duration", "300ms"};
    run.insert(run.end(), kind.how.begin(), kind.how.end());
    const Outcome ran = indurop(run);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, Not(HasSubstr("faulted")));
    EXPECT_EQ(value("sum"), parts * value("scans"));
    if (!kind.how.empty()) {
      EXPECT_EQ(value("scans"), 30);
    }
    EXPECT_EQ(indurop({"clean", "--node", "large"}).code, 0);
  }
  static void expect_runs(const std::string& program, int parts) {
    for (const Kind& kind :
         {Kind{"simulated", "thread", {"--sim"}}, Kind{"thread", "thread"}, Kind{"process", "process"}}) {
      expect_runs(program, parts, kind);
    }
  }
  static std::string program_with(int elements) {
    const std::string n = std::to_string(elements);
    return "TYPE Big : STRUCT list : ARRAY[1.." + n + "] OF DINT; n : DINT; END_STRUCT; END_TYPE\n" +
           "VAR_GLOBAL big : Big; numbers : ARRAY[1.." + n + "] OF DINT; times : ARRAY[1.." + n + "] OF TIME;\n" +
           "rows : ARRAY[0..1] OF Big; scans, sum : DINT; END_VAR\n" + "PROGRAM main\n" + "VAR own : ARRAY[1.." + n +
           "] OF DINT; END_VAR\n" + "scans := scans + 1; big.n := scans; big.list[" + n + "] := scans; numbers[" + n +
           "] := scans;\n" + "rows[1].list[" + n + "] := scans; times[" + n + "] := times[" + n + "] + T#1ms;\n" +
           "own[" + n + "] := scans; numbers[1] := own[" + n + "];\n" + "sum := big.n + big.list[" + n +
           "] + numbers[1] + rows[1].list[" + n + "] + SEL(times[" + n + "] = T#1ms * scans, 0, scans);\n" +
           "END_PROGRAM\n";
  }
};

TEST_F(PlcLarge, Half_a_MiB) {
  expect_runs(program_with(131'072), 5);
}

TEST_F(PlcLarge, Four_MiB) {
  expect_runs(program_with(1'048'576), 5, Kind{"simulated", "thread", {"--sim"}});
}

TEST_F(PlcLarge, Sixty_four_MiB) {
  expect_runs(
      "VAR_GLOBAL numbers : ARRAY[1..16777216] OF DINT; scans, sum : DINT; END_VAR\n"
      "PROGRAM main\n"
      "scans := scans + 1; numbers[16777216] := scans; sum := numbers[16777216];\n"
      "END_PROGRAM\n",
      1);
}

}  // namespace
}  // namespace indurop::test
