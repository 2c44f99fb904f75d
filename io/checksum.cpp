// CRC-64/XZ by eight tables: eight bytes a step ("slicing by eight").
#include "io/checksum.hpp"

#include <array>
#include <bit>

namespace cleave::io {
namespace {

constexpr std::uint64_t kPolynomial = 0xC96C5795D7870F42;  // ECMA-182, bits reversed

// tables[k][b]: what byte b, followed by k zero bytes, adds to the remainder.
using Tables = std::array<std::array<std::uint64_t, 256>, 8>;

constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint64_t b = 0; b < 256; ++b) {
    std::uint64_t r = b;
    for (int bit = 0; bit < 8; ++bit) r = (r >> 1) ^ ((r & 1) != 0 ? kPolynomial : 0);
    tables[0][b] = r;
  }
  for (std::size_t k = 1; k < 8; ++k) {
    for (std::size_t b = 0; b < 256; ++b) {
      const std::uint64_t r = tables[k - 1][b];
      tables[k][b] = (r >> 8) ^ tables[0][r & 0xff];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

std::uint64_t add_word(std::uint64_t remainder, std::uint64_t word) {
  const std::uint64_t x = remainder ^ word;
  return kTables[7][x & 0xff] ^ kTables[6][(x >> 8) & 0xff] ^ kTables[5][(x >> 16) & 0xff] ^
         kTables[4][(x >> 24) & 0xff] ^ kTables[3][(x >> 32) & 0xff] ^
         kTables[2][(x >> 40) & 0xff] ^ kTables[1][(x >> 48) & 0xff] ^ kTables[0][x >> 56];
}

template <class T>
std::uint64_t crc64_of_words(std::span<const T> values, std::uint64_t previous) {
  std::uint64_t remainder = ~previous;
  for (const T& value : values) {
    remainder = add_word(remainder, std::bit_cast<std::uint64_t>(value));
  }
  return ~remainder;
}

}  // namespace

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t previous) {
  std::uint64_t remainder = ~previous;
  for (const std::byte byte : bytes) {
    const std::uint64_t index = (remainder ^ std::to_integer<std::uint64_t>(byte)) & 0xff;
    remainder = (remainder >> 8) ^ kTables[0][index];
  }
  return ~remainder;
}

std::uint64_t crc64(std::span<const double> values, std::uint64_t previous) {
  return crc64_of_words(values, previous);
}

std::uint64_t crc64(std::span<const std::int64_t> values, std::uint64_t previous) {
  return crc64_of_words(values, previous);
}

std::string checksum_text(std::uint64_t checksum) {
  std::string text = "crc64:";
  for (int shift = 60; shift >= 0; shift -= 4)
    text += "0123456789abcdef"[(checksum >> shift) & 0xf];
  return text;
}

}  // namespace cleave::io
