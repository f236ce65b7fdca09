// SPDX-License-Identifier: Apache-2.0
#include "node/modules/module_library.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <utility>

#include "core/base/read_file.h"
#include "core/keys/digest.h"

namespace indurop::node {
namespace {

// Returns how many libraries the dynamic linker has unloaded since the program began.
unsigned long long unloaded_libraries() noexcept {
  unsigned long long count = 0;
  (void)::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t /*size*/, void* to) {
        *static_cast<unsigned long long*>(to) = info->dlpi_subs;
        return 1;
      },
      &count);
  return count;
}

// The dynamic linker shares the globals between all that load the same file; a copy without a name is another file.
int copy_to_memory(const std::filesystem::path& file) {
  const int from = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0) {
    return -1;
  }
  const int to = ::memfd_create(file.filename().c_str(), MFD_CLOEXEC);
  struct stat info {};
  bool ok = to >= 0 && ::fstat(from, &info) == 0;
  for (off_t done = 0; ok && done < info.st_size;) {
    const ssize_t n = ::sendfile(to, from, &done, static_cast<std::size_t>(info.st_size - done));
    ok = n > 0;
  }
  ::close(from);
  if (!ok && to >= 0) {
    ::close(to);
  }
  return ok ? to : -1;
}

// Leaves the process most of the files that it may open: then there is none to keep.
int open_to_keep(const std::filesystem::path& file) {
  constexpr int kHighest = 512;
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened >= kHighest) {
    ::close(opened);
    return -1;
  }
  return opened;
}

// What the linker has made read-only after it wrote addresses is not written.
bool is_read_only_now(const dl_phdr_info& info, std::uintptr_t page, std::uintptr_t page_bytes) {
  return std::any_of(info.dlpi_phdr, info.dlpi_phdr + info.dlpi_phnum, [&](const ElfW(Phdr) & part) {
    const std::uintptr_t begin = info.dlpi_addr + part.p_vaddr;
    return part.p_type == PT_GNU_RELRO && page + page_bytes > begin && page < begin + part.p_memsz;
  });
}

// AddressSanitizer forbids what it has put between variables.
__attribute__((no_sanitize("address"))) void touch(const dl_phdr_info& info) {
  const auto page_bytes = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  for (const ElfW(Phdr) & part : std::span(info.dlpi_phdr, info.dlpi_phnum)) {
    const std::uintptr_t begin = info.dlpi_addr + part.p_vaddr;
    for (std::uintptr_t page = begin - begin % page_bytes; part.p_type == PT_LOAD && page < begin + part.p_memsz;
         page += page_bytes) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr): the dynamic linker states numbers
      auto* const byte = reinterpret_cast<unsigned char*>(std::max(page, begin));
      if ((part.p_flags & PF_W) != 0 && !is_read_only_now(info, page, page_bytes)) {
        (void)__atomic_fetch_or(byte, 0, __ATOMIC_RELAXED);
      } else if ((part.p_flags & PF_R) != 0) {
        (void)*static_cast<const volatile unsigned char*>(byte);
      }
    }
  }
}

template <class Function>
Function symbol(void* handle, const char* plain, const char* mangled) {
  void* found = ::dlsym(handle, plain);
  return reinterpret_cast<Function>(found != nullptr ? found : ::dlsym(handle, mangled));
}

}  // namespace

Result<void, base::Problem> ModuleLibrary::load(const std::filesystem::path& file, bool own_copy) {
  file_ = file;
  mark_ = mark_of(file);
  std::string path = file.string();
  if (own_copy) {
    opened_ = copy_to_memory(file);
    if (opened_ < 0) {
      return base::Problem{fmt::format("cannot copy {}: {}", file.string(), std::strerror(errno))};
    }
    path = fmt::format("/proc/self/fd/{}", opened_);
  } else {
    opened_ = open_to_keep(file);
  }
  handle_ = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    const char* reason = ::dlerror();
    return base::Problem{fmt::format(
        "cannot load the module: {}; if a symbol is undefined, link the library that defines it into the module",
        reason != nullptr ? reason : "unknown reason")};
  }
  if (const auto digest = keys::digest_of_file(path)) {
    digest_ = digest->digest;
  }
  find_functions();
  if (functions_.run == nullptr) {
    return base::Problem{
        "the module has no run function: add INDUROP_MODULE(run = &::yourFunction) or define `void run()`"};
  }
  return {};
}

