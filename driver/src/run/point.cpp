#include "run/point.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "deck/deck.hpp"
#include "deck/kernel_tables.hpp"
#include "deck/nearest_name.hpp"
#include "io/csv.hpp"
#include "run/run.hpp"
#include "scene/csv_columns.hpp"
#include "scene/format.hpp"
#include "scene/model.hpp"

namespace cleave::driver {
namespace {

constexpr std::array<const char*, 9> kPlaces = {"xx", "yx", "zx", "xy", "yy",
                                                "zy", "xz", "yz", "zz"};  // as in cleave.h

struct PathRow {
  double time = 0;
  std::array<double, 9> h{};  // F - I
};

double property_value(const std::string& word, std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    throw DeckError("\"" + word + "\": the value is not a finite number");
  }
  return value;
}

// What a column of the path means: -1 time, 0 to 8 a component; is_f: of F, not of H.
struct PathColumn {
  int place = -1;
  bool is_f = false;
};

PathColumn column_of(const std::string& name, const std::string& where) {
  std::vector<std::string> known{"time"};
  if (name == "time") return {};
  for (const char kind : {'F', 'H'}) {
    for (int place = 0; place < 9; ++place) {
      known.push_back(std::string(1, kind) + "_" + kPlaces[static_cast<std::size_t>(place)]);
      if (name == known.back()) return {place, kind == 'F'};
    }
  }
  throw DeckError(where + ": column \"" + name + "\" is unknown; allowed: " + listed(known) +
                  did_you_mean(name, known));
}

// What a plane problem does not take from the path.
void refuse_out_of_plane(const CsvColumns& csv, std::size_t row, const PathColumn& column, double h,
                         const std::string& name) {
  const bool out_of_plane = column.place % 3 == 2 || column.place / 3 == 2;
  if (column.place < 0 || !out_of_plane || h == 0) return;
  throw DeckError(
      csv.place(row) + ": " + name +
      " is not that of no deformation, but the kinematics is plane; leave the column out");
}

std::vector<PathRow> read_path(const std::string& path, bool plane) {
  const CsvColumns csv = read_csv_columns(path);
  if (csv.rows.size() > 1 &&
      std::find(csv.names.begin(), csv.names.end(), "time") == csv.names.end()) {
    throw DeckError(path + ":1: there is no column time; give increasing times");
  }
  std::vector<PathRow> rows;
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    PathRow row;
    for (std::size_t c = 0; c < csv.names.size(); ++c) {
      const PathColumn column = column_of(csv.names[c], path + ":1");
      if (column.place < 0) {
        row.time = csv.rows[r][c];
      } else {
        row.h[static_cast<std::size_t>(column.place)] =
            csv.rows[r][c] - (column.is_f && column.place % 4 == 0 ? 1.0 : 0.0);
        if (plane)
          refuse_out_of_plane(csv, r, column, row.h[static_cast<std::size_t>(column.place)],
                              csv.names[c]);
      }
    }
    if (!rows.empty() && !(row.time > rows.back().time))
      throw DeckError(csv.place(r) + ": times must increase");
    rows.push_back(row);
  }
  return rows;
}

std::vector<double> properties_of(const PointRequest& request) {
  const auto specs = table_parameters(request.law);
  std::vector<double> values;
  std::vector<char> given(specs.size(), 0);
  std::vector<std::string> names;
  for (const cleave_parameter& spec : specs) {
    values.push_back(spec.default_value);
    names.emplace_back(spec.name);
  }
  for (const std::string& word : request.properties) {
    const std::size_t sign = word.find('=');
    const std::string name = word.substr(0, sign);
    std::size_t k = 0;
    while (k < names.size() && names[k] != name) ++k;
    if (sign == std::string::npos || k == names.size()) {
      throw DeckError("\"" + word + "\" is not NAME=VALUE of law " + request.law +
                      "; its properties: " + listed(names) + did_you_mean(name, names));
    }
    values[k] = property_value(word, std::string_view(word).substr(sign + 1));
    given[k] = 1;
  }
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (specs[k].required != 0 && given[k] == 0) {
      throw DeckError("law " + request.law + " needs the property " + names[k] + " [" +
                      specs[k].units + "], " + specs[k].description + "; give " + names[k] +
                      "=VALUE");
    }
  }
  return values;
}

