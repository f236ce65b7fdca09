// SPDX-License-Identifier: Apache-2.0
// Writes module files as a compiler would, as far as they are read before they are loaded.

#pragma once

#include <elf.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/schema/elf.h"
#include "core/schema/schema.h"

namespace indurop::config {

#if defined(__aarch64__)
inline constexpr std::uint16_t kThisMachine = EM_AARCH64;
#else
inline constexpr std::uint16_t kThisMachine = EM_X86_64;
#endif

struct ModuleSpec {
  bool program = false;  // else a shared library
  std::uint16_t machine = kThisMachine;
  std::uint32_t abi = abi::kVersion;  // 0: none
  std::vector<std::string> exports{"indurop_module_describe"};
  std::vector<std::string> imports{};
  schema::Schema schema{};
  std::vector<std::string> reads{};
  std::vector<std::string> writes{};
};

class ElfWriter {
 public:
  explicit ElfWriter(const ModuleSpec& spec) : spec_(spec) {}

  std::string bytes() {
    file_.assign(sizeof(Elf64_Ehdr) + 2 * sizeof(Elf64_Phdr), '\0');
    section("", SHT_NULL, "", 0);
    const std::string symbols = symbol_table();
    section(".dynstr", SHT_STRTAB, strings_, 0);
    section(".dynsym", SHT_DYNSYM, symbols, sizeof(Elf64_Sym));
    section(".dynamic", SHT_DYNAMIC, std::string(sizeof(Elf64_Dyn), '\0'), sizeof(Elf64_Dyn));
    if (!spec_.schema.variables.empty() || !spec_.schema.functions.empty() || !spec_.schema.pools.empty()) {
      section(".indurop.schema", SHT_PROGBITS, schema::to_json(spec_.schema) + "\n", 0);
    }
    section(".indurop.access", SHT_PROGBITS, access_records(), 0);
    if (spec_.abi != 0) {
      section(".indurop.abi", SHT_PROGBITS, raw(spec_.abi), 0);
    }
    finish();
    return file_;
  }

 private:
  template <class T>
  static std::string raw(const T& value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
  }

  std::string symbol_table() {
    std::string table = raw(Elf64_Sym{});
    strings_ = std::string(1, '\0');
    const auto add = [&](const std::string& name, std::uint16_t where) {
      Elf64_Sym symbol{};
      symbol.st_name = static_cast<std::uint32_t>(strings_.size());
      symbol.st_info = ELF64_ST_INFO(STB_GLOBAL, STT_FUNC);
      symbol.st_shndx = where;
      strings_ += name + '\0';
      table += raw(symbol);
    };
    for (const std::string& name : spec_.exports) {
      add(name, 1);
    }
    for (const std::string& name : spec_.imports) {
      add(name, SHN_UNDEF);
    }
    return table;
  }

  std::string access_records() const {
    std::string records;
    const auto add = [&records](const std::string& name, std::uint32_t direction) {
      records += raw(abi::fnv1a64(name.data(), name.size())) + raw(direction);
    };
    for (const std::string& name : spec_.reads) {
      add(name, 1);
    }
    for (const std::string& name : spec_.writes) {
      add(name, 2);
    }
    return records;
  }

  void section(const std::string& name, std::uint32_t type, const std::string& contents, std::uint64_t entry) {
    file_.resize((file_.size() + 7) / 8 * 8, '\0');
    Elf64_Shdr header{};
    header.sh_name = static_cast<std::uint32_t>(names_.size());
    header.sh_type = type;
    header.sh_offset = file_.size();
    header.sh_size = contents.size();
    header.sh_link = 1;  // .dynstr
    header.sh_entsize = entry;
    names_ += name + '\0';
    file_ += contents;
    sections_.push_back(header);
  }

  void finish() {
    section(".shstrtab", SHT_STRTAB, names_ + ".shstrtab" + '\0', 0);
    sections_.back().sh_name = static_cast<std::uint32_t>(names_.size() - sizeof ".shstrtab");
    file_.resize((file_.size() + 7) / 8 * 8, '\0');
    Elf64_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS64;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_ident[EI_VERSION] = EV_CURRENT;
    header.e_type = ET_DYN;
    header.e_machine = spec_.machine;
    header.e_ehsize = sizeof header;
    header.e_phoff = sizeof header;
    header.e_phentsize = sizeof(Elf64_Phdr);
    header.e_phnum = spec_.program ? 2 : 1;
    header.e_shoff = file_.size();
    header.e_shentsize = sizeof(Elf64_Shdr);
    header.e_shnum = static_cast<std::uint16_t>(sections_.size());
    header.e_shstrndx = static_cast<std::uint16_t>(sections_.size() - 1);
    Elf64_Phdr dynamic{};
    dynamic.p_type = PT_DYNAMIC;
    Elf64_Phdr interpreter{};
    interpreter.p_type = PT_INTERP;
    file_.replace(0, sizeof header, raw(header));
    file_.replace(sizeof header, 2 * sizeof(Elf64_Phdr), raw(dynamic) + raw(interpreter));
    for (const Elf64_Shdr& s : sections_) {
      file_ += raw(s);
    }
  }

  const ModuleSpec& spec_;
  std::string file_;
  std::string names_;
  std::string strings_;
  std::vector<Elf64_Shdr> sections_;
};

inline void write_module(const std::filesystem::path& file, const ModuleSpec& spec) {
  std::ofstream(file, std::ios::binary) << ElfWriter(spec).bytes();
  ::chmod(file.c_str(), 0755);
}

// A folder for module files that disappears with the test.
class ModuleFolder {
 public:
  ModuleFolder() {
    char name[] = "/tmp/indurop-check-XXXXXX";
    path_ = ::mkdtemp(name);
  }
  ModuleFolder(const ModuleFolder&) = delete;
  ModuleFolder& operator=(const ModuleFolder&) = delete;
  ~ModuleFolder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// double name; the .glb file only matters in messages.
inline schema::Variable variable(const std::string& name, schema::Base base = schema::Base::Double,
                                 const std::string& source = "knuRobot.glb:3") {
  schema::Variable v;
  v.name = name;
  v.type.base = base;
  v.type.element_size = base == schema::Base::Float || base == schema::Base::Int32 ? 4 : 8;
  v.type.align = v.type.element_size;
  v.kind = abi::Kind::Scalar;
  v.type_hash = schema::hash_of(v.type);
  v.source = source;
  return v;
}

}  // namespace indurop::config
