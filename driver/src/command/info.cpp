#include "command/info.hpp"

#include <array>

#include "command/checkpoint_text.hpp"
#include "command/table_text.hpp"
#include "deck/number_text.hpp"
#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/record_summary.hpp"
#include "io/results.hpp"

namespace cleave::driver {
namespace {

std::string describe_archive(const std::string& path) {
  return checkpoint_text(path, io::read_archive_header(path));
}

std::string variables_line(const char* kind, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string line = std::string(kind) + ":";
  for (const std::string& name : names) line += " " + name;
  return line + '\n';
}

std::string describe_results(const std::string& path) {
  const io::ResultSummary s = io::summarise_results(path);
  std::string text = path + ": results\ntitle: " + s.title + '\n';
  text += "dimension " + std::to_string(s.dimension) + ", " + std::to_string(s.points) +
          " particles, " + std::to_string(s.elements) + " elements\n";
  text += std::to_string(s.times.size()) + " frames";
  if (!s.times.empty())
    text += ", time " + short_text(s.times.front()) + " to " + short_text(s.times.back());
  return text + '\n' + variables_line("of particles", s.nodal) +
         variables_line("of elements", s.element) + variables_line("global", s.global);
}

std::string describe_records(const std::string& path) {
  const io::RecordSummary s = io::summarise_records(path);
  TextTable columns{{"column", "units", "first", "last", "description"}, {}};
  for (std::size_t c = 0; c < s.columns.size(); ++c) {
    const auto value = [&](const std::vector<double>& record) {
      return record.empty() ? std::string("-") : short_text(record[c]);
    };
    columns.rows.push_back({s.columns[c].name, in_brackets(s.columns[c].units), value(s.first),
                            value(s.last), s.columns[c].description});
  }
  return path + ": table of " + std::to_string(s.records) + " records\n\n" + to_text(columns);
}

struct FileKind {
  const char* name;
  std::string (*describe)(const std::string& path);
};

constexpr std::array kKinds = {
    FileKind{"a checkpoint", describe_archive},
    FileKind{"results", describe_results},
    FileKind{"a history or event table", describe_records},
};

}  // namespace

std::string file_description(const std::string& path) {
  std::string why;
  for (const FileKind& kind : kKinds) {
    try {
      return kind.describe(path);
    } catch (const io::Error& error) {
      why += std::string("\n  not ") + kind.name + ": " + error.what();
    }
  }
  throw io::Error("cannot describe \"" + path + "\": it is none of the files that a run writes." +
                  why);
}

}  // namespace cleave::driver
