// A mesh file in memory, read from front to back: words and numbers of text, or numbers in binary.
//
// Every read is bounded by the file, every failure is an io::Error that names the line (text) or
// the byte (binary). It knows nothing of what the numbers mean.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace cleave::io {

class MeshBytes {
 public:
  MeshBytes(std::string path, std::string_view data) : path_(std::move(path)), data_(data) {}

  const std::string& path() const { return path_; }
  std::size_t remaining() const { return data_.size() - position_; }
  bool binary() const { return binary_; }

  // From here on integer(), size() and real() read binary numbers; `size_width` is the width of
  // size(), 4 or 8.
  void set_binary(std::size_t size_width) {
    binary_ = true;
    size_width_ = size_width;
  }
  // Reads the 4-byte word 1 that tells the byte order of the file.
  void read_byte_order();
  // The part being read, for messages: "$Nodes".
  void set_section(std::string_view section) { section_ = section; }

  // Text, whatever the mode: section marks and their lines are text in binary files, too.
  bool at_end();
  std::string_view word();  // up to white space; empty at the end of the file
  std::string_view line();  // the rest of the line
  std::int64_t text_integer() { return text_number<std::int64_t>("an integer"); }
  double text_real();
  // Moves to the end of the first `mark` that begins a line. Throws if there is none.
  void skip_past(std::string_view mark);

  // In the mode of the file.
  std::int64_t integer() { return binary_ ? binary_number<std::int32_t>() : text_integer(); }
  std::int64_t size();
  double real() { return binary_ ? finite(binary_number<double>()) : text_real(); }
  // Checks that `count` entries of at least `entry_size` bytes can follow: a corrupt count must not
  // turn into a gigantic allocation.
  void check_count(std::int64_t count, std::size_t entry_size, const char* entries) const;

  // Throws io::Error with the place of the number or word read last.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  void skip_space() {
    while (position_ < data_.size() && is_space(data_[position_])) ++position_;
  }
  double finite(double value) const;
  [[noreturn]] void fail_word(const char* expected);
  [[noreturn]] void fail_end() const;

  template <class Number>
  Number text_number(const char* expected) {
    skip_space();
    item_ = position_;
    const char* const end = data_.data() + data_.size();
    Number value{};
    const auto [stop, error] = std::from_chars(data_.data() + position_, end, value);
    if (error != std::errc{} || (stop != end && !is_space(*stop))) fail_word(expected);
    position_ = static_cast<std::size_t>(stop - data_.data());
    return value;
  }

  template <class Number>
  Number binary_number() {
    item_ = position_;
    if (remaining() < sizeof(Number)) fail_end();
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), data_.data() + position_, sizeof(Number));
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    position_ += sizeof(Number);
    return std::bit_cast<Number>(bytes);
  }

  std::string path_;
  std::string_view data_;
  std::string section_;
  std::size_t position_ = 0;
  std::size_t item_ = 0;  // where the last number or word began
  std::size_t size_width_ = 8;
  bool binary_ = false;
  bool swapped_ = false;
};

}  // namespace cleave::io
