// CRC-64/XZ by eight tables, eight bytes a step ("slicing by eight"), and where the processor has
// carry-less products by folding, 64 bytes a step. Both give the same number.
#include "io/checksum.hpp"

#include <array>
#include <bit>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

std::uint64_t add_bytes(std::uint64_t remainder, std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    const std::uint64_t index = (remainder ^ std::to_integer<std::uint64_t>(byte)) & 0xff;
    remainder = (remainder >> 8) ^ kTables[0][index];
  }
  return remainder;
}

#if defined(__x86_64__)
// Folding by carry-less products. Bit i of a word is the coefficient of x^(63-i), as in the tables; a
// product of two words then lacks one factor x, which the constants carry.

constexpr std::uint64_t power_of_x(int n) {  // x^n modulo the polynomial
  std::uint64_t r = std::uint64_t{1} << 63;
  for (; n > 0; --n) r = (r >> 1) ^ ((r & 1) != 0 ? kPolynomial : 0);
  return r;
}

#define CLEAVE_CARRYLESS __attribute__((target("pclmul,sse2")))

CLEAVE_CARRYLESS __m128i load(const std::byte* from) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

// value x^distance + next; `factors` are x^(distance + 63) for the word of higher powers, the lower
// half, and x^(distance - 1) for the other.
CLEAVE_CARRYLESS __m128i fold(__m128i value, __m128i factors, __m128i next) {
  return _mm_xor_si128(next, _mm_xor_si128(_mm_clmulepi64_si128(value, factors, 0x00),
                                           _mm_clmulepi64_si128(value, factors, 0x11)));
}

CLEAVE_CARRYLESS __m128i factors_for(std::uint64_t lower, std::uint64_t upper) {
  return _mm_set_epi64x(std::bit_cast<long long>(upper), std::bit_cast<long long>(lower));
}

constexpr std::size_t kStride = 64;  // four registers of 16 bytes at a time

// As add_bytes, for all whole strides of `bytes`, of which there is at least one.
CLEAVE_CARRYLESS std::uint64_t add_strides(std::uint64_t remainder,
                                           std::span<const std::byte> bytes) {
  constexpr int kFar = 512, kNear = 128;  // bits from one stride, one register, to the next
  constexpr std::uint64_t kFarLower = power_of_x(kFar + 63), kFarUpper = power_of_x(kFar - 1);
  constexpr std::uint64_t kNearLower = power_of_x(kNear + 63), kNearUpper = power_of_x(kNear - 1);
  const __m128i far = factors_for(kFarLower, kFarUpper);
  const __m128i near = factors_for(kNearLower, kNearUpper);
  const std::byte* from = bytes.data();
  __m128i a = _mm_xor_si128(load(from), factors_for(remainder, 0));
  __m128i b = load(from + 16), c = load(from + 32), d = load(from + 48);
  for (std::size_t left = bytes.size() / kStride - 1; left > 0; --left) {
    from += kStride;
    a = fold(a, far, load(from));
    b = fold(b, far, load(from + 16));
    c = fold(c, far, load(from + 32));
    d = fold(d, far, load(from + 48));
  }
  const __m128i all = fold(fold(fold(a, near, b), near, c), near, d);
  std::array<std::uint64_t, 2> words{};
  std::memcpy(words.data(), &all, sizeof all);
  return add_word(add_word(0, words[0]), words[1]);
}
#undef CLEAVE_CARRYLESS

bool can_fold() {
  static const bool can = __builtin_cpu_supports("pclmul") != 0;
  return can;
}
#endif

template <class T>
std::uint64_t crc64_of_words(std::span<const T> values, std::uint64_t previous) {
  if constexpr (std::endian::native == std::endian::little)
    return crc64(std::as_bytes(values), previous);
  std::uint64_t remainder = ~previous;
  for (const T& value : values) {
    remainder = add_word(remainder, std::bit_cast<std::uint64_t>(value));
  }
  return ~remainder;
}

}  // namespace

std::uint64_t crc64_by_tables(std::span<const std::byte> bytes, std::uint64_t previous) {
  std::uint64_t remainder = ~previous;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    std::uint64_t word = 0;
    for (std::size_t k = 8; k-- > 0;) word = word << 8 | std::to_integer<std::uint64_t>(bytes[k]);
    remainder = add_word(remainder, word);
  }
  return ~add_bytes(remainder, bytes);
}

std::uint64_t crc64(std::span<const std::byte> bytes, std::uint64_t previous) {
#if defined(__x86_64__)
  if (bytes.size() >= kStride && can_fold()) {
    const std::size_t whole = bytes.size() / kStride * kStride;
    return ~add_bytes(add_strides(~previous, bytes), bytes.subspan(whole));
  }
#endif
  return crc64_by_tables(bytes, previous);
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
