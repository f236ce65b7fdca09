// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/page.h"

#include <array>
#include <utility>

#include "core/base/program_folder.h"
#include "core/base/read_file.h"

namespace indurop::serve {
namespace {

constexpr std::string_view kMissing = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>InduRoP</title>
<meta name="viewport" content="width=device-width"></head>
<body style="font-family: sans-serif; max-width: 40em; margin: 2em auto; padding: 0 1em">
<h1>The page is not here</h1>
<p>This server answers programs, but its page was not built. It needs npm: with <code>nodejs</code> and
<code>npm</code> installed, <code>make</code> builds it into <code>share/indurop/web</code>. A page that lies
somewhere else is named with <code>indurop serve --web DIR</code>.</p>
<p>What programs can ask: <a href="/api/v1/openapi.json">openapi.json</a>,
<a href="/api/v1/boards">boards</a>, <a href="/api/v1/status">status</a>.</p>
</body></html>
)";

Reply not_found() {
  return refusal(status::kNotFound, "there is nothing at this path");
}

}  // namespace

bool harmless(std::string_view path) noexcept {
  while (!path.empty()) {
    path.remove_prefix(path.starts_with('/') ? 1 : 0);
    const std::string_view name = path.substr(0, path.find('/'));
    if (name.starts_with('.') || name.find('\\') != std::string_view::npos ||
        name.find('\0') != std::string_view::npos) {
      return false;  // neither "..", nor hidden files
    }
    path.remove_prefix(name.size());
  }
  return true;
}

std::string_view type_of(std::string_view path) noexcept {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kTypes{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".webmanifest", "application/manifest+json"},
      {".txt", "text/plain; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".stl", "model/stl"},
  }};
  for (const auto& [ending, type] : kTypes) {
    if (path.ends_with(ending)) {
      return type;
    }
  }
  return "application/octet-stream";
}

Page::Page(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) {
    const auto programs = base::program_folder();
    std::error_code ignored;
    for (const char* place : {"../share/indurop/web", "../web"}) {
      if (std::filesystem::exists(programs / place / "index.html", ignored)) {
        folder_ = programs / place;
        return;
      }
    }
    folder_ = programs / "../share/indurop/web";
  }
}

bool Page::there() const {
  std::error_code ignored;
  return std::filesystem::exists(folder_ / "index.html", ignored);
}

Reply Page::answer(std::string_view path) const {
  if (!path.starts_with('/') || !harmless(path)) {
    return not_found();
  }
  const std::string_view name = path == "/" ? "index.html" : path.substr(1);
  // Links must not lead out of the folder either.
  std::error_code error;
  const auto root = std::filesystem::canonical(folder_, error);
  const auto file = error ? std::filesystem::path() : std::filesystem::canonical(root / name, error);
  const bool inside = !error && file.string().starts_with(root.string() + "/");
  const auto text = inside ? base::read_file(file) : Result<std::string, base::FileProblem>(base::FileProblem{});
  if (!text) {
    Reply missing = not_found();
    if (path == "/") {
      missing.type = type_of("index.html");
      missing.body = kMissing;
    }
    return missing;
  }
  Reply reply;
  reply.type = type_of(name);
  reply.body = *text;
  reply.immutable = name.starts_with("assets/");
  return reply;
}

}  // namespace indurop::serve
