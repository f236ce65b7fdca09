// SPDX-License-Identifier: Apache-2.0
// Reads module files. The file is not trusted: every offset, size and index is checked against the real size.

#include "core/schema/elf.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <elf.h>

#include "core/base/read_file.h"
#include "core/schema/checked_file.h"
#include "core/schema/kept_notes.h"
#include "core/schema/own_variable.h"
#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

constexpr std::uint64_t kMaxOurSections = std::uint64_t{64} << 20U;
constexpr std::size_t kMaxAccessed = 1'000'000;                     // variables in an access map
constexpr std::uint64_t kMaxNameBytes = std::uint64_t{256} << 20U;  // of all symbol names together

Error corrupt(const char* where) {
  return {Errc::Corrupt, 0, where};
}

Error open_error(const base::FileProblem& problem) {
  constexpr const char* kWhere = "opening the module file";
  if (problem.kind != base::FileProblem::Kind::System) {
    return corrupt("the module file is not a regular file");
  }
  switch (problem.sys_errno) {
    case ENOENT:
    case ENOTDIR:
    case ELOOP:
    case ENAMETOOLONG:
      return {Errc::NotFound, problem.sys_errno, kWhere};
    case EACCES:
    case EPERM:
      return {Errc::PermissionDenied, problem.sys_errno, kWhere};
    default:
      return {Errc::System, problem.sys_errno, kWhere};
  }
}

// Returns the NUL-terminated text at `offset`, or nothing if it starts or ends outside.
std::optional<std::string_view> text_at(std::string_view strings, std::uint64_t offset) {
  if (offset >= strings.size()) {
    return std::nullopt;
  }
  const std::string_view rest = strings.substr(offset);
  const std::size_t end = rest.find('\0');
  return end == std::string_view::npos ? std::nullopt : std::optional(rest.substr(0, end));
}

class Reader {
 public:
  explicit Reader(const CheckedFile& file) : file_(file) {}

  Result<ModuleFile> run() {
    for (const auto step :
         {&Reader::read_header, &Reader::read_segments, &Reader::read_sections, &Reader::read_our_sections,
          &Reader::read_dynamic, &Reader::read_symbols, &Reader::read_variables}) {
      if (const Status status = (this->*step)(); !status.ok()) {
        return status.error();
      }
    }
    return std::move(out_);
  }

  Result<KeptNotes> run_for_notes() {
    for (const auto step : {&Reader::read_header, &Reader::read_sections}) {
      if (const Status status = (this->*step)(); !status.ok()) {
        return status.error();
      }
    }
    KeptNotes notes;
    notes.stripped = section_of_type(SHT_SYMTAB) == nullptr;
    for (const Elf64_Shdr& section : sections_) {
      if (text_at({names_.data(), names_.size()}, section.sh_name).value_or("") == ".indurop.undeclarable") {
        const auto text = section.sh_size <= kMaxOurSections ? contents<char>(section) : std::nullopt;
        notes.undeclarable = text ? std::string(text->begin(), text->end()) : "";
      }
    }
    return notes;
  }

 private:
  Status read_header() {
    unsigned char ident[EI_NIDENT];
    if (!file_.read(0, ident, sizeof ident) || std::memcmp(ident, ELFMAG, SELFMAG) != 0) {
      return corrupt("the module file is not an ELF file");
    }
    if (ident[EI_CLASS] != ELFCLASS64 || ident[EI_DATA] != ELFDATA2LSB) {
      return Error{Errc::Unsupported, 0, "the module file is not a 64-bit little-endian ELF file"};
    }
    if (!file_.read(0, &header_, sizeof header_)) {
      return corrupt("the module file is truncated in its ELF header");
    }
    out_.machine = header_.e_machine;
    return {};
  }

