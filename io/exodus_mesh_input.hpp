// A netCDF file opened for reading, as far as the Exodus reader needs it: dimensions, integers,
// reals and names, each checked for size before anything is allocated. Internal to io.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cleave::io {

class NetcdfInput {
 public:
  // file_size bounds what a variable may claim to hold.
  NetcdfInput(std::string path, std::size_t file_size);
  ~NetcdfInput();
  NetcdfInput(const NetcdfInput&) = delete;
  NetcdfInput& operator=(const NetcdfInput&) = delete;

  std::optional<std::int64_t> dimension(const std::string& name) const;
  bool has_variable(const std::string& name) const;
  std::vector<std::int64_t> shape(const std::string& variable) const;
  // All values of a variable. Throws io::Error if it is absent or of another type.
  std::vector<std::int64_t> integers(const std::string& variable) const;
  std::vector<double> reals(const std::string& variable) const;
  // Rows of a character array, cut at the first NUL, without trailing blanks.
  std::vector<std::string> texts(const std::string& variable) const;
  // "" if there is no such text attribute.
  std::string text_attribute(const std::string& variable, const std::string& attribute) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  int variable_id(const std::string& name) const;  // -1 if absent
  int require(const std::string& name) const;
  std::size_t most_values() const;
  std::size_t checked_size(const std::string& variable) const;
  void check(int status, const std::string& variable) const;

  std::string path_;
  std::size_t file_size_ = 0;
  int id_ = -1;
};

}  // namespace cleave::io
