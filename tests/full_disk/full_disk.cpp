// A disk that is full, for a program that is started with LD_PRELOAD=libfull_disk.so: of the calls that need room in
// the folder FULL_DISK_FOLDER, the one with the number FULL_DISK_FROM fails with ENOSPC, and all that follow; with
// FULL_DISK_ONCE only that one.
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/limits.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

bool is_below(const char* path) {
  const char* folder = std::getenv("FULL_DISK_FOLDER");
  return folder && path && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool is_below(int descriptor) {
  char link[64], path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return false;
  path[size] = '\0';
  return is_below(path);
}

template <class File>
bool has_no_room(File file) {
  static const int from = std::atoi(std::getenv("FULL_DISK_FROM"));
  static const bool once = std::getenv("FULL_DISK_ONCE");
  static std::atomic<int> calls = 0;
  if (!is_below(file)) return false;
  const int call = ++calls;
  if (once ? call != from : call < from) return false;
  errno = ENOSPC;
  return true;
}

template <class Function>
Function next(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// The system's own function, unless there is no room for what it would do to `file`.
#define NEEDS_ROOM(result, name, parameters, arguments, file) \
  extern "C" result name parameters {                         \
    static const auto of_system = next(&name, #name);         \
    return has_no_room(file) ? -1 : of_system arguments;      \
  }

NEEDS_ROOM(ssize_t, write, (int f, const void* from, size_t n), (f, from, n), f)
NEEDS_ROOM(ssize_t, pwrite, (int f, const void* from, size_t n, off_t at), (f, from, n, at), f)
NEEDS_ROOM(ssize_t, pwrite64, (int f, const void* from, size_t n, off64_t at), (f, from, n, at), f)
NEEDS_ROOM(ssize_t, writev, (int f, const iovec* from, int n), (f, from, n), f)
NEEDS_ROOM(ssize_t, sendfile, (int f, int from, off_t* at, size_t n), (f, from, at, n), f)
NEEDS_ROOM(ssize_t, sendfile64, (int f, int from, off64_t* at, size_t n), (f, from, at, n), f)
NEEDS_ROOM(int, fsync, (int f), (f), f)
NEEDS_ROOM(int, fdatasync, (int f), (f), f)
NEEDS_ROOM(int, rename, (const char* from, const char* to), (from, to), to)
NEEDS_ROOM(int, link, (const char* from, const char* to), (from, to), to)
NEEDS_ROOM(int, mkdir, (const char* path, mode_t mode), (path, mode), path)

#define OPENS(name)                                                 \
  extern "C" int name(const char* path, int flags, ...) {           \
    static const auto of_system = next(&name, #name);               \
    va_list rest;                                                   \
    va_start(rest, flags);                                          \
    const mode_t mode = flags & O_CREAT ? va_arg(rest, mode_t) : 0; \
    va_end(rest);                                                   \
    if (flags & O_CREAT && has_no_room(path)) return -1;            \
    return of_system(path, flags, mode);                            \
  }
OPENS(open)
OPENS(open64)