  Status read_segments() {
    if (header_.e_phnum == 0) {
      return {};
    }
    const auto segments = header_.e_phentsize == sizeof(Elf64_Phdr)
                              ? file_.table<Elf64_Phdr>(header_.e_phoff, header_.e_phnum)
                              : std::nullopt;
    if (!segments) {
      return corrupt("the module file's program headers lie outside the file");
    }
    bool dynamic = false;
    bool interpreter = false;
    for (const Elf64_Phdr& segment : *segments) {
      dynamic = dynamic || segment.p_type == PT_DYNAMIC;
      interpreter = interpreter || segment.p_type == PT_INTERP;
      if (segment.p_type == PT_GNU_RELRO) {
        constant_from_ = segment.p_vaddr;
        constant_bytes_ = segment.p_memsz;
      }
      if (segment.p_type == PT_LOAD && !file_.holds(segment.p_offset, segment.p_filesz)) {
        return corrupt("the module file is truncated: a segment ends beyond the file");
      }
    }
    out_.shared_object = header_.e_type == ET_DYN && dynamic && !interpreter;
    return {};
  }

  Status read_sections() {
    if (header_.e_shoff == 0) {
      return {};  // section headers were stripped: nothing is known about variables
    }
    constexpr const char* kOutside = "the module file is truncated: its section headers lie outside the file";
    Elf64_Shdr first{};
    if (header_.e_shentsize != sizeof(Elf64_Shdr) || !file_.read(header_.e_shoff, &first, sizeof first)) {
      return corrupt(kOutside);
    }
    // More than 65279 sections: the numbers are in the first, otherwise empty, section header.
    const std::uint64_t count = header_.e_shnum == 0 ? first.sh_size : header_.e_shnum;
    const std::uint64_t names = header_.e_shstrndx == SHN_XINDEX ? first.sh_link : header_.e_shstrndx;
    auto sections = file_.table<Elf64_Shdr>(header_.e_shoff, count);
    if (!sections) {
      return corrupt(kOutside);
    }
    sections_ = std::move(*sections);
    if (names == SHN_UNDEF) {
      return {};
    }
    auto text = names < sections_.size() ? contents<char>(sections_[names]) : std::nullopt;
    if (!text) {
      return corrupt("the module file's section names lie outside the file");
    }
    names_ = std::move(*text);
    return {};
  }

  // Returns the contents of a section as records; nothing if they are not all in the file.
  template <class T>
  [[nodiscard]] std::optional<std::vector<T>> contents(const Elf64_Shdr& section) const {
    if (section.sh_type == SHT_NOBITS || section.sh_size % sizeof(T) != 0) {
      return std::nullopt;
    }
    return file_.table<T>(section.sh_offset, section.sh_size / sizeof(T));
  }

  Status read_our_sections() {
    const std::string_view names(names_.data(), names_.size());
    std::uint64_t total = 0;
    for (const Elf64_Shdr& section : sections_) {
      const std::string_view name = text_at(names, section.sh_name).value_or("");
      if (name.substr(0, 9) != ".indurop.") {
        continue;
      }
      if ((section.sh_flags & SHF_COMPRESSED) != 0) {
        return Error{Errc::Unsupported, 0, "the module file's .indurop sections are compressed; link without that"};
      }
      total += std::min(section.sh_size, kMaxOurSections + 1);
      if (total > kMaxOurSections) {
        return corrupt("the module file's .indurop sections are larger than any compiler writes");
      }
      if ((name == ".indurop.schema" && !add_schema(section)) || (name == ".indurop.access" && !add_access(section)) ||
          (name == ".indurop.abi" && !add_abi(section))) {
        return corrupt("the module file's .indurop sections are damaged; build it again");
      }
    }
    if (out_.abi == 0) {
      out_.abi = abi_of_json(out_.schema_json);
    }
    return {};
  }

