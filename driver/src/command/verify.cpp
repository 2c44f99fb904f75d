#include "command/verify.hpp"

#include <chrono>
#include <filesystem>
#include <set>
#include <vector>

#include "command/table_text.hpp"
#include "deck/deck.hpp"
#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/netcdf_layout.hpp"
#include "io/new_file.hpp"
#include "io/record_summary.hpp"
#include "io/results.hpp"
#include "run/checkpoint.hpp"
#include "run/checkpoint_files.hpp"
#include "run/progress.hpp"
#include "scene/format.hpp"

namespace cleave::driver {
namespace fs = std::filesystem;
namespace {

std::string file_of(const std::string& path) { return fs::path(path).filename().string(); }

// A file that lost its header is judged by its name.
bool is_checkpoint(const std::string& path) {
  if (file_of(path).find(FileNames::kCheckpointEnding) != std::string::npos) return true;
  try {
    const io::NetcdfLayout layout = io::read_netcdf_layout(path);
    return !layout.variables.empty() && layout.variables.front().name == "header_checksum";
  } catch (const io::Error&) {
    return false;
  }
}

std::vector<std::string> damage_of(const std::string& path, const VerifySay& say) {
  using WallClock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kBetweenLines{2};
  WallClock::time_point last = WallClock::now();
  return io::archive_damage(path, [&](std::int64_t done, std::int64_t all) {
    if (!say || WallClock::now() - last < kBetweenLines) return;
    last = WallClock::now();
    say(path + ": " + bytes_text(done) + " of " + bytes_text(all) + " read");
  });
}

Verification verify_checkpoint(const std::string& path, const VerifySay& say) {
  const std::vector<std::string> damage = damage_of(path, say);
  if (damage.empty()) {
    return {true, path + ": verified: the header and " +
                      std::to_string(io::read_archive_header(path).arrays.size()) + " arrays, " +
                      bytes_text(io::file_size(path)) + ", agree with their checksums\n"};
  }
  std::string text;
  for (const std::string& line : damage) text += line + '\n';
  return {false, text + path + ": broken\n"};
}

// "12 frames" of a results file, "340 records" of a table. Throws io::Error for other files.
std::string contents(const std::string& path) {
  try {
    return std::to_string(io::summarise_results(path).times.size()) + " frames";
  } catch (const io::Error&) {
    return std::to_string(io::summarise_records(path).records) + " records";
  }
}

Verification verify_series(const std::string& path) {
  std::string what;
  try {
    what = contents(path);
  } catch (const io::Error& error) {
    return {false, std::string(error.what()) + '\n' + path +
                       ": broken, or none of the files that a run writes in netCDF\n"};
  }
  const io::NetcdfLayout layout = io::read_netcdf_layout(path);
  if (layout.found_bytes != layout.promised_bytes) {
    return {false, path + ": is " + std::to_string(layout.found_bytes) +
                       " bytes long, its header promises " + std::to_string(layout.promised_bytes) +
                       "; a restart cuts it back to its checkpoint and goes on from there\n"};
  }
  return {true, path + ": complete: " + what + ", " + bytes_text(layout.found_bytes) +
                    ", as its header promises; these files carry no checksums, so values that "
                    "changed on the disk are not found\n"};
}

struct State {
  bool good;
  std::string text;
};

State state_of(const std::string& path, const VerifySay& say) {
  const std::vector<std::string> damage = damage_of(path, say);
  if (!damage.empty()) return {false, "broken: " + damage.front()};
  const std::string why_not = why_not_continued(io::read_archive_header(path).attributes);
  return {true, why_not.empty() ? "verified" : "verified, but " + why_not};
}

std::string attribute_text(const std::string& path, const char* name) {
  try {
    const io::ArchiveHeader header = io::read_archive_header(path);
    const io::AttributeValue* value = header.find_attribute(name);
    if (value == nullptr) return "-";
    if (const auto* real = std::get_if<double>(value)) return number(*real);
    if (const auto* integer = std::get_if<std::int64_t>(value)) return number(*integer);
    return std::get<std::string>(*value);
  } catch (const io::Error&) {
    return "-";
  }
}

// Newest first; the last good states of failed runs after them.
std::vector<std::string> checkpoints_in(const std::string& directory) {
  std::vector<std::string> paths;
  const std::vector<CheckpointFile> files = checkpoint_files(directory);
  for (auto file = files.rbegin(); file != files.rend(); ++file) paths.push_back(file->path);
  std::set<std::string> others;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string ending = std::string(".lastgood") + FileNames::kCheckpointEnding;
    if (entry.path().filename().string().ends_with(ending)) others.insert(entry.path().string());
  }
  paths.insert(paths.end(), others.begin(), others.end());
  return paths;
}

}  // namespace

Verification verify_file(const std::string& path, const VerifySay& say) {
  return is_checkpoint(path) ? verify_checkpoint(path, say) : verify_series(path);
}

Verification verify_directory(const std::string& path, const VerifySay& say) {
  const std::vector<std::string> files = checkpoints_in(path);
  if (files.empty()) {
    throw DeckError(path + ": no checkpoint here (NAME.STEP" + FileNames::kCheckpointEnding +
                    "); name the directory of a run, or a file");
  }
  Verification all{true, path + ": " + std::to_string(files.size()) +
                             (files.size() == 1 ? " checkpoint" : " checkpoints, newest first") +
                             "\n\n"};
  TextTable table{{"checkpoint", "after step", "time", "size", "state"}, {}};
  for (const std::string& file : files) {
    const State state = state_of(file, say);
    all.good = all.good && state.good;
    table.rows.push_back({file_of(file), attribute_text(file, "step"), attribute_text(file, "time"),
                          bytes_text(io::file_size(file)), state.text});
  }
  all.text += to_text(table);
  return all;
}

}  // namespace cleave::driver
