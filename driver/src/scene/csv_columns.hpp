// Numbers from a CSV file with a header line of names, for what users hand in.
#pragma once

#include <string>
#include <vector>

namespace cleave::driver {

struct CsvColumns {
  std::string path;
  std::vector<std::string> names;         // without units in brackets
  std::vector<std::vector<double>> rows;  // each as long as names
  std::vector<int> line;                  // of the file, from 1, of every row

  std::string place(std::size_t row) const { return path + ":" + std::to_string(line[row]); }
};

// Throws DeckError: cannot be opened, not a finite number, too few or too many numbers, no rows; with
// the line.
CsvColumns read_csv_columns(const std::string& path);

}  // namespace cleave::driver
