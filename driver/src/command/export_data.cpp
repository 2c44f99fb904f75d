#include "command/export_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <set>

#include "deck/deck.hpp"
#include "deck/nearest_name.hpp"
#include "deck/number_text.hpp"

namespace cleave::driver {
namespace {

constexpr const char* kStatus = "status";

std::string frames_text(const io::StoredResults& results) {
  return "frames 1 to " + std::to_string(results.times.size()) + " (time " +
         short_text(results.times.front()) + " to " + short_text(results.times.back()) + ")";
}

// times: two at least, ascending.
std::int64_t nearest_frame(const std::vector<double>& times, double time) {
  const auto after = std::lower_bound(times.begin() + 1, times.end() - 1, time);
  const auto before = after - 1;
  return (time - *before <= *after - time ? before : after) - times.begin();
}

std::int64_t chosen_frame(const io::StoredResults& results, const ExportPart& part) {
  const std::int64_t frames = std::ssize(results.times);
  if (frames == 0) {
    throw DeckError(results.path +
                    ": there is no complete frame in it yet; wait for the run's first output");
  }
  if (part.time) {
    if (!std::isfinite(*part.time)) throw DeckError("--time is not a finite number; give a time");
    return frames == 1 ? 0 : nearest_frame(results.times, *part.time);
  }
  if (part.step.empty() || part.step == "last") return frames - 1;
  if (part.step == "first") return 0;
  std::int64_t number = 0;
  const char* const end = part.step.data() + part.step.size();
  const auto read = std::from_chars(part.step.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || number < 1 || number > frames) {
    throw DeckError("--step \"" + part.step + "\": " + results.path + " has " +
                    frames_text(results) +
                    "; give one of these numbers, \"first\" or \"last\", or choose by --time");
  }
  return number - 1;
}

std::optional<std::size_t> chosen_block(const io::StoredResults& results, const std::string& name) {
  if (name.empty()) return std::nullopt;
  std::vector<std::string> known;
  for (const io::StoredBlock& block : results.blocks) {
    if (block.name == name) return known.size();
    known.push_back(block.name);
  }
  throw DeckError(results.path + ": there is no body \"" + name + "\"" + did_you_mean(name, known) +
                  (known.empty() ? " The file has no elements, so no bodies are named in it."
                                 : " Bodies: " + listed(known) + "."));
}

std::vector<ExportElement> elements_of(const io::StoredResults& results,
                                       std::optional<std::size_t> block) {
  std::vector<ExportElement> elements;
  std::size_t in_file = 0;
  for (std::size_t b = 0; b < results.blocks.size(); ++b) {
    const auto count = static_cast<std::size_t>(results.blocks[b].count());
    for (std::size_t e = 0; e < count; ++e, ++in_file) {
      if (!block || *block == b) elements.push_back({b, e, in_file});
    }
  }
  return elements;
}

std::vector<std::size_t> particles_of(const io::StoredResults& results,
                                      std::optional<std::size_t> block) {
  std::vector<std::size_t> particles(results.point_ids.size());
  std::iota(particles.begin(), particles.end(), std::size_t{0});
  if (block) {
    std::vector<bool> used(particles.size(), false);
    for (const std::int64_t node : results.blocks[*block].nodes) {
      used[static_cast<std::size_t>(node)] = true;
    }
    std::erase_if(particles, [&](std::size_t p) { return !used[p]; });
  }
  return particles;
}

const ExportField& displacement_of(const io::StoredResults& results,
                                   const std::vector<ExportField>& fields) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const ExportField& field) {
    return field.name == "displacement" && std::ssize(field.variables) == results.dimension;
  });
  if (found != fields.end()) return *found;
  throw DeckError(results.path +
                  ": has no displacement (DISPLX, DISPLY, ...), without which current positions "
                  "are not known; export a result that Cleave wrote");
}

std::optional<std::size_t> status_of(const io::StoredResults& results) {
  for (std::size_t v = 0; v < results.element.size(); ++v) {
    if (results.element[v].name == kStatus) return v;
  }
  return std::nullopt;
}

void read_values(ExportData& data, const ExportField& displacement) {
  std::set<std::size_t> nodal(displacement.variables.begin(), displacement.variables.end());
  std::set<std::size_t> element;
  for (const ExportField& f : data.fields.nodal)
    nodal.insert(f.variables.begin(), f.variables.end());
  for (const ExportField& f : data.fields.element) {
    element.insert(f.variables.begin(), f.variables.end());
  }
  if (const auto status = status_of(data.results)) element.insert(*status);
  const std::vector<std::size_t> nodes(nodal.begin(), nodal.end());
  const std::vector<std::size_t> elements(element.begin(), element.end());
  io::ResultFrame frame = data.results.read_frame(data.frame, nodes, elements);
  data.time = frame.time;
  data.nodal.resize(data.results.nodal.size());
  data.element.resize(data.results.element.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) data.nodal[nodes[i]] = std::move(frame.nodal[i]);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    data.element[elements[i]] = std::move(frame.element[i]);
  }
}

void move_points(ExportData& data, const ExportField& displacement) {
  data.current = data.results.points;
  for (std::size_t axis = 0; axis < displacement.variables.size(); ++axis) {
    const std::vector<double>& u = data.nodal[displacement.variables[axis]];
    for (std::size_t i = 0; i < u.size(); ++i) data.current[3 * i + axis] += u[i];
  }
}

void drop_deleted(ExportData& data) {
  const auto status = status_of(data.results);
  if (!status) {
    throw DeckError(data.results.path +
                    ": has no element variable \"status\", so --alive has nothing to go by; "
                    "leave it out");
  }
  const std::vector<double>& values = data.element[*status];
  std::erase_if(data.elements,
                [&](const ExportElement& element) { return values[element.in_file] == 0; });
}

}  // namespace

std::span<const std::int64_t> ExportData::nodes(const ExportElement& of) const {
  const io::StoredBlock& block = results.blocks[of.block];
  const auto corners = static_cast<std::size_t>(block.corners);
  return std::span(block.nodes).subspan(of.in_block * corners, corners);
}

ExportData read_export_data(const std::string& path, const ExportPart& part) {
  ExportData data;
  data.results = io::read_results(path);
  data.frame = chosen_frame(data.results, part);
  const std::optional<std::size_t> block = chosen_block(data.results, part.block);
  data.fields = chosen_fields(data.results, part.fields);
  const std::vector<ExportField> all = joined_fields(data.results.nodal);
  const ExportField& displacement = displacement_of(data.results, all);
  data.length_units = displacement.units;
  data.particles = particles_of(data.results, block);
  data.elements = elements_of(data.results, block);
  read_values(data, displacement);
  move_points(data, displacement);
  if (part.alive) drop_deleted(data);
  return data;
}

}  // namespace cleave::driver
