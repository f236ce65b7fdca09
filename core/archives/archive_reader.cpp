// SPDX-License-Identifier: Apache-2.0
// libarchive brings forty megabytes of other libraries, which a node in real time would lock in memory only because its
// checks can read FMUs. So it is loaded when the first archive is read.

#include <archive.h>
#include <archive_entry.h>
#include <dlfcn.h>

#include <vector>

#include "core/archives/archive.h"

namespace indurop::archives {
namespace {

constexpr std::size_t kPortionBytes = std::size_t{1} << 18U;
constexpr const char* kLibrary = "libarchive.so.13";

struct Functions {
  bool loaded = true;
  decltype(&::archive_read_new) read_new = nullptr;
  decltype(&::archive_read_free) read_free = nullptr;
  decltype(&::archive_read_support_format_tar) format_tar = nullptr;
  decltype(&::archive_read_support_format_zip) format_zip = nullptr;
  decltype(&::archive_read_support_filter_zstd) filter_zstd = nullptr;
  decltype(&::archive_read_open_filename) open = nullptr;
  decltype(&::archive_read_next_header) next = nullptr;
  decltype(&::archive_read_data) read = nullptr;
  decltype(&::archive_entry_pathname) pathname = nullptr;
  decltype(&::archive_entry_perm) perm = nullptr;
  decltype(&::archive_entry_filetype) filetype = nullptr;
  decltype(&::archive_entry_hardlink) hardlink = nullptr;
};

template <class Function>
void find(Functions& all, void* library, Function& function, const char* name) {
  function = library == nullptr ? nullptr : reinterpret_cast<Function>(::dlsym(library, name));
  all.loaded = all.loaded && function != nullptr;
}

Functions load() {
  void* const library = ::dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  Functions all;
  find(all, library, all.read_new, "archive_read_new");
  find(all, library, all.read_free, "archive_read_free");
  find(all, library, all.format_tar, "archive_read_support_format_tar");
  find(all, library, all.format_zip, "archive_read_support_format_zip");
  find(all, library, all.filter_zstd, "archive_read_support_filter_zstd");
  find(all, library, all.open, "archive_read_open_filename");
  find(all, library, all.next, "archive_read_next_header");
  find(all, library, all.read, "archive_read_data");
  find(all, library, all.pathname, "archive_entry_pathname");
  find(all, library, all.perm, "archive_entry_perm");
  find(all, library, all.filetype, "archive_entry_filetype");
  find(all, library, all.hardlink, "archive_entry_hardlink");
  return all;
}

const Functions& functions() {
  static const Functions kFunctions = load();
  return kFunctions;
}

int free_reader(archive* reader) {
  // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): where there is a reader, there are functions
  return reader == nullptr ? ARCHIVE_OK : functions().read_free(reader);
}

}  // namespace

ArchiveReader::ArchiveReader() : archive_(functions().loaded ? functions().read_new() : nullptr, &free_reader) {}

bool ArchiveReader::open(const std::filesystem::path& file, ArchiveForm form) {
  if (archive_ == nullptr) {
    return false;
  }
  const bool has_form = form == ArchiveForm::Zip ? functions().format_zip(archive_.get()) == ARCHIVE_OK
                                                 : functions().format_tar(archive_.get()) == ARCHIVE_OK &&
                                                       functions().filter_zstd(archive_.get()) == ARCHIVE_OK;
  return has_form && functions().open(archive_.get(), file.c_str(), kPortionBytes) == ARCHIVE_OK;
}

bool ArchiveReader::next() {
  // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): where there is a reader, there are functions
  const int code = functions().next(archive_.get(), &entry_);
  failed_ = code != ARCHIVE_OK && code != ARCHIVE_EOF;
  return code == ARCHIVE_OK;
}

std::string ArchiveReader::name() const {
  const char* name = functions().pathname(entry_);
  return name == nullptr ? "" : name;
}

bool ArchiveReader::is_executable() const {
  // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): where there is a reader, there are functions
  return (functions().perm(entry_) & 0100) != 0;
}

bool ArchiveReader::is_regular() const {
  return functions().filetype(entry_) == AE_IFREG && functions().hardlink(entry_) == nullptr;
}

bool ArchiveReader::read(std::uint64_t limit, const std::function<bool(std::string_view)>& use) {
  std::vector<char> portion(kPortionBytes);
  for (;;) {
    const la_ssize_t got = functions().read(archive_.get(), portion.data(), portion.size());
    if (got <= 0) {
      return got == 0;
    }
    const auto size = static_cast<std::uint64_t>(got);
    if (size > limit || !use(std::string_view(portion.data(), size))) {
      return false;
    }
    limit -= size;
  }
}

std::optional<std::string> ArchiveReader::text(const std::string& member, std::uint64_t limit) {
  std::string text;
  const bool whole = next() && name() == member && is_regular() && read(limit, [&](std::string_view bytes) {
                       text += bytes;
                       return true;
                     });
  return whole ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace indurop::archives
