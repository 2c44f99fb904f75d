#include "io/record_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <utility>
#include <vector>

#include "io/new_file.hpp"

namespace cleave::io {
namespace {

constexpr std::int64_t kRecordsOffset = 4;            // behind "CDF" and the version
constexpr std::size_t kBlock = std::size_t{1} << 17;  // values converted at a time: 1 MiB

// Most significant byte first.
void put_big_endian(std::uint64_t value, int bytes, char* target) {
  for (int i = 0; i < bytes; ++i) {
    target[i] = static_cast<char>(static_cast<unsigned char>(value >> (8 * (bytes - 1 - i))));
  }
}

std::uint64_t big_endian(std::uint64_t value) {
  return std::endian::native == std::endian::big ? value : __builtin_bswap64(value);
}

}  // namespace

RecordFile::RecordFile(const std::string& path, const NetcdfLayout& layout)
    : path_(path),
      version_(layout.version),
      record_begin_(layout.record_begin),
      record_bytes_(layout.record_bytes),
      fd_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
  if (fd_ < 0) throw_system_error(path_, "open the file for writing", errno);
}

RecordFile::~RecordFile() {
  if (fd_ >= 0) ::close(fd_);
}

void RecordFile::write_bytes(std::int64_t place, std::span<const char> bytes) {
  if (::lseek(fd_, place, SEEK_SET) < 0) throw_system_error(path_, "write to the file", errno);
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_system_error(path_, "write to the file", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

template <class T>
void RecordFile::write_words(std::int64_t place, std::span<const T> values) {
  words_.resize(std::max(words_.size(), std::min(values.size(), kBlock)));
  for (std::size_t first = 0; first < values.size(); first += kBlock) {
    const std::span<const T> part = values.subspan(first, std::min(kBlock, values.size() - first));
    std::transform(part.begin(), part.end(), words_.begin(),
                   [](T value) { return big_endian(std::bit_cast<std::uint64_t>(value)); });
    const auto* bytes = reinterpret_cast<const char*>(words_.data());
    write_bytes(place + static_cast<std::int64_t>(8 * first), std::span(bytes, 8 * part.size()));
  }
}

void RecordFile::write(std::int64_t place, std::span<const std::uint64_t> values) {
  write_words(place, values);
}

void RecordFile::write(std::int64_t place, std::span<const double> values) {
  write_words(place, values);
}

void RecordFile::set_length(std::int64_t records) {
  if (record_bytes_ > 0) set_file_size(path_, record_begin_ + records * record_bytes_);
}

void RecordFile::set_records(std::int64_t records) {
  const int bytes = version_ == 5 ? 8 : 4;
  char raw[8] = {};
  put_big_endian(static_cast<std::uint64_t>(records), bytes, raw);
  write_bytes(kRecordsOffset, std::span<const char>(raw, static_cast<std::size_t>(bytes)));
}

void RecordFile::close() {
  if (::close(std::exchange(fd_, -1)) != 0) throw_system_error(path_, "close the file", errno);
}

}  // namespace cleave::io
