#include "io/checksum.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

namespace {

using cleave::io::crc64;

std::uint64_t of_text(const std::string& text) { return crc64(std::as_bytes(std::span(text))); }

// The check value of CRC-64/XZ in the public catalogues of CRC algorithms.
TEST(Checksum, AgreesWithThePublishedCheckValue) {
  EXPECT_EQ(of_text("123456789"), 0x995DC9BBDF1939FAu);
  EXPECT_EQ(of_text(""), 0u);
}

TEST(Checksum, OfNumbersIsThatOfTheirLittleEndianBytes) {
  const std::vector<std::int64_t> integers{0x3837363534333231, -2};
  EXPECT_EQ(crc64(std::span(integers)), of_text("12345678\xfe\xff\xff\xff\xff\xff\xff\xff"));
  const std::vector<double> reals{std::bit_cast<double>(integers[0]),
                                  std::bit_cast<double>(integers[1])};
  EXPECT_EQ(crc64(std::span(reals)), crc64(std::span(integers)));
}

TEST(Checksum, CanBeContinued) {
  const std::string text = "a longer text in two parts";
  const auto bytes = std::as_bytes(std::span(text));
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    EXPECT_EQ(crc64(bytes.subspan(cut), crc64(bytes.first(cut))), of_text(text));
  }
}

// By carry-less products where the processor has them; the tables have no part in that. Any length, any
// alignment, any beginning.
TEST(Checksum, IsTheSameByTablesForEveryLength) {
  std::mt19937_64 random(1);
  std::vector<std::byte> bytes(1000);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  for (std::size_t length = 0; length < 400; ++length) {
    const auto part = std::span<const std::byte>(bytes).subspan(length % 17, length);
    const std::uint64_t previous = random();
    ASSERT_EQ(crc64(part, previous), cleave::io::crc64_by_tables(part, previous)) << length;
  }
}

TEST(Checksum, ChangesWithEveryBit) {
  std::vector<std::int64_t> values(40);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::int64_t>(i * i * 977);
  const std::uint64_t before = crc64(std::span(values));
  for (std::int64_t& value : values) {
    for (int bit = 0; bit < 63; ++bit) {
      value ^= std::int64_t{1} << bit;
      EXPECT_NE(crc64(std::span(values)), before);
      value ^= std::int64_t{1} << bit;
    }
  }
}

TEST(Checksum, TextHasSixteenDigits) {
  EXPECT_EQ(cleave::io::checksum_text(0x0123456789abcdef), "crc64:0123456789abcdef");
  EXPECT_EQ(cleave::io::checksum_text(0), "crc64:0000000000000000");
}

}  // namespace
