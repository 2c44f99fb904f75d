// Messages and the less frequent reads of the mesh file in memory.
#include "io/mesh_bytes.hpp"

#include <cmath>

#include "io/error.hpp"

namespace cleave::io {
namespace {

// A line for a message: cut, and without characters that could disturb a terminal.
std::string printable(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string result;
  for (const char c : text.substr(0, kLongest))
    result += (c >= ' ' && c <= '~') || c == '\t' ? c : '?';
  return text.size() > kLongest ? result + "..." : result;
}

}  // namespace

void MeshBytes::read_byte_order() {
  const auto word = binary_number<std::uint32_t>();
  if (word == 1) return;
  if (word != 0x01000000U)
    fail("the word that tells the byte order should be 1 in one of the two orders, but is " +
         std::to_string(word) + "; was the file transferred in text mode?");
  swapped_ = true;
}

bool MeshBytes::at_end() {
  skip_space();
  return remaining() == 0;
}

std::string_view MeshBytes::word() {
  skip_space();
  item_ = position_;
  while (position_ < data_.size() && !is_space(data_[position_])) ++position_;
  return data_.substr(item_, position_ - item_);
}

std::string_view MeshBytes::line() {
  item_ = position_;
  const std::size_t end = std::min(data_.find('\n', position_), data_.size());
  std::string_view text = data_.substr(position_, end - position_);
  position_ = std::min(end + 1, data_.size());
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

double MeshBytes::text_real() { return finite(text_number<double>("a real number")); }

void MeshBytes::skip_past(std::string_view mark) {
  item_ = position_;
  for (std::size_t at = data_.find(mark, position_); at != std::string_view::npos;
       at = data_.find(mark, at + 1)) {
    const std::size_t end = at + mark.size();
    const bool begins_line = at == 0 || data_[at - 1] == '\n';
    if (begins_line && (end == data_.size() || is_space(data_[end]))) {
      position_ = end;
      return;
    }
  }
  fail("section " + section_ + " has no " + std::string(mark) + ": the file is truncated");
}

std::int64_t MeshBytes::size() {
  if (!binary_) return text_integer();
  if (size_width_ == 4) return binary_number<std::uint32_t>();
  return binary_number<std::int64_t>();
}

void MeshBytes::check_count(std::int64_t count, std::size_t entry_size, const char* entries) const {
  // The last entry of a text file may lack its line end.
  const std::size_t most = remaining() / entry_size + (binary_ ? 0 : 1);
  if (count < 0 || static_cast<std::uint64_t>(count) > most)
    fail("section " + section_ + " announces " + std::to_string(count) + " " + entries +
         ", but only " + std::to_string(remaining()) +
         " bytes follow: the file is truncated or damaged; write it again");
}

double MeshBytes::finite(double value) const {
  if (!std::isfinite(value)) fail("a coordinate or parameter is not finite; mesh again");
  return value;
}

void MeshBytes::fail_word(const char* expected) {
  const std::string_view found = word();
  if (found.empty()) fail_end();
  fail("expected " + std::string(expected) + (section_.empty() ? "" : " in section " + section_) +
       ", found \"" + printable(found) + "\"");
}

void MeshBytes::fail_end() const {
  fail("the file ends inside section " + section_ + ": it is truncated; write it again");
}

void MeshBytes::fail(const std::string& what) const {
  if (binary_) throw Error(path_ + ": at byte " + std::to_string(item_) + ": " + what);
  const auto line =
      1 + std::count(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(item_), '\n');
  const std::size_t before = data_.substr(0, item_).rfind('\n');
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t end = std::min(data_.find('\n', begin), data_.size());
  std::string_view text = data_.substr(begin, end - begin);
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  throw Error(path_ + ":" + std::to_string(line) + ": " + what +
              (text.empty() ? "" : "\n    " + printable(text)));
}

}  // namespace cleave::io
