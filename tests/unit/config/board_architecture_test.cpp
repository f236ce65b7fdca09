// SPDX-License-Identifier: Apache-2.0
// Files of a plant have to be built for the boards that run them.

#include <elf.h>

#include <algorithm>

#include "config/check/check_plant.h"
#include "config/xml/plant_reader.h"
#include "configuration.h"
#include "module_file.h"

namespace indurop::config {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BoardArchitecture : public testing::Test {
 protected:
  // Without the note that the plant is open.
  std::vector<std::string> lines_of(const std::string& elements, const CheckOptions& options = {}) const {
    Plant plant = read_plant_text("<plant name=\"cell\">\n" + elements + "</plant>\n", folder_ / "plant.xml").plant;
    std::vector<std::string> all = lines(check_plant(plant, options).diagnostics);
    std::erase_if(all, [](const std::string& line) { return line.find("the plant is open") != std::string::npos; });
    return all;
  }
  static std::string board(const std::string& name, const std::string& content) {
    return "<board name=\"" + name + "\">" + content + "</board>\n";
  }

  ModuleFolder folder_;
};

TEST_F(BoardArchitecture, Modules_for_elsewhere_are_not_compared_with_this_machine) {
  const std::uint16_t other = EM_S390;
  ModuleSpec spec;
  spec.machine = other;
  write_module(folder_ / "a.so", spec);
  ModuleSpec here;
  write_module(folder_ / "b.so", here);
  const CheckOptions elsewhere{.machine = false};
  const std::string core = "<core>4000</core>";
  const std::string a = board("a", periodic("a.so", "1ms", 1, core));
  EXPECT_THAT(lines_of(a, elsewhere), IsEmpty());
  EXPECT_THAT(lines_of(a), Contains(HasSubstr("this machine is")));
  EXPECT_THAT(lines_of(a), Contains(HasSubstr("processor 4000 does not exist")));
  EXPECT_THAT(
      lines_of(board("a", periodic("a.so", "1ms", 1) + periodic("b.so", "1ms", 2)), elsewhere),
      ElementsAre(AllOf(HasSubstr("'b.so' is built for "), HasSubstr("a of the same board for machine number 22"))));
  const CheckOptions only_b{.board = "b"};
  EXPECT_THAT(lines_of(a + board("b", periodic("b.so", "1ms", 1)), only_b), IsEmpty());
}

TEST_F(BoardArchitecture, Files_are_those_of_the_board_s_architecture) {
  ModuleSpec arm;
  arm.machine = EM_AARCH64;
  ModuleSpec x86;
  x86.machine = EM_X86_64;
  for (const char* folder : {"build-arm64", "build-amd64"}) {
    std::filesystem::create_directory(folder_ / folder);
  }
  write_module(folder_ / "build-arm64/a.so", arm);
  write_module(folder_ / "build-amd64/a.so", x86);
  const auto on = [](const std::string& name, const std::string& arch, const std::string& file) {
    return "<board name=\"" + name + "\" arch=\"" + arch + "\">" + periodic(file, "1ms", 1) + "</board>\n";
  };
  const CheckOptions elsewhere{.machine = false};
  const std::string each = "build-${arch}/a.so";
  EXPECT_THAT(lines_of(on("x", "amd64", each) + on("y", "arm64", each), elsewhere), IsEmpty());
  EXPECT_THAT(lines_of(on("x", "amd64", each) + on("y", "arm64", "build-amd64/a.so"), elsewhere),
              ElementsAre(AllOf(HasSubstr("plant.xml:4:48: error: "),
                                HasSubstr("'build-amd64/a.so' is built for x86-64, the board is arm64; name the file "
                                          "that is built for the board"))));
  // A board checks its own files against its own processor, too.
  const std::string swapped = on("x", "arm64", each) + on("y", "amd64", each);
  const CheckOptions here{.board = "x"};
#if defined(__x86_64__)
  EXPECT_THAT(lines_of(swapped, here),
              ElementsAre(HasSubstr("'build-arm64/a.so' is built for AArch64, this machine is x86-64")));
#endif
}

TEST_F(BoardArchitecture, Type_libraries_are_those_of_the_board_s_architecture) {
  const CheckOptions elsewhere{.machine = false};
  for (const auto& [arch, machine] : {std::pair{"amd64", EM_X86_64}, std::pair{"arm64", EM_AARCH64}}) {
    std::filesystem::create_directory(folder_ / arch);
    ModuleSpec spec;
    spec.machine = static_cast<std::uint16_t>(machine);
    write_module(folder_ / arch / "types.so", spec);
  }
  const std::string boards =
      R"(<board name="x" arch="amd64"/> <board name="y" arch="arm64"/> <board name="z" arch="arm64"/>)";
  EXPECT_THAT(lines_of("<types>${arch}/types.so</types>" + boards, elsewhere), Each(HasSubstr("note: ")));
  EXPECT_THAT(
      lines_of("<types>amd64/types.so</types>" + boards, elsewhere),
      Contains(AllOf(HasSubstr("plant.xml:2:8: error: 'amd64/types.so' is built for x86-64, the board is arm64"))));
  std::filesystem::remove(folder_ / "arm64/types.so");
  const auto missing = lines_of("<types>${arch}/types.so</types>" + boards, elsewhere);
  EXPECT_EQ(std::count_if(missing.begin(), missing.end(),
                          [](const std::string& line) {
                            return line.find("no such file: 'arm64/types.so'") != std::string::npos;
                          }),
            1);
}

}  // namespace
}  // namespace indurop::config
