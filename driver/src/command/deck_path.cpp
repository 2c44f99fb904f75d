#include "command/deck_path.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "deck/deck.hpp"
#include "deck/nearest_name.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDeckEnding = ".nml";

std::vector<std::string> files_ending_in(const std::string& ending, const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(directory, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ending) names.push_back(at->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string hint(const fs::path& path) {
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(directory, error))
    return " There is no directory \"" + directory.string() + "\".";
  const std::string ending = path.has_extension() ? path.extension().string() : kDeckEnding;
  const std::vector<std::string> names = files_ending_in(ending, directory);
  if (names.empty()) return " There is no " + ending + " file in \"" + directory.string() + "\".";
  std::string nearest = nearest_name(path.filename().string(), names);
  if (nearest.empty()) nearest = nearest_name(path.filename().string() + ending, names);
  if (!nearest.empty())
    return " Did you mean \"" +
           (path.has_parent_path() ? directory / nearest : fs::path(nearest)).string() + "\"?";
  constexpr std::size_t kMostShown = 10;
  const std::size_t shown = std::min(kMostShown, names.size());
  return " There are: " +
         listed({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown)}) +
         (shown < names.size() ? " and more." : ".");
}

}  // namespace

std::string existing_file(const std::string& path, const std::string& what) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw DeckError("\"" + path + "\" is a directory; wanted is " + what + "." +
                    hint(fs::path(path) / ""));
  return existing_path(path, what);
}

std::string existing_path(const std::string& path, const std::string& what) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  throw DeckError("cannot find " + what + " \"" + path + "\"." + hint(path));
}

}  // namespace cleave::driver
