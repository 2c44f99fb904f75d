/* A library to preload: counts the system calls that change files below a folder, and at one of them the
 * disk fails or the process is killed. Only for tests on Linux with glibc; it knows nothing of Cleave.
 *
 *   FAULT_FOLDER  the folder, without links in its path; nothing is counted without it
 *   FAULT_LOG     every counted call is a line "number call path" of this file; the last line compares all
 *                 writes seen with the number of the system: writes that were not seen are not tested
 *   FAULT_AT      the number of the call at which the fault comes, from 1
 *   FAULT_KIND    kill     killed before the call
 *                 torn     killed after the call; a write has written half
 *                 ENOSPC, EIO  this call fails
 *                 full     this call and all later ones that need space fail
 *                 short    a write writes half, and the next call that needs space fails
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#define REAL(name, type) ((type)dlsym(RTLD_NEXT, name))

enum outcome { PASS, FAIL, HALF, HALF_AND_DIE };

static long calls = 0, writes_seen = 0, at = 0;
static int next_fails = 0, log_file = -1;
static const char *folder = NULL, *kind = "";

__attribute__((constructor)) static void begin(void) {
  const char* text = getenv("FAULT_AT");
  folder = getenv("FAULT_FOLDER");
  at = text ? atol(text) : 0;
  if (getenv("FAULT_KIND")) kind = getenv("FAULT_KIND");
  if (getenv("FAULT_LOG")) {
    log_file = (int)syscall(SYS_openat, AT_FDCWD, getenv("FAULT_LOG"),
                            O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  }
}

static void put_line(const char* line) { syscall(SYS_write, log_file, line, strlen(line)); }

__attribute__((destructor)) static void end(void) {
  char text[1024] = "", line[128];
  const int file = (int)syscall(SYS_openat, AT_FDCWD, "/proc/self/io", O_RDONLY);
  if (log_file < 0) return;
  if (file >= 0 && syscall(SYS_read, file, text, sizeof text - 1) > 0 && strstr(text, "syscw: ")) {
    const long all = atol(strstr(text, "syscw: ") + 7) - calls; /* less the lines of the log */
    snprintf(line, sizeof line, "writes %ld seen %ld\n", all, writes_seen);
    put_line(line);
  }
}

static int inside(const char* path) {
  return folder && strncmp(path, folder, strlen(folder)) == 0 &&
         (path[strlen(folder)] == '/' || path[strlen(folder)] == 0);
}

/* The path of an open file; empty if it has none. */
static const char* path_of(int fd, char* path) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, PATH_MAX - 1);
  path[length > 0 ? length : 0] = 0;
  return path;
}

static const char* absolute(const char* name, char* path) {
  path[0] = 0;
  if (name[0] != '/' && getcwd(path, PATH_MAX)) strcat(path, "/");
  if (strncmp(name, "./", 2) == 0) name += 2;
  strncat(path, name, PATH_MAX - strlen(path) - 1);
  return path;
}

static enum outcome next(const char* call, const char* path, int needs_space, int is_write) {
  if (!inside(path)) return PASS;
  const long number = ++calls;
  if (log_file >= 0) {
    char line[PATH_MAX + 64];
    snprintf(line, sizeof line, "%ld %s %s\n", number, call, path);
    put_line(line);
  }
  if (at == 0 || number < at) return PASS;
  if (strcmp(kind, "full") == 0 || next_fails) {
    errno = ENOSPC;
    if (!needs_space) return PASS;
    if (next_fails) next_fails = 0;
    return FAIL;
  }
  if (number > at) return PASS;
  if (strcmp(kind, "kill") == 0) raise(SIGKILL);
  if (strcmp(kind, "torn") == 0) return HALF_AND_DIE;
  if (strcmp(kind, "short") == 0) {
    next_fails = is_write;
    return is_write ? HALF : PASS;
  }
  errno = strcmp(kind, "EIO") == 0 ? EIO : ENOSPC;
  return FAIL;
}

/* Does a call that is done whole or not at all. */
#define WHOLE(verdict, failure, type, action)  \
  do {                                         \
    const enum outcome asked = (verdict);      \
    if (asked == FAIL) return failure;         \
    type done = (action);                      \
    if (asked == HALF_AND_DIE) raise(SIGKILL); \
    return done;                               \
  } while (0)

/* Does a write, or half of it. */
#define WRITE(call, place, half, action)                \
  do {                                                  \
    const enum outcome asked = next(call, place, 1, 1); \
    if (asked == FAIL) return -1;                       \
    if (asked == PASS) return action;                   \
    const ssize_t done = half;                          \
    if (asked == HALF_AND_DIE) raise(SIGKILL);          \
    return done;                                        \
  } while (0)

ssize_t write(int fd, const void* bytes, size_t count) {
  ssize_t (*real)(int, const void*, size_t) = REAL("write", ssize_t(*)(int, const void*, size_t));
  char path[PATH_MAX];
  ++writes_seen;
  WRITE("write", path_of(fd, path), real(fd, bytes, (count + 1) / 2), real(fd, bytes, count));
}