  bool add_schema(const Elf64_Shdr& section) {
    const auto text = contents<char>(section);
    if (!text) {
      return false;
    }
    // Padding between the parts of several object files is NUL.
    for (const char c : *text) {
      const char written = c == '\0' ? '\n' : c;
      const bool blank_line = written == '\n' && (out_.schema_json.empty() || out_.schema_json.back() == '\n');
      if (!blank_line) {
        out_.schema_json += written;
      }
    }
    if (!out_.schema_json.empty() && out_.schema_json.back() != '\n') {
      out_.schema_json += '\n';
    }
    return true;
  }

  bool add_access(const Elf64_Shdr& section) {
    struct Record {
      std::uint32_t low;
      std::uint32_t high;
      std::uint32_t direction;
    };
    const auto records = contents<Record>(section);
    return records && std::all_of(records->begin(), records->end(), [this](const Record& record) {
             Access& access = out_.access[std::uint64_t{record.high} << 32U | record.low];
             access.reads = access.reads || (record.direction & 1U) != 0;
             access.writes = access.writes || (record.direction & 2U) != 0;
             return record.direction >= 1 && record.direction <= 3 && out_.access.size() <= kMaxAccessed;
           });
  }

  bool add_abi(const Elf64_Shdr& section) {
    const auto versions = contents<std::uint32_t>(section);
    return versions && std::all_of(versions->begin(), versions->end(), [this](std::uint32_t version) {
             out_.abi = out_.abi == 0 || out_.abi == version ? version : kMixedAbi;
             return version != 0;
           });
  }

  // Returns the string table that a section refers to.
  [[nodiscard]] std::optional<std::vector<char>> strings_of(const Elf64_Shdr& section) const {
    return section.sh_link < sections_.size() ? contents<char>(sections_[section.sh_link]) : std::nullopt;
  }

  [[nodiscard]] const Elf64_Shdr* section_of_type(std::uint32_t type) const {
    const auto found = std::find_if(sections_.begin(), sections_.end(),
                                    [type](const Elf64_Shdr& section) { return section.sh_type == type; });
    return found == sections_.end() ? nullptr : &*found;
  }

  // Copies a name; returns false if it lies outside, or if all names together are implausibly long.
  bool add_name(std::string_view strings, std::uint64_t offset, std::vector<std::string>& to) {
    const auto name = text_at(strings, offset);
    name_bytes_ += name ? name->size() + sizeof(std::string) : 0;
    if (!name || name_bytes_ > kMaxNameBytes) {
      return false;
    }
    to.emplace_back(*name);
    return true;
  }

  Status read_dynamic() {
    const Elf64_Shdr* section = section_of_type(SHT_DYNAMIC);
    if (section == nullptr) {
      return {};
    }
    const auto entries = contents<Elf64_Dyn>(*section);
    const auto strings = strings_of(*section);
    if (!entries || !strings) {
      return corrupt("the module file's dynamic section lies outside the file");
    }
    for (const Elf64_Dyn& entry : *entries) {
      if (entry.d_tag == DT_NULL) {
        break;
      }
      if (entry.d_tag == DT_FLAGS_1 && (entry.d_un.d_val & DF_1_PIE) != 0) {
        out_.shared_object = false;
      }
      if (entry.d_tag == DT_NEEDED && !add_name({strings->data(), strings->size()}, entry.d_un.d_val, out_.needed)) {
        return corrupt("the module file's list of needed libraries is damaged");
      }
    }
    return {};
  }

