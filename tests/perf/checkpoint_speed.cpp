// Speed of writing and of verifying one checkpoint, in the folder given: CHECKPOINT FOLDER REPEATS.
// Prints size and the medians of the times; checkpoint_cost.py makes the checkpoint and relates them
// to a run. Judges nothing.
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "io/archive.hpp"
#include "io/new_file.hpp"

namespace {

template <class Work>
double median_seconds(int repeats, Work work) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

int measure(const std::string& checkpoint, const std::string& folder, int repeats) {
  const cleave::io::Archive archive = cleave::io::read_archive(checkpoint);
  const std::string path = (std::filesystem::path(folder) / "speed.checkpoint.nc").string();
  const double write = median_seconds(repeats, [&] { cleave::io::write_archive(path, archive); });
  const double verify = median_seconds(repeats, [&] {
    cleave::io::sync_file_and_drop_cache(path);
    cleave::io::verify_archive(path);
  });
  const auto bytes = static_cast<double>(cleave::io::file_size(path));
  std::filesystem::remove(path);
  std::printf("bytes %.0f\nwrite %.6g\nverify %.6g\n", bytes, write, verify);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  int repeats = 0;
  if (argc == 4) std::from_chars(argv[3], argv[3] + std::strlen(argv[3]), repeats);
  if (repeats < 1) {
    std::fputs("usage: checkpoint_speed CHECKPOINT FOLDER REPEATS\n", stderr);
    return 2;
  }
  try {
    return measure(argv[1], argv[2], repeats);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
