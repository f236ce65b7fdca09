// SPDX-License-Identifier: Apache-2.0
// Archives with libarchive: written with the same bytes for the same content, as tar with zstd or as ZIP for other
// programs. Both are read, from anybody.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct archive;
struct archive_entry;

namespace indurop::archives {

enum class ArchiveForm { TarZstd, Zip };

// Functions that return false have failed; message() says why.
class ArchiveWriter {
 public:
  ArchiveWriter();
  bool open(const std::filesystem::path& file, ArchiveForm form = ArchiveForm::TarZstd);
  // Begins a member with `size` bytes, which add() gives.
  bool begin(const std::string& member, std::uint64_t size, bool executable = false);
  bool add(std::string_view bytes);
  bool text(const std::string& member, const std::string& text, bool executable = false);
  bool close();
  [[nodiscard]] std::string message() const;

 private:
  std::unique_ptr<archive, int (*)(archive*)> archive_;
};

class ArchiveReader {
 public:
  ArchiveReader();
  bool open(const std::filesystem::path& file, ArchiveForm form = ArchiveForm::TarZstd);
  // Goes to the next member. Returns false at the end and after an error.
  bool next();
  [[nodiscard]] bool failed() const noexcept { return failed_; }
  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool is_executable() const;
  // Returns true for a file with content: no link, folder or device.
  [[nodiscard]] bool is_regular() const;
  // Gives the member's bytes to `use`, at most `limit` of them. Returns false if it is longer or damaged, or if `use`
  // returns false.
  bool read(std::uint64_t limit, const std::function<bool(std::string_view)>& use);
  // Goes to the next member, which must have this name, and returns its content; nothing if it is another one, damaged
  // or longer than `limit`.
  std::optional<std::string> text(const std::string& member, std::uint64_t limit);

 private:
  std::unique_ptr<archive, int (*)(archive*)> archive_;
  archive_entry* entry_ = nullptr;
  bool failed_ = false;
};

}  // namespace indurop::archives