double kirchhoff_equivalent(const std::array<double, 9>& h, const std::array<double, 9>& p) {
  std::array<double, 9> tau{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        tau[r + 3 * c] += p[r + 3 * k] * (h[c + 3 * k] + (c == k ? 1.0 : 0.0));
  const double mean = (tau[0] + tau[4] + tau[8]) / 3;
  double sum = 0;
  for (std::size_t c = 0; c < 9; ++c) {
    const double d = tau[c] - (c % 4 == 0 ? mean : 0.0);
    sum += d * d;
  }
  return std::sqrt(1.5 * sum);
}

std::vector<io::Column> columns_of(const std::string& law) {
  std::vector<io::Column> columns{{"time", "s", "", false}};
  for (const char kind : {'F', 'P'})
    for (const char* place : kPlaces)
      columns.push_back({std::string(1, kind) + "_" + place, kind == 'F' ? "1" : "Pa", "", false});
  columns.push_back({"kirchhoff_equivalent_stress", "Pa", "", false});
  for (const char* name : {"energy", "plastic_work"}) columns.push_back({name, "J m-3", "", false});
  for (const cleave_field& field : table_fields()) {
    if (law != field.owner) continue;
    for (int c = 1; c <= field.components; ++c) {
      columns.push_back(
          {field.components == 1 ? field.name : std::string(field.name) + "_" + std::to_string(c),
           field.units, "", false});
    }
  }
  return columns;
}

}  // namespace

void follow_path(const PointRequest& request, const std::function<void(std::string_view)>& out) {
  std::int32_t law = 0;
  const auto known = table_names(CLEAVE_TABLE_MATERIAL);
  if (cleave_table_find(CLEAVE_TABLE_MATERIAL, request.law.c_str(), &law) != CLEAVE_OK) {
    throw DeckError("law \"" + request.law + "\" is unknown; known laws: " + listed(known) +
                    did_you_mean(request.law, known));
  }
  const std::vector<double> properties = properties_of(request);
  const std::vector<PathRow> rows = read_path(request.path, request.kinematics != "3d");
  std::int64_t history_count = 0;
  check(cleave_material_history_count(law, &history_count));
  std::vector<double> history(static_cast<std::size_t>(history_count), 0.0);
  std::array<double, 9> h{}, p{};
  double energy = 0, plastic = 0, plastic_work = 0;

  cleave_material_call call{};
  check(cleave_material_call_init(&call));
  call.material = law;
  call.kinematics = request.kinematics == "3d"             ? CLEAVE_3D
                    : request.kinematics == "plane_strain" ? CLEAVE_PLANE_STRAIN
                                                           : CLEAVE_PLANE_STRESS;
  call.property_count = static_cast<std::int64_t>(properties.size());
  call.properties = properties.data();
  call.last = 1;
  call.length = request.length;
  call.deformation = h.data();
  call.history = history.empty() ? nullptr : history.data();
  call.stress = p.data();
  call.energy = &energy;
  call.plastic = &plastic;

  const std::vector<io::Column> columns = columns_of(request.law);
  out(io::csv_header(columns));
  double last_time = rows.front().time;
  std::string text;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const PathRow& to = rows[row];
    const PathRow& from = row == 0 ? to : rows[row - 1];
    const std::int64_t parts = row == 0 ? 1 : request.steps;
    for (std::int64_t part = 1; part <= parts; ++part) {
      const double s = static_cast<double>(part) / static_cast<double>(parts);
      for (std::size_t c = 0; c < 9; ++c)
        h[c] = part == parts ? to.h[c] : from.h[c] + s * (to.h[c] - from.h[c]);
      const double time = part == parts ? to.time : from.time + s * (to.time - from.time);
      call.dt = time - last_time;
      last_time = time;
      try {
        check(cleave_material_update(&call));
      } catch (const KernelError& error) {
        if (error.status != CLEAVE_BAD_JACOBIAN) throw DeckError(error.what());  // a property
        throw RunError("at time " + number(time) + ": " + error.what());
      }
      plastic_work += plastic;
      std::vector<double> record{time};
      for (std::size_t c = 0; c < 9; ++c) record.push_back(h[c] + (c % 4 == 0 ? 1.0 : 0.0));
      record.insert(record.end(), p.begin(), p.end());
      record.insert(record.end(), {kirchhoff_equivalent(h, p), energy, plastic_work});
      record.insert(record.end(), history.begin(), history.end());
      text.clear();
      io::append_csv_records(text, columns, record);
      out(text);
    }
  }
}

}  // namespace cleave::driver
