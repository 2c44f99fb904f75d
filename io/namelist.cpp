// Reading a namelist file as a whole; the grammar is in namelist_parser.cpp.
#include "io/namelist.hpp"

#include <filesystem>
#include <fstream>

#include "io/error.hpp"
#include "io/namelist_parser.hpp"

namespace cleave::io::namelist {

namespace {

// Far above any deck; keeps a wrong file name from filling the memory.
constexpr std::uintmax_t kLargestFile = 256U << 20U;

void refuse_nul(const File& file) {
  const std::size_t nul = file.text.find('\0');
  if (nul == std::string::npos) return;
  Cursor at(file);
  at.advance_to(nul);
  at.fail(at.place(),
          "a NUL character: this is not a text file; give a namelist file in plain text (UTF-8, "
          "not UTF-16)");
}

}  // namespace

File parse(std::string text, std::string path) {
  File file;
  file.path = std::move(path);
  file.text = std::move(text);
  refuse_nul(file);
  file.groups = Parser(file).groups();
  return file;
}

File read(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(path + ": this is a directory; give the name of a namelist file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(path + ": cannot be opened for reading; is the name right?");
  std::string text;
  std::string chunk(1U << 16U, '\0');
  while (stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) ||
         stream.gcount() > 0) {
    text.append(chunk, 0, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestFile) {
      throw Error(path + ": larger than " + std::to_string(kLargestFile >> 20U) +
                  " MiB; is this a namelist file?");
    }
  }
  if (stream.bad())
    throw Error(path + ": reading failed after " + std::to_string(text.size()) + " bytes");
  return parse(std::move(text), path);
}

}  // namespace cleave::io::namelist
