// SPDX-License-Identifier: Apache-2.0
#include "core/archives/archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <vector>

namespace indurop::archives {
namespace {

constexpr std::size_t kPortionBytes = std::size_t{1} << 18U;

}  // namespace

ArchiveWriter::ArchiveWriter() : archive_(::archive_write_new(), &::archive_write_free) {}

bool ArchiveWriter::open(const std::filesystem::path& file, ArchiveForm form) {
  const bool has_form = form == ArchiveForm::Zip
                            ? ::archive_write_set_format_zip(archive_.get()) == ARCHIVE_OK
                            : ::archive_write_set_format_pax_restricted(archive_.get()) == ARCHIVE_OK &&
                                  ::archive_write_add_filter_zstd(archive_.get()) == ARCHIVE_OK;
  return has_form && ::archive_write_open_filename(archive_.get(), file.c_str()) == ARCHIVE_OK;
}

bool ArchiveWriter::begin(const std::string& member, std::uint64_t size, bool executable) {
  const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(::archive_entry_new(), &::archive_entry_free);
  ::archive_entry_set_pathname(entry.get(), member.c_str());
  ::archive_entry_set_size(entry.get(), static_cast<std::int64_t>(size));
  ::archive_entry_set_filetype(entry.get(), AE_IFREG);
  ::archive_entry_set_perm(entry.get(), executable ? 0755 : 0644);
  ::archive_entry_set_mtime(entry.get(), 0, 0);
  return ::archive_write_header(archive_.get(), entry.get()) == ARCHIVE_OK;
}

bool ArchiveWriter::add(std::string_view bytes) {
  return ::archive_write_data(archive_.get(), bytes.data(), bytes.size()) == static_cast<la_ssize_t>(bytes.size());
}

bool ArchiveWriter::text(const std::string& member, const std::string& text, bool executable) {
  return begin(member, text.size(), executable) && add(text);
}

bool ArchiveWriter::close() {
  return ::archive_write_close(archive_.get()) == ARCHIVE_OK;
}

std::string ArchiveWriter::message() const {
  const char* text = ::archive_error_string(archive_.get());
  return text == nullptr ? "unknown error" : text;
}

ArchiveReader::ArchiveReader() : archive_(::archive_read_new(), &::archive_read_free) {}

bool ArchiveReader::open(const std::filesystem::path& file, ArchiveForm form) {
  const bool has_form = form == ArchiveForm::Zip ? ::archive_read_support_format_zip(archive_.get()) == ARCHIVE_OK
                                                 : ::archive_read_support_format_tar(archive_.get()) == ARCHIVE_OK &&
                                                       ::archive_read_support_filter_zstd(archive_.get()) == ARCHIVE_OK;
  return has_form && ::archive_read_open_filename(archive_.get(), file.c_str(), kPortionBytes) == ARCHIVE_OK;
}

bool ArchiveReader::next() {
  const int code = ::archive_read_next_header(archive_.get(), &entry_);
  failed_ = code != ARCHIVE_OK && code != ARCHIVE_EOF;
  return code == ARCHIVE_OK;
}

std::string ArchiveReader::name() const {
  const char* name = ::archive_entry_pathname(entry_);
  return name == nullptr ? "" : name;
}

bool ArchiveReader::is_executable() const {
  return (::archive_entry_perm(entry_) & 0100) != 0;
}

bool ArchiveReader::is_regular() const {
  return ::archive_entry_filetype(entry_) == AE_IFREG && ::archive_entry_hardlink(entry_) == nullptr;
}

bool ArchiveReader::read(std::uint64_t limit, const std::function<bool(std::string_view)>& use) {
  std::vector<char> portion(kPortionBytes);
  for (;;) {
    const la_ssize_t got = ::archive_read_data(archive_.get(), portion.data(), portion.size());
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
