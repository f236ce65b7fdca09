// SPDX-License-Identifier: Apache-2.0
// FMUs as archives, also from people who mean no good.
#include "control/io/fmu/fmu_file.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "core/archives/archive.h"
#include "core/base/read_file.h"

namespace indurop::io::fmu {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FmuFileTest : public ::testing::Test {
 protected:
  FmuFileTest() {
    std::string name = (fs::temp_directory_path() / "fmu-file-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::create_directory(to());
  }
  ~FmuFileTest() override { fs::remove_all(folder_); }

  static std::string description() { return base::read_file(std::string(LAG) + "/lag3.xml").value(); }
  [[nodiscard]] fs::path to() const { return folder_ / "inside" / ""; }
  [[nodiscard]] fs::path archive(const std::vector<std::pair<std::string, std::string>>& members) const {
    const fs::path file = folder_ / "x.fmu";
    archives::ArchiveWriter writer;
    EXPECT_TRUE(writer.open(file, archives::ArchiveForm::Zip));
    for (const auto& [name, text] : members) {
      EXPECT_TRUE(writer.text(name, text, name.ends_with(".so"))) << writer.message();
    }
    EXPECT_TRUE(writer.close());
    return file;
  }
  [[nodiscard]] std::vector<std::string> everything() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) {
        found.push_back(fs::relative(entry.path(), folder_).string());
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  fs::path folder_;
};

TEST_F(FmuFileTest, Is_described_and_unpacked) {
  const fs::path file = archive({{"modelDescription.xml", description()},
                                 {"binaries/x86_64-linux/lag.so", "library"},
                                 {"binaries/x86_64-windows/lag.dll", "library"},
                                 {"resources/deep/data.txt", "data"}});
  const FmuFile fmu = read_fmu(file);
  EXPECT_EQ(base::to_text(fmu.diagnostics), "");
  EXPECT_EQ(fmu.description.model, "lag");
  EXPECT_THAT(fmu.platforms, ::testing::ElementsAre("x86_64-linux", "x86_64-windows"));
  ASSERT_TRUE(unpack_fmu(file, to()));
  EXPECT_THAT(everything(),
              ::testing::ElementsAre("inside/binaries/x86_64-linux/lag.so", "inside/binaries/x86_64-windows/lag.dll",
                                     "inside/modelDescription.xml", "inside/resources/deep/data.txt", "x.fmu"));
  EXPECT_EQ(base::read_file(to() / "resources/deep/data.txt").value(), "data");
}

TEST_F(FmuFileTest, Says_which_platforms_it_has) {
  const FmuFile other = read_fmu(archive(
      {{"modelDescription.xml", description()}, {"binaries/x86_64-windows/lag.dll", ""}, {"sources/lag.c", ""}}));
  EXPECT_THAT(missing_library(other), HasSubstr("it has x86_64-windows. Export it for Linux, or compile its sources"));
  const FmuFile none = read_fmu(archive({{"modelDescription.xml", description()}}));
  EXPECT_THAT(missing_library(none), HasSubstr("it has none. Export it for Linux"));
}

TEST_F(FmuFileTest, Nothing_is_written_outside_of_the_folder) {
  for (const char* name : {"../evil", "/tmp/indurop-evil", "a/../../evil", "a/../b", "..", "a\\..\\evil"}) {
    const auto unpacked = unpack_fmu(archive({{"good", "1"}, {name, "2"}}), to());
    ASSERT_FALSE(unpacked) << name;
    EXPECT_THAT(unpacked.error(), HasSubstr("would be written outside of its folder")) << name;
    fs::remove(to() / "good");
    EXPECT_THAT(everything(), ::testing::ElementsAre("x.fmu")) << name;
    EXPECT_FALSE(fs::exists("/tmp/indurop-evil"));
  }
  EXPECT_THAT(unpack_fmu(archive({{"a", "1"}, {"a", "2"}}), to()).error(), HasSubstr("is there twice"));
  fs::remove(to() / "a");
  EXPECT_THAT(unpack_fmu(archive({{"a", "1"}, {"a/b", "2"}}), to()).error(), HasSubstr("cannot be written"));
}

TEST_F(FmuFileTest, Says_what_is_no_FMU) {
  std::ofstream(folder_ / "text") << "text";
  EXPECT_THAT(base::to_text(read_fmu(folder_ / "text").diagnostics), HasSubstr("is no ZIP archive"));
  EXPECT_THAT(base::to_text(read_fmu(folder_ / "nothing").diagnostics), HasSubstr("no such file"));
  EXPECT_THAT(base::to_text(read_fmu(folder_).diagnostics), HasSubstr("no such file"));
  EXPECT_THAT(base::to_text(read_fmu(archive({{"a", "b"}})).diagnostics), HasSubstr("has no modelDescription.xml"));
}

TEST_F(FmuFileTest, Any_bytes_are_read) {
  const fs::path file = archive({{"modelDescription.xml", description()}, {"binaries/x86_64-linux/lag.so", "library"}});
  const std::string whole = base::read_file(file).value();
  std::mt19937 random(2);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same bytes in every run
  for (int i = 0; i < 150; ++i) {
    std::string bytes = whole;
    for (std::size_t k = 0; k < 1 + random() % 8; ++k) {
      // The headers are at the ends of members and of the file.
      const std::size_t at = random() % 2 == 0 ? random() % bytes.size() : bytes.size() - 1 - random() % 200;
      bytes[at] = static_cast<char>(random());
    }
    bytes.resize(random() % 4 == 0 ? random() % bytes.size() : bytes.size());
    std::ofstream(file, std::ios::binary) << bytes;
    (void)read_fmu(file);
    (void)unpack_fmu(file, to());
    fs::remove_all(to());
    fs::create_directory(to());
    ASSERT_THAT(everything(), ::testing::ElementsAre("x.fmu"));
  }
}

}  // namespace
}  // namespace indurop::io::fmu