  Status read_symbols() {
    const Elf64_Shdr* section = section_of_type(SHT_DYNSYM);
    if (section == nullptr) {
      return {};
    }
    const auto symbols = contents<Elf64_Sym>(*section);
    const auto text = strings_of(*section);
    if (!symbols || !text) {
      return corrupt("the module file's dynamic symbols lie outside the file");
    }
    const std::string_view strings(text->data(), text->size());
    for (const Elf64_Sym& symbol : *symbols) {
      const unsigned bind = ELF64_ST_BIND(symbol.st_info);
      const unsigned type = ELF64_ST_TYPE(symbol.st_info);
      const unsigned visibility = ELF64_ST_VISIBILITY(symbol.st_other);
      const bool global = bind == STB_GLOBAL || bind == STB_WEAK || bind == STB_GNU_UNIQUE;
      const bool visible = visibility == STV_DEFAULT || visibility == STV_PROTECTED;
      const bool function = type == STT_FUNC || type == STT_GNU_IFUNC;
      std::vector<std::string>* list = nullptr;
      if (symbol.st_shndx != SHN_UNDEF && global && visible && function) {
        list = &out_.exports;
      } else if (symbol.st_shndx == SHN_UNDEF && bind == STB_GLOBAL && symbol.st_name != 0) {
        list = &out_.imports;
      }
      if (list != nullptr && !add_name(strings, symbol.st_name, *list)) {
        return corrupt("the module file's dynamic symbol names are damaged");
      }
    }
    for (auto* list : {&out_.exports, &out_.imports}) {  // versions of one name appear once
      sort_once(*list);
    }
    return {};
  }

  static void sort_once(std::vector<std::string>& names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
  }

  // What the linker makes read-only after it has written addresses is no variable.
  [[nodiscard]] bool is_variable(const Elf64_Sym& symbol) const {
    const unsigned bind = ELF64_ST_BIND(symbol.st_info);
    const unsigned type = ELF64_ST_TYPE(symbol.st_info);
    if ((type != STT_OBJECT && type != STT_TLS) || (bind != STB_LOCAL && bind != STB_GLOBAL) || symbol.st_size == 0 ||
        symbol.st_shndx >= sections_.size()) {
      return false;
    }
    const Elf64_Shdr& section = sections_[symbol.st_shndx];
    const bool relocated =
        type != STT_TLS &&  // of these, the section holds initial values only
        (section.sh_addr - constant_from_ < constant_bytes_ ||
         text_at({names_.data(), names_.size()}, section.sh_name).value_or("").starts_with(".data.rel.ro"));
    return (section.sh_flags & (SHF_WRITE | SHF_ALLOC)) == (SHF_WRITE | SHF_ALLOC) && !relocated;
  }

  Status read_variables() {
    const Elf64_Shdr* section = section_of_type(SHT_SYMTAB);
    section = section != nullptr ? section : section_of_type(SHT_DYNSYM);  // a stripped file has only these
    const auto symbols = section != nullptr ? contents<Elf64_Sym>(*section) : std::nullopt;
    const auto text = section != nullptr ? strings_of(*section) : std::nullopt;
    for (std::size_t i = 0; symbols && text && i < symbols->size(); ++i) {
      std::vector<std::string> name;
      if (is_variable((*symbols)[i]) && !add_name({text->data(), text->size()}, (*symbols)[i].st_name, name)) {
        return corrupt("the module file's symbol names are damaged");
      }
      if (auto own = name.empty() ? std::nullopt : own_variable(name.front())) {
        out_.variables.push_back(*std::move(own));
      }
    }
    sort_once(out_.variables);
    return {};
  }

  const CheckedFile& file_;
  Elf64_Ehdr header_{};
  std::vector<Elf64_Shdr> sections_;
  std::vector<char> names_;
  std::uint64_t name_bytes_ = 0;
  std::uint64_t constant_from_ = 0;  // addresses that are constant after loading
  std::uint64_t constant_bytes_ = 0;
  ModuleFile out_;
};

}  // namespace

Result<ModuleFile> read_module_file(const std::filesystem::path& file) {
  auto opened = base::open_file(file);
  if (!opened) {
    return open_error(opened.error());
  }
  const CheckedFile readable(std::move(*opened));
  return Reader(readable).run();
}

Result<KeptNotes> read_kept_notes(const std::filesystem::path& file) {
  auto opened = base::open_file(file);
  if (!opened) {
    return open_error(opened.error());
  }
  const CheckedFile readable(std::move(*opened));
  return Reader(readable).run_for_notes();
}

}  // namespace indurop::schema