void ModuleLibrary::find_functions() {
  if (auto describe = reinterpret_cast<void (*)(StateDescriptor*)>(::dlsym(handle_, "indurop_module_state"));
      describe != nullptr) {
    StateDescriptor declared;
    describe(&declared);
    memory_ = ModuleMemory(declared);
  }
  using Describe = void (*)(ModuleDescriptor*);
  if (auto describe = reinterpret_cast<Describe>(::dlsym(handle_, "indurop_module_describe")); describe != nullptr) {
    describe(&functions_);
    return;
  }
  using Plain = void (*)();
  functions_.run = symbol<Plain>(handle_, "run", "_Z3runv");
  functions_.start = symbol<Plain>(handle_, "start", "_Z5startv");
  functions_.stop = symbol<Plain>(handle_, "stop", "_Z4stopv");
  if (auto condition = symbol<int (*)()>(handle_, "condition", "_Z9conditionv"); condition != nullptr) {
    functions_.condition = condition;
  }
}

const void* ModuleLibrary::inside() const noexcept {
  link_map* map = nullptr;
  return handle_ != nullptr && ::dlinfo(handle_, RTLD_DI_LINKMAP, &map) == 0 ? map->l_ld : nullptr;
}

void ModuleLibrary::prefault() const {
  link_map* map = nullptr;
  if (handle_ != nullptr && ::dlinfo(handle_, RTLD_DI_LINKMAP, &map) == 0) {
    ::dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t /*size*/, void* wanted) {
          if (info->dlpi_addr == static_cast<const link_map*>(wanted)->l_addr) {
            touch(*info);
          }
          return 0;
        },
        map);
  }
}

// Another thread may load the next version meanwhile, to the same address; then the linker has counted the unloading.
bool ModuleLibrary::unload() {
  const void* const address = inside();
  Dl_info before{};
  (void)::dladdr(address, &before);
  const auto unloaded_before = unloaded_libraries();
  *this = ModuleLibrary();
  Dl_info after{};
  return address == nullptr || ::dladdr(address, &after) == 0 || after.dli_fbase != before.dli_fbase ||
         unloaded_libraries() != unloaded_before;
}

void ModuleLibrary::abandon() noexcept {
  handle_ = nullptr;
  opened_ = -1;
}

Result<std::string, base::Problem> ModuleLibrary::content() const {
  auto content = base::read_file(fmt::format("/proc/self/fd/{}", opened_));
  if (!content) {
    return base::Problem{base::cannot_read(file_, content.error())};
  }
  if (keys::digest_of(*content) != digest_) {
    return base::Problem{fmt::format("{} was overwritten after it was loaded; replace it instead", file_.string())};
  }
  return *std::move(content);
}

bool ModuleLibrary::is_outdated() const {
  return handle_ != nullptr && mark_of(file_) != mark_;
}

ModuleLibrary::ModuleLibrary(ModuleLibrary&& other) noexcept
    : file_(std::move(other.file_)),
      digest_(std::move(other.digest_)),
      mark_(other.mark_),
      handle_(std::exchange(other.handle_, nullptr)),
      opened_(std::exchange(other.opened_, -1)),
      number_(other.number_),
      functions_(other.functions_),
      memory_(std::move(other.memory_)),
      uses_(std::move(other.uses_)) {}

ModuleLibrary& ModuleLibrary::operator=(ModuleLibrary&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(digest_, other.digest_);
  std::swap(mark_, other.mark_);
  std::swap(handle_, other.handle_);
  std::swap(opened_, other.opened_);
  std::swap(number_, other.number_);
  std::swap(functions_, other.functions_);
  std::swap(memory_, other.memory_);
  std::swap(uses_, other.uses_);
  return *this;
}

ModuleLibrary::~ModuleLibrary() {
  if (handle_ != nullptr) {
    ::dlclose(handle_);
  }
  if (opened_ >= 0) {
    ::close(opened_);
  }
}

}  // namespace indurop::node
