#include "command/checkpoint_text.hpp"

#include <algorithm>
#include <sstream>
#include <variant>

#include "command/table_text.hpp"
#include "deck/deck.hpp"
#include "deck/number_text.hpp"
#include "run/checkpoint.hpp"
#include "run/progress.hpp"

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

std::string value_text(const io::AttributeValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  return real_text(std::get<double>(value));
}

class Header {
 public:
  explicit Header(const io::ArchiveHeader& archive) : archive_(archive) {}

  std::string operator()(const std::string& attribute) const {
    const io::AttributeValue* value = archive_.find_attribute(attribute);
    return value == nullptr ? "unknown" : value_text(*value);
  }
  std::int64_t rows(const std::string& array) const {
    const io::ArrayInfo* info = archive_.find_array(array);
    return info == nullptr ? 0 : info->size / info->components;
  }
  std::vector<std::string> lines(const std::string& attribute) const {
    std::vector<std::string> list;
    if (archive_.find_attribute(attribute) == nullptr) return list;
    std::istringstream text((*this)(attribute));
    for (std::string line; std::getline(text, line);) list.push_back(line);
    return list;
  }

 private:
  const io::ArchiveHeader& archive_;
};

std::string summary(const io::ArchiveHeader& archive) {
  const Header header(archive);
  std::int64_t values = 0;
  for (const io::ArrayInfo& array : archive.arrays) values += array.size;
  std::string text = "after step " + header("step") + " of " + header("steps") + ", time " +
                     header("time") + ", step size " + header("time_step") + '\n';
  text += "deck " + header("deck_path") + ", units " + header("units");
  if (const std::string title = header("title"); !title.empty()) text += ": " + title;
  text += "\n";
  for (const std::string& body : header.lines("bodies")) {
    text += "body '" + body + "': dimension " + header(body + ".dimension") + ", " +
            std::to_string(header.rows(body + "/point_ids")) + " particles, " +
            std::to_string(header.rows(body + "/simplices")) + " simplices\n";
  }
  text += "its files hold " + header("frames") + " frames, " + header("history_records") +
          " history records, " + header("event_records") + " events\n";
  text += std::to_string(archive.arrays.size()) + " arrays, " + bytes_text(8 * values) + '\n';
  text += "written by cleave " + header("cleave_version") + ", format " + header("format") +
          ", field table " + header("fields_fingerprint") + '\n';
  const std::string why_not = why_not_continued(archive.attributes);
  text += why_not.empty() ? "this version continues it: cleave restart\n"
                          : "this version cannot continue it: " + why_not + '\n';
  return text;
}

std::string attribute_text(const io::Attribute& attribute) {
  std::string text = value_text(attribute.second);
  if (attribute.first != "bodies" && !attribute.first.ends_with(".groups")) return shortened(text);
  if (text.ends_with('\n')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

std::string checkpoint_text(const std::string& path, const io::ArchiveHeader& archive) {
  TextTable attributes{{"attribute", "value"}, {}};
  for (const io::Attribute& attribute : archive.attributes)
    attributes.rows.push_back({attribute.first, attribute_text(attribute)});
  TextTable arrays{{"array", "units", "type", "components x count", "description"}, {}};
  for (const io::ArrayInfo& array : archive.arrays)
    arrays.rows.push_back(
        {array.name, in_brackets(array.units), array.is_integer ? "integer" : "real",
         std::to_string(array.components) + " x " + std::to_string(array.size / array.components),
         array.description});
  return path + ": checkpoint\n" + summary(archive) + '\n' + to_text(attributes) + '\n' +
         to_text(arrays);
}

std::string checkpoint_deck(const std::string& path) {
  const io::ArchiveHeader archive = io::read_archive_header(path);
  if (archive.find_attribute("deck") == nullptr)
    throw DeckError(path + ": carries no deck; name a checkpoint of a run");
  std::string text = Header(archive)("deck");
  if (!text.ends_with('\n')) text += '\n';
  return text;
}

}  // namespace cleave::driver
