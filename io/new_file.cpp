#include "io/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "io/error.hpp"

namespace cleave::io {
namespace {

namespace fs = std::filesystem;

std::string_view remedy(int error) {
  switch (error) {
    case ENOSPC:
      return "free space on that disk or write to another one";
    case EDQUOT:
      return "your quota is used up: remove files or write to another disk";
    case EFBIG:
      return "the file size limit is reached: see 'ulimit -f', or write to another disk";
    case EACCES:
    case EPERM:
      return "check the permissions of the file and its folder";
    case EROFS:
      return "that disk is read-only: write to another one";
    case ENOENT:
      return "check the name, and that its folder exists";
    case ENOTDIR:
      return "a part of the path is a file, not a folder: check the name";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EIO:
      return "the disk reports a fault: write to another one and have it checked";
    default:
      return "check the file, its folder and the disk";
  }
}

// A file descriptor that is closed on every way out.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags, std::string_view operation = "open the file")
      : path_(path), fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
    if (fd_ < 0) throw_system_error(path, operation, errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int number() const { return fd_; }
  void close() {
    const int fd = fd_;
    fd_ = -1;
    if (::close(fd) != 0) throw_system_error(path_, "close the file", errno);
  }

 private:
  std::string path_;
  int fd_;
};

// The file that a chain of symbolic links leads to, whether it exists or not.
std::string resolve_links(fs::path path) {
  // The limit of Linux; a longer chain is a loop, which open() reports.
  constexpr int kMostLinks = 40;
  std::error_code ignored;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, ignored); ++i) {
    path = path.parent_path() / fs::read_symlink(path, ignored);
  }
  return path.string();
}

void sync_folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY);
  // EINVAL: a file system that cannot flush folders; there is nothing more to be done then.
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL) {
    throw_system_error(folder, "flush the folder to disk", errno);
  }
}

}  // namespace

void throw_system_error(const std::string& path, std::string_view operation, int error) {
  throw Error(path + ": cannot " + std::string(operation) + ": " +
              std::generic_category().message(error) + "; " + std::string(remedy(error)));
}

NewFile::NewFile(const std::string& path) : path_(resolve_links(path)) {
  struct stat status {};
  if (path_.empty()) throw Error("cannot write a file without a name; give one");
  if (::stat(path_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw Error(path_ + ": cannot be replaced: it is " +
                (S_ISDIR(status.st_mode) ? "a folder" : "not a regular file") +
                "; choose another name");
  }
  temporary_path_ = path_ + ".part";
}

NewFile::~NewFile() {
  if (!committed_) ::unlink(temporary_path_.c_str());
}

void NewFile::commit() {
  if (::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    throw_system_error(path_, "give the finished file its name", errno);
  }
  committed_ = true;
  sync_folder_of(path_);
}

void sync_file(const std::string& path) {
  Descriptor descriptor(path, O_RDONLY);
  if (::fsync(descriptor.number()) != 0) throw_system_error(path, "flush the file to disk", errno);
  descriptor.close();
}

void sync_file_and_drop_cache(const std::string& path) {
  Descriptor descriptor(path, O_RDONLY);
  if (::fsync(descriptor.number()) != 0) throw_system_error(path, "flush the file to disk", errno);
  ::posix_fadvise(descriptor.number(), 0, 0, POSIX_FADV_DONTNEED);  // advice: may be refused
  descriptor.close();
}

std::int64_t file_size(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw_system_error(path, "read the file", errno);
  if (!S_ISREG(status.st_mode)) {
    throw Error(path + ": cannot read the file: it is " +
                (S_ISDIR(status.st_mode) ? "a folder" : "not a regular file") + "; check the name");
  }
  return status.st_size;
}

void set_file_size(const std::string& path, std::int64_t bytes) {
  if (::truncate(path.c_str(), bytes) != 0) throw_system_error(path, "shorten the file", errno);
}

void create_empty_file(const std::string& path) {
  Descriptor(path, O_WRONLY | O_CREAT | O_TRUNC, "create the file").close();
}

void append_to_file(const std::string& path, std::string_view text) {
  Descriptor descriptor(path, O_WRONLY | O_APPEND);
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor.number(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_system_error(path, "write to the file", errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  descriptor.close();
}

}  // namespace cleave::io
