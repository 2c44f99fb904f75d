// Namelist files as JSON, for other tools: everything that was read, nothing checked or converted.
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/namelist.hpp"

namespace cleave::io::namelist {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number;
}

struct ScalarJson {
  Json operator()(Null) const { return nullptr; }
  Json operator()(std::int64_t integer) const { return integer; }
  Json operator()(double real) const { return json_of(real); }
  Json operator()(bool logical) const { return logical; }
  Json operator()(const std::string& text) const { return text; }
  Json operator()(const Complex& z) const { return {{"re", json_of(z.re)}, {"im", json_of(z.im)}}; }
};

struct TypeName {
  const char* operator()(Null) const { return "null"; }
  const char* operator()(std::int64_t) const { return "integer"; }
  const char* operator()(double) const { return "real"; }
  const char* operator()(bool) const { return "logical"; }
  const char* operator()(const std::string&) const { return "text"; }
  const char* operator()(const Complex&) const { return "complex"; }
};

Json json_of(const Subscript& s) {
  if (!s.is_range) return s.first;
  return {{"first", s.has_first ? Json(s.first) : Json()},
          {"last", s.has_last ? Json(s.last) : Json()},
          {"stride", s.stride}};
}

Json json_of(const NamePart& part) {
  Json json = {{"name", part.name}};
  for (const Subscript& s : part.subscripts) json["subscripts"].push_back(json_of(s));
  if (!part.substring.empty()) json["substring"] = json_of(part.substring.front());
  return json;
}

Json json_of(const Assignment& assignment) {
  Json json = {{"name", assignment.full_name()},    {"line", assignment.place.line},
               {"column", assignment.place.column}, {"parts", Json::array()},
               {"values", Json::array()},           {"types", Json::array()}};
  for (const NamePart& part : assignment.name) json["parts"].push_back(json_of(part));
  for (const Value& value : assignment.values) {
    json["values"].push_back(std::visit(ScalarJson{}, value.scalar));
    json["types"].push_back(std::visit(TypeName{}, value.scalar));
  }
  return json;
}

}  // namespace

std::string to_json(const File& file) {
  Json json = {{"file", file.path}, {"groups", Json::array()}};
  for (const Group& group : file.groups) {
    Json entry = {{"name", group.name},
                  {"line", group.place.line},
                  {"column", group.place.column},
                  {"assignments", Json::array()}};
    for (const Assignment& a : group.assignments) entry["assignments"].push_back(json_of(a));
    json["groups"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cleave::io::namelist