#define PWRITE(name)                                                            \
  ssize_t name(int fd, const void* bytes, size_t count, off64_t place) {        \
    ssize_t (*real)(int, const void*, size_t, off64_t) =                        \
        REAL(#name, ssize_t(*)(int, const void*, size_t, off64_t));             \
    char path[PATH_MAX];                                                        \
    ++writes_seen;                                                              \
    WRITE("pwrite", path_of(fd, path), real(fd, bytes, (count + 1) / 2, place), \
          real(fd, bytes, count, place));                                       \
  }
PWRITE(pwrite)
PWRITE(pwrite64)

ssize_t writev(int fd, const struct iovec* parts, int count) {
  ssize_t (*real)(int, const struct iovec*, int) =
      REAL("writev", ssize_t(*)(int, const struct iovec*, int));
  char path[PATH_MAX];
  ++writes_seen;
  struct iovec first = parts[0];
  first.iov_len = (first.iov_len + 1) / 2;
  WRITE("writev", path_of(fd, path), real(fd, &first, 1), real(fd, parts, count));
}

#define ON_DESCRIPTOR(name, needs_space)                                                           \
  int name(int fd) {                                                                               \
    char path[PATH_MAX];                                                                           \
    WHOLE(next(#name, path_of(fd, path), needs_space, 0), -1, int, REAL(#name, int (*)(int))(fd)); \
  }
ON_DESCRIPTOR(fsync, 1)
ON_DESCRIPTOR(fdatasync, 1)

/* A close that fails has closed all the same. */
int close(int fd) {
  char path[PATH_MAX];
  const enum outcome outcome = next("close", path_of(fd, path), 0, 0);
  const int error = errno, status = REAL("close", int (*)(int))(fd);
  if (outcome == HALF_AND_DIE) raise(SIGKILL);
  if (outcome != FAIL) return status;
  errno = error;
  return -1;
}

int fclose(FILE* file) {
  char path[PATH_MAX];
  const enum outcome outcome = next("close", path_of(fileno(file), path), 0, 0);
  const int error = errno, status = REAL("fclose", int (*)(FILE*))(file);
  if (outcome == HALF_AND_DIE) raise(SIGKILL);
  if (outcome != FAIL) return status;
  errno = error;
  return EOF;
}

#define SHORTEN(name, by, text)                                                                  \
  int name(by, off64_t size) {                                                                   \
    char path[PATH_MAX];                                                                         \
    WHOLE(next("truncate", text, 0, 0), -1, int, REAL(#name, int (*)(by, off64_t))(file, size)); \
  }
SHORTEN(ftruncate, int file, path_of(file, path))
SHORTEN(ftruncate64, int file, path_of(file, path))
SHORTEN(truncate, const char* file, absolute(file, path))
SHORTEN(truncate64, const char* file, absolute(file, path))

int rename(const char* from, const char* to) {
  char path[PATH_MAX];
  WHOLE(next("rename", absolute(to, path), 1, 0), -1, int,
        REAL("rename", int (*)(const char*, const char*))(from, to));
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  char path[PATH_MAX];
  WHOLE(next("rename", absolute(to, path), 1, 0), -1, int,
        REAL("renameat", int (*)(int, const char*, int, const char*))(from_folder, from, to_folder,
                                                                      to));
}

#define REMOVE(name)                                           \
  int name(const char* file) {                                 \
    char path[PATH_MAX];                                       \
    WHOLE(next("unlink", absolute(file, path), 0, 0), -1, int, \
          REAL(#name, int (*)(const char*))(file));            \
  }
REMOVE(unlink)
REMOVE(remove)

static enum outcome opening(const char* file, int for_writing) {
  char path[PATH_MAX];
  return for_writing ? next("open", absolute(file, path), 1, 0) : PASS;
}

#define OPEN(name)                                                         \
  int name(const char* file, int flags, ...) {                             \
    va_list list;                                                          \
    va_start(list, flags);                                                 \
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;        \
    va_end(list);                                                          \
    WHOLE(opening(file, (flags & O_ACCMODE) != O_RDONLY), -1, int,         \
          REAL(#name, int (*)(const char*, int, ...))(file, flags, mode)); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                                   \
  int name(int where, const char* file, int flags, ...) {                              \
    va_list list;                                                                      \
    va_start(list, flags);                                                             \
    const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;                    \
    va_end(list);                                                                      \
    WHOLE(opening(file, (flags & O_ACCMODE) != O_RDONLY), -1, int,                     \
          REAL(#name, int (*)(int, const char*, int, ...))(where, file, flags, mode)); \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                                      \
  FILE* name(const char* file, const char* mode) {                       \
    WHOLE(opening(file, strpbrk(mode, "wa+") != NULL), NULL, FILE*,      \
          REAL(#name, FILE* (*)(const char*, const char*))(file, mode)); \
  }
FOPEN(fopen)
FOPEN(fopen64)
