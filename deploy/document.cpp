// SPDX-License-Identifier: Apache-2.0
// The only place with the XML library.

#include "deploy/document.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include <tinyxml2.h>

#include "deploy/xml_places.h"

namespace indurop::deploy {
namespace {

constexpr std::size_t kMaxSize = std::size_t{4} * 1024 * 1024;
constexpr std::string_view kTooLarge =
    "the file is larger than 4 MB; no configuration needs that, is it the right file?";

class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) {
      ::close(fd_);
    }
  }
  [[nodiscard]] int get() const noexcept { return fd_; }

 private:
  int fd_;
};

std::string open_problem(int error, const DocumentKind& kind) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return std::string("no such file; give the path of the ") + kind.name;
    case EACCES:
      return "not allowed to read this file; check its permissions (ls -l)";
    default:
      return std::string("cannot be read: ") + std::strerror(error);
  }
}

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  return first == std::string::npos ? std::string{} : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

// Copies the library's tree. Its elements come in the order of the start tags, so the places are taken one by one.
class Copier {
 public:
  explicit Copier(const XmlPlaces& places) : places_(places) {}

  Element copy(const tinyxml2::XMLElement& from) {
    Element element;
    element.name = from.Name();
    element.place = {from.GetLineNum(), 0};
    const TagPlaces* tag = next_ < places_.tags.size() ? &places_.tags[next_++] : nullptr;
    if (tag != nullptr) {
      element.place = tag->place;
    }
    element.text_place = tag != nullptr && tag->text.line != 0 ? tag->text : element.place;
    std::size_t index = 0;
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next(), ++index) {
      const bool known = tag != nullptr && index < tag->attributes.size();
      element.attributes.push_back({a->Name(), trimmed(a->Value()),
                                    known ? tag->attributes[index].place : element.place,
                                    known ? tag->attributes[index].value : element.place});
    }
    for (const auto* node = from.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (const auto* text = node->ToText()) {
        element.text += text->Value();
      } else if (const auto* child = node->ToElement()) {
        element.children.push_back(copy(*child));
      }
    }
    element.text = trimmed(element.text);
    return element;
  }

 private:
  const XmlPlaces& places_;
  std::size_t next_ = 0;
};

// Other encodings than UTF-8 as their first bytes show them; empty: none.
std::string foreign_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") ||
      bytes.substr(0, 2) == std::string_view("<\0", 2) || bytes.substr(0, 2) == std::string_view("\0<", 2)) {
    return "the file is encoded as UTF-16; save it as UTF-8";
  }
  return {};
}

std::string_view without_mark(std::string_view xml) {
  return xml.starts_with("\xEF\xBB\xBF") ? xml.substr(3) : xml;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file, const DocumentKind& kind, std::string& problem) {
  // Not blocking: a pipe that nobody writes to must not hang us.
  const Descriptor fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (fd.get() < 0 || ::fstat(fd.get(), &status) != 0) {
    problem = open_problem(errno, kind);
    return {};
  }
  if (S_ISDIR(status.st_mode)) {
    problem = std::string("this is a directory; give the path of the ") + kind.name + " in it";
    return {};
  }
  if (!S_ISREG(status.st_mode)) {
    problem = std::string("this is not an ordinary file; give the path of the ") + kind.name;
    return {};
  }
  std::string bytes(kMaxSize + 1, '\0');
  std::size_t used = 0;
  while (used < bytes.size()) {
    const ssize_t got = ::read(fd.get(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got < 0) {
      problem = open_problem(errno, kind);
      return {};
    }
    if (got == 0) {
      break;
    }
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

std::optional<Element> read_document(std::string_view xml, const std::filesystem::path& file, const DocumentKind& kind,
                                     std::vector<Diagnostic>& diagnostics) {
  const auto report = [&](Place place, std::string text) {
    diagnostics.push_back({Diagnostic::Severity::Error, file.string(), place, std::move(text)});
  };
  if (xml.size() > kMaxSize) {
    report({}, std::string(kTooLarge));
    return std::nullopt;
  }
  if (std::string foreign = foreign_encoding(xml); !foreign.empty()) {
    report({1, 1}, std::move(foreign));
    return std::nullopt;
  }
  xml = without_mark(xml);
  if (xml.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    report({1, 1}, std::string("the file is empty; a ") + kind.name + " is " + kind.form);
    return std::nullopt;
  }
  const XmlPlaces places = find_places(xml);
  for (const XmlMistake& mistake : places.mistakes) {
    report(mistake.place, mistake.text);
  }
  if (!places.mistakes.empty()) {
    return std::nullopt;
  }
  const auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(xml.data(), xml.size()) != tinyxml2::XML_SUCCESS || document->RootElement() == nullptr) {
    report({document->ErrorLineNum(), 0}, std::string("not well-formed XML (") + document->ErrorName() +
                                              "); check the tags and quotes around this line");
    return std::nullopt;
  }
  return Copier(places).copy(*document->RootElement());
}

std::string root_name(std::string_view xml) {
  if (xml.size() > kMaxSize) {
    return {};
  }
  const XmlPlaces places = find_places(without_mark(xml));
  return places.tags.empty() ? std::string{} : std::string(places.tags.front().name);
}

}  // namespace indurop::deploy
