// SPDX-License-Identifier: Apache-2.0
// The writer of archives: the same bytes for the same content, so members have no times and owners.
#include "core/archives/archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <cstring>

namespace indurop::archives {
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
  // The warning says that a name is not ASCII: no locale is set to translate it from, so it is written as it is.
  const int code = ::archive_write_header(archive_.get(), entry.get());
  return code == ARCHIVE_OK || code == ARCHIVE_WARN;
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
  const int error = ::archive_errno(archive_.get());
  const std::string reason =
      error > 0 ? std::string(": ") + std::strerror(error) : std::string();  // it says only "Write error"
  return (text == nullptr ? "unknown error" : text) + reason;
}

}  // namespace indurop::archives
