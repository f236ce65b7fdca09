// SPDX-License-Identifier: Apache-2.0
// A module is replaced with its own FMU: the rest of the configuration has the values of the complete one, bit for bit.
// The model acts from one run to the next, as the module does with what it keeps, so nothing is delayed.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <indurop/testing.h>

#include <bit>
#include <fstream>
#include <optional>

#include "tests/integration/fmi/fmu.h"
#include "tests/integration/fmi/model.h"

namespace indurop::fmi {
namespace {

using irp::testing::Plant;

const std::string kTwoBoards = TWO_BOARDS;

std::string module_text(const std::string& file, int priority, const std::string& more = {}) {
  return fmt::format(
      "<module><filename>{}</filename><moduletype>thread</moduletype><operationtype>periodic"
      "</operationtype><period>1ms</period><priority>{}</priority>{}</module>\n",
      file, priority, more);
}

// The turning table as an FMU, and configurations with and without it.
class FmuExported : public ::testing::TestWithParam<int> {
 protected:
  FmuExported() : model_(device(table())) {
    io_ = module_text(IO_MODULE, 1, R"(<property><value name="config">ioconfig.xml</value></property>)");
  }

  static std::filesystem::path write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
    return file;
  }
  // What the board with the table does, and the controller.
  std::filesystem::path one_board(const std::string& name, const std::string& table) const {
    return write(model_.folder() / name, "<root>" + table + module_text(kTwoBoards + "/controller.so", 2) + "</root>");
  }
  std::filesystem::path two_boards(const std::string& name, const std::string& table) const {
    return write(model_.folder() / name, "<plant name=\"two\"><board name=\"sensor\">" + table +
                                             "</board><board name=\"control\">" +
                                             module_text(kTwoBoards + "/controller.so", 1) + "</board></plant>");
  }

  static ::testing::AssertionResult equal(const Plant& plant, const Plant& complete, const std::string& name) {
    const auto found = plant.get<double>(name);
    const auto expected = complete.get<double>(name);
    return std::bit_cast<std::uint64_t>(found) == std::bit_cast<std::uint64_t>(expected)
               ? ::testing::AssertionSuccess()
               : ::testing::AssertionFailure() << name << " is " << found << ", in the complete plant " << expected;
  }

  const std::string& io() const { return io_; }
  static std::string table_module() { return module_text(kTwoBoards + "/table.so", 1); }

 private:
  std::string table() {
    const std::filesystem::path project = std::filesystem::temp_directory_path() / fmt::format("table-{}", GetParam());
    std::filesystem::create_directories(project);
    std::filesystem::copy_file(kTwoBoards + "/table.so", project / "table.so",
                               std::filesystem::copy_options::overwrite_existing);
    write(project / "module.xml", "<root>" + module_text("./table.so", 1) + "</root>");
    fmu_.emplace(project, "module.xml", GetParam());
    std::filesystem::remove_all(project);
    return fmu_->archive().string();
  }
  static std::string device(const std::string& fmu) {
    return fmt::format(R"(<device name="table" driver="fmu" file="{}">
      <output variable="cell::torque" at="cell::torque"/>
      <input variable="cell::encoder.angle" at="cell::encoder.angle"/>
      <input variable="cell::encoder.speed" at="cell::encoder.speed"/>
      <input variable="cell::encoder.count" at="cell::encoder.count"/></device>)",
                       fmu);
  }

  std::optional<Fmu> fmu_;
  Model model_;
  std::string io_;
};

TEST_P(FmuExported, On_one_board_nothing_is_delayed) {
  Plant complete(one_board("complete.xml", table_module()));
  Plant plant(one_board("model.xml", io()));
  for (int tick = 0; tick < 500; ++tick) {
    if (tick == 200) {
      complete.set("cell::target", -3.5);
      plant.set("cell::target", -3.5);
    }
    complete.step();
    plant.step();
    for (const char* name : {"cell::encoder.angle", "cell::encoder.speed", "cell::torque"}) {
      ASSERT_TRUE(equal(plant, complete, name)) << "after tick " << tick << "\n" << plant.printed();
    }
    ASSERT_EQ(plant.get<int>("cell::encoder.count") + 1, complete.get<int>("cell::encoder.count"))
        << "the model has run once less: at the first tick it has its initial values";
  }
  EXPECT_LT(plant.get<double>("cell::encoder.speed"), -3) << "something has happened";
}

TEST_P(FmuExported, On_two_boards_nothing_is_delayed_either) {
  Plant complete(two_boards("complete.xml", table_module()));
  Plant plant(two_boards("model.xml", io() + module_text(CELL_READER, 2)));
  for (int tick = 0; tick < 500; ++tick) {
    complete.step();
    plant.step();
    for (const char* name : {"cell::encoder.angle@sensor", "cell::encoder.speed@sensor", "cell::encoder.speed@control",
                             "cell::torque@sensor", "cell::torque@control"}) {
      ASSERT_TRUE(equal(plant, complete, name)) << "after tick " << tick << "\n" << plant.printed();
    }
  }
  EXPECT_NEAR(plant.get<double>("cell::encoder.speed@control"), 2, 0.1) << "something has happened";
}

INSTANTIATE_TEST_SUITE_P(Fmi, FmuExported, ::testing::Values(2, 3));

}  // namespace
}  // namespace indurop::fmi
