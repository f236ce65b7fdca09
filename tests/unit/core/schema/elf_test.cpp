// SPDX-License-Identifier: Apache-2.0
// Module files: a real one, and what is left of it after cutting and flipping.

#include "core/schema/elf.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

#include <elf.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/schema/kept_notes.h"
#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

using testing::Contains;
using testing::Not;

// A file in memory that can be rewritten quickly.
class Memory_file {
 public:
  explicit Memory_file(const std::string& bytes) : fd_(memfd_create("module", MFD_CLOEXEC)) { assign(bytes); }
  Memory_file(const Memory_file&) = delete;
  Memory_file& operator=(const Memory_file&) = delete;
  ~Memory_file() { close(fd_); }

  void assign(const std::string& bytes) {
    EXPECT_EQ(ftruncate(fd_, 0), 0);
    EXPECT_EQ(pwrite(fd_, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  void put(std::size_t at, char byte) { EXPECT_EQ(pwrite(fd_, &byte, 1, static_cast<off_t>(at)), 1); }
  void cut(std::size_t length) { EXPECT_EQ(ftruncate(fd_, static_cast<off_t>(length)), 0); }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

class Module_file : public testing::Test {
 protected:
  Module_file() {
    std::ifstream in(SCHEMA_TEST_MODULE, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    bytes_ = all.str();
    EXPECT_GT(bytes_.size(), sizeof(Elf64_Ehdr));
  }

  Errc code_of(const std::string& bytes) {
    const Memory_file file(bytes);
    const auto sut = read_module_file(file.path());
    return sut.ok() ? Errc::Ok : sut.error().code;
  }
  template <class T>
  T& at(std::size_t offset) {
    return *reinterpret_cast<T*>(bytes_.data() + offset);
  }
  void put32(std::size_t offset, std::uint32_t value) { std::memcpy(bytes_.data() + offset, &value, sizeof value); }
  Elf64_Ehdr& header() { return at<Elf64_Ehdr>(0); }
  Elf64_Shdr& section(std::size_t index) { return at<Elf64_Shdr>(header().e_shoff + index * sizeof(Elf64_Shdr)); }
  Elf64_Shdr& section(std::string_view name) {
    const std::size_t names = section(header().e_shstrndx).sh_offset;
    for (std::size_t i = 0; i < header().e_shnum; ++i) {
      if (bytes_.data() + names + section(i).sh_name == name) {
        return section(i);
      }
    }
    ADD_FAILURE() << "no section " << name;
    return section(std::size_t{0});
  }

  std::string bytes_;
};

TEST_F(Module_file, Tells_everything_about_a_real_module) {
  const auto sut = read_module_file(SCHEMA_TEST_MODULE);
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  const ModuleFile& module = sut.value();
  EXPECT_EQ(module.abi, abi::kVersion);
  EXPECT_TRUE(module.shared_object);
  EXPECT_EQ(module.machine, header().e_machine);
  EXPECT_THAT(module.exports, testing::AllOf(Contains("run"), Contains("condition"), Not(Contains("sample_hidden")),
                                             Not(Contains("sample_data")), Not(Contains("sample_import"))));
  EXPECT_THAT(module.imports, testing::AllOf(Contains("sample_import"), Not(Contains("run"))));
  const auto schema = from_json(module.schema_json);
  ASSERT_TRUE(schema.ok());
  ASSERT_EQ(schema.value().variables.size(), 1U);
  EXPECT_EQ(schema.value().variables[0].name, "a::x");
  ASSERT_EQ(module.access.size(), 2U);
  const Access both = module.access.at(0x1122334455667788);
  EXPECT_TRUE(both.reads && both.writes);
  EXPECT_TRUE(module.access.at(7).reads && !module.access.at(7).writes);
}

// Constants, tables of addresses and what the compiler adds are none.
TEST_F(Module_file, Tells_the_variables_that_the_module_may_change) {
  const auto sut = read_module_file(SCHEMA_TEST_MODULE);
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  EXPECT_THAT(sut.value().variables, testing::ElementsAre("Meter::number", "calls", "calls_of_thread", "filtered",
                                                          "sample_data", "untouched"));
}

TEST_F(Module_file, A_stripped_module_tells_only_variables_that_others_may_use) {
  section(".symtab").sh_type = SHT_NULL;
  const Memory_file file(bytes_);
  const auto sut = read_module_file(file.path());
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  EXPECT_THAT(sut.value().variables, testing::ElementsAre("sample_data"));
  EXPECT_TRUE(read_kept_notes(file.path())->stripped);
}

TEST_F(Module_file, Says_what_the_declaration_of_kept_variables_cannot_contain) {
  const auto sut = read_kept_notes(SCHEMA_TEST_MODULE);
  ASSERT_TRUE(sut.ok()) << sut.error().where;
  EXPECT_FALSE(sut->stripped);
  EXPECT_EQ(sut->undeclarable, "table (an array of more than 1000 addresses)");
  EXPECT_FALSE(read_kept_notes("/proc/self/status").ok());
}

TEST_F(Module_file, Programs_and_foreign_libraries_are_distinguished) {
  const auto self = read_module_file("/proc/self/exe");
  ASSERT_TRUE(self.ok());
  EXPECT_FALSE(self.value().shared_object);
  EXPECT_FALSE(self.value().needed.empty());
  EXPECT_TRUE(self.value().access.empty());
}

TEST_F(Module_file, What_is_no_module_file_says_so) {
  const auto code = [](const char* path) {
    const auto sut = read_module_file(path);
    return sut.ok() ? Errc::Ok : sut.error().code;
  };
  EXPECT_EQ(code("/nonexistent/module.so"), Errc::NotFound);
  EXPECT_EQ(code(""), Errc::NotFound);
  EXPECT_EQ(code("/"), Errc::Corrupt);
  EXPECT_EQ(code("/dev/null"), Errc::Corrupt);
  EXPECT_EQ(code_of(""), Errc::Corrupt);
  EXPECT_EQ(code_of("#!/bin/sh\n"), Errc::Corrupt);
  EXPECT_EQ(code_of(ELFMAG), Errc::Corrupt);
  bytes_[EI_CLASS] = ELFCLASS32;
  EXPECT_EQ(code_of(bytes_), Errc::Unsupported);
  bytes_[EI_CLASS] = ELFCLASS64;
  bytes_[EI_DATA] = ELFDATA2MSB;
  EXPECT_EQ(code_of(bytes_), Errc::Unsupported);
}

TEST_F(Module_file, Every_truncation_is_corrupt) {
  Memory_file file(bytes_);
  for (std::size_t length = bytes_.size(); length-- > 0;) {
    file.cut(length);
    const auto sut = read_module_file(file.path());
    ASSERT_FALSE(sut.ok()) << length;
    ASSERT_EQ(sut.error().code, Errc::Corrupt) << length;
  }
}

TEST_F(Module_file, No_flipped_byte_does_harm) {
  Memory_file file(bytes_);
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    for (const char change : {'\x01', '\xFF'}) {
      file.put(at, static_cast<char>(bytes_[at] ^ change));
      const auto sut = read_module_file(file.path());
      const Errc code = sut.ok() ? Errc::Ok : sut.error().code;
      ASSERT_TRUE(code == Errc::Ok || code == Errc::Corrupt || code == Errc::Unsupported) << at;
    }
    file.put(at, bytes_[at]);
  }
}

TEST_F(Module_file, No_heap_of_random_changes_does_harm) {
  std::mt19937 random(20'250'101);  // NOLINT(cert-msc51-cpp): the same changes in every run
  const std::size_t table = header().e_shoff;
  for (int round = 0; round < 1000; ++round) {
    std::string broken = bytes_;
    for (int i = 0; i < 8; ++i) {
      const bool in_table = random() % 2 == 0;
      const std::size_t at = in_table ? table + random() % (bytes_.size() - table) : random() % bytes_.size();
      broken[at] = static_cast<char>(random());
    }
    const Errc code = code_of(broken);
    ASSERT_TRUE(code == Errc::Ok || code == Errc::Corrupt || code == Errc::Unsupported) << round;
  }
}

TEST_F(Module_file, Huge_counts_and_sizes_are_refused) {
  const std::string good = bytes_;
  header().e_shnum = 0;
  section(std::size_t{0}).sh_size = UINT64_MAX / sizeof(Elf64_Shdr);
  EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
  for (const char* name : {".dynsym", ".dynstr", ".dynamic", ".indurop.access", ".indurop.schema", ".indurop.abi"}) {
    for (const std::uint64_t huge : {UINT64_MAX, UINT64_MAX / 24 * 24, std::uint64_t{1} << 40U}) {
      bytes_ = good;
      section(name).sh_size = huge;
      EXPECT_EQ(code_of(bytes_), Errc::Corrupt) << name;
      bytes_ = good;
      section(name).sh_offset = huge;
      EXPECT_EQ(code_of(bytes_), Errc::Corrupt) << name;
    }
  }
  bytes_ = good;
  section(".dynsym").sh_link = UINT32_MAX;
  EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
  bytes_ = good;
  header().e_shstrndx = 60'000;
  EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
}

// A sparse file may really have the size a section claims.
TEST_F(Module_file, Sections_of_a_huge_sparse_file_cost_no_memory) {
  section(".indurop.schema").sh_size = std::uint64_t{1} << 36U;
  section(".indurop.schema").sh_offset = 0;
  Memory_file file(bytes_);
  file.cut(std::size_t{1} << 37U);
  const auto sut = read_module_file(file.path());
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().code, Errc::Corrupt);
}

TEST_F(Module_file, Damaged_access_records_are_refused) {
  const std::string good = bytes_;
  const std::size_t records = section(".indurop.access").sh_offset;
  for (const std::uint32_t direction : {0U, 4U, UINT32_MAX}) {
    bytes_ = good;
    put32(records + 8, direction);
    EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
  }
  bytes_ = good;
  section(".indurop.access").sh_size -= 4;
  EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
}

TEST_F(Module_file, Compressed_sections_of_ours_are_not_guessed_at) {
  section(".indurop.schema").sh_flags |= SHF_COMPRESSED;
  EXPECT_EQ(code_of(bytes_), Errc::Unsupported);
}

TEST_F(Module_file, Abi_of_several_headers_is_mixed) {
  put32(section(".indurop.abi").sh_offset, 0);
  EXPECT_EQ(code_of(bytes_), Errc::Corrupt);
  section(".indurop.abi").sh_offset = section(".indurop.access").sh_offset;
  section(".indurop.abi").sh_size = 8;
  const Memory_file file(bytes_);
  const auto sut = read_module_file(file.path());
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut.value().abi, kMixedAbi);
}

TEST_F(Module_file, Without_section_headers_it_still_is_a_shared_object) {
  header().e_shoff = 0;
  header().e_shnum = 0;
  header().e_shstrndx = 0;
  const Memory_file file(bytes_);
  const auto sut = read_module_file(file.path());
  ASSERT_TRUE(sut.ok());
  EXPECT_TRUE(sut.value().shared_object);
  EXPECT_TRUE(sut.value().schema_json.empty());
}

}  // namespace
}  // namespace indurop::schema
