#include "run/checkpoint_files.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include "io/error.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace fs = std::filesystem;
namespace {

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

// NAME.STEP from NAME.STEP.checkpoint.nc; false for other files, NAME.lastgood... among them.
bool parse_name(const std::string& name, CheckpointFile& file) {
  const std::string ending = FileNames::kCheckpointEnding;
  if (!ends_with(name, ending)) return false;
  const std::string stem = name.substr(0, name.size() - ending.size());
  const auto dot = stem.rfind('.');
  if (dot == std::string::npos) return false;
  const char* begin = stem.data() + dot + 1;
  const char* end = stem.data() + stem.size();
  const auto [stop, error] = std::from_chars(begin, end, file.step);
  if (error != std::errc{} || stop != end || begin == end) return false;
  file.base = stem.substr(0, dot);
  return true;
}

// Removes what is called NAME.STEP.checkpoint.nc and `ending`, of this run.
void remove_with_ending(const FileNames& names, const std::string& ending) {
  std::error_code ignored;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(names.directory, ignored)) {
    const std::string name = entry.path().filename().string();
    CheckpointFile file;
    if (ends_with(name, ending) && parse_name(name.substr(0, name.size() - ending.size()), file) &&
        file.base == names.base) {
      found.push_back(entry.path());
    }
  }
  for (const fs::path& path : found) fs::remove(path, ignored);
}

io::ArchiveHeader verified_header(const std::string& path) {
  io::verify_archive(path);
  return io::read_archive_header(path);
}

}  // namespace

std::vector<CheckpointFile> checkpoint_files(const fs::path& directory) {
  std::vector<CheckpointFile> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored)) {
    CheckpointFile file;
    if (!parse_name(entry.path().filename().string(), file)) continue;
    file.path = entry.path().string();
    files.push_back(file);
  }
  std::sort(files.begin(), files.end(), [](const CheckpointFile& a, const CheckpointFile& b) {
    return std::pair(a.step, a.base) < std::pair(b.step, b.base);
  });
  return files;
}

void remove_half_written(const FileNames& names) { remove_with_ending(names, ".part"); }

std::vector<CheckpointFile> checkpoints_of(const FileNames& names) {
  std::vector<CheckpointFile> files = checkpoint_files(names.directory);
  std::erase_if(files, [&](const CheckpointFile& file) { return file.base != names.base; });
  return files;
}

void remove_oldest(const FileNames& names, std::int64_t step, std::int64_t keep) {
  std::vector<CheckpointFile> files = checkpoints_of(names);
  std::erase_if(files, [&](const CheckpointFile& file) { return file.step > step; });
  for (auto file = files.begin(); files.end() - file > keep; ++file) {
    std::error_code ignored;  // a checkpoint that cannot be removed does no harm
    fs::remove(file->path, ignored);
  }
}

void set_aside(const FileNames& names) {
  const std::vector<CheckpointFile> files = checkpoints_of(names);
  if (files.empty()) return;
  const std::string ending = ".previous";
  std::error_code ignored;
  remove_with_ending(names, ending);
  for (const CheckpointFile& file : files) fs::rename(file.path, file.path + ending, ignored);
}

Loaded load_checkpoint(const std::string& file_or_directory) {
  if (!fs::is_directory(file_or_directory)) {
    return {file_or_directory, verified_header(file_or_directory), {}};
  }
  const std::vector<CheckpointFile> files = checkpoint_files(file_or_directory);
  const std::string pattern = std::string("NAME.STEP") + FileNames::kCheckpointEnding;
  if (files.empty()) {
    throw DeckError(file_or_directory + ": no checkpoint here (" + pattern +
                    "); name the directory of the run, or a checkpoint file");
  }
  std::set<std::string> bases;
  for (const CheckpointFile& file : files) bases.insert(file.base);
  if (bases.size() > 1) {
    throw DeckError(file_or_directory + ": checkpoints of several runs are here (" +
                    list({bases.begin(), bases.end()}) + "); name one checkpoint file");
  }
  Loaded loaded;
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    try {
      loaded.archive = verified_header(file->path);
      loaded.path = file->path;
      return loaded;
    } catch (const io::Error& error) {
      loaded.skipped.push_back(file->path + ": " + error.what());
    }
  }
  throw DeckError(file_or_directory + ": no checkpoint verifies:\n  " + list(loaded.skipped) +
                  "\nStart the run again");
}

}  // namespace cleave::driver
