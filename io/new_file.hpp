// Files that appear whole or not at all, and reach the disk: temporary name, fsync, rename.
//
// Only names and durability; what is in a file is its writer's business.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace cleave::io {

// "path: cannot <operation>: <text of the system error>; <what to do>" as io::Error.
[[noreturn]] void throw_system_error(const std::string& path, std::string_view operation,
                                     int error);

// A new file under construction. Until commit() it exists as temporary_path() (`path`.part) and
// a file at `path` stays as it is; without commit() the destructor removes the temporary.
// If `path` is a symbolic link, the file it leads to is replaced, not the link.
class NewFile {
 public:
  // Throws if something at `path` is not a regular file (a folder, a device). Nothing is opened.
  explicit NewFile(const std::string& path);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();

  const std::string& temporary_path() const { return temporary_path_; }
  // Renames to the final name, and flushes the folder, so that the name survives a loss of power.
  // What is in the file is flushed by sync_file.
  void commit();

 private:
  std::string path_, temporary_path_;
  bool committed_ = false;
};

// Waits until the file's contents are on the disk.
void sync_file(const std::string& path);
// The same, and forgets the memory copy where the system allows, so that reading tests the disk.
void sync_file_and_drop_cache(const std::string& path);

std::int64_t file_size(const std::string& path);
void set_file_size(const std::string& path, std::int64_t bytes);
// Old contents are lost.
void create_empty_file(const std::string& path);
// The file must exist.
void append_to_file(const std::string& path, std::string_view text);

}  // namespace cleave::io
