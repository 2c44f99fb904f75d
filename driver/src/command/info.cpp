#include "command/info.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "command/table_text.hpp"
#include "deck/number_text.hpp"
#include "io/archive.hpp"
#include "io/error.hpp"
#include "io/record_summary.hpp"
#include "io/results.hpp"

namespace cleave::driver {
namespace {

// One line of a text that may be long (a whole deck travels in a checkpoint).
std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 70;
  const std::size_t line_end = text.find('\n');
  if (line_end == std::string::npos && text.size() <= kLongest) return text;
  return text.substr(0, std::min(line_end, kLongest)) + " ... (" + std::to_string(text.size()) +
         " characters)";
}

std::string attribute_text(const io::AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return shortened(*text);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  return real_text(std::get<double>(value));
}

std::string describe_archive(const std::string& path) {
  const io::ArchiveHeader archive = io::read_archive_header(path);
  TextTable attributes{{"attribute", "value"}, {}};
  for (const auto& [name, value] : archive.attributes)
    attributes.rows.push_back({name, attribute_text(value)});
  TextTable arrays{{"array", "units", "type", "components x count", "description"}, {}};
  for (const io::ArrayInfo& array : archive.arrays)
    arrays.rows.push_back(
        {array.name, in_brackets(array.units), array.is_integer ? "integer" : "real",
         std::to_string(array.components) + " x " + std::to_string(array.size / array.components),
         array.description});
  return path + ": checkpoint\n\n" + to_text(attributes) + '\n' + to_text(arrays);
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
