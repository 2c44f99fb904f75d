#include "command/export.hpp"

#include <filesystem>
#include <system_error>

#include "command/deck_path.hpp"
#include "command/export_grid.hpp"
#include "deck/deck.hpp"
#include "deck/number_text.hpp"
#include "io/new_file.hpp"
#include "io/vtu.hpp"

namespace cleave::driver {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScreen = "-";

std::string format_of(const ExportRequest& request) {
  if (!request.format.empty()) return request.format;
  return fs::path(request.output).extension() == ".vtu" ? "vtu" : "csv";
}

bool on_elements(const ExportRequest& request) { return request.on == "elements"; }

// Options that would have no effect are mistakes.
void check_options(const ExportRequest& request, const std::string& format) {
  const bool table = format == "csv";
  const auto refuse = [&](const std::string& what) { throw DeckError("cleave export: " + what); };
  if (!request.part.step.empty() && request.part.time)
    refuse("--step and --time both choose the frame; give one of them");
  if (table && !request.configuration.empty())
    refuse("--configuration is for --format vtu; a CSV has both positions (X Y Z and x y z)");
  if (!table && !request.on.empty())
    refuse("--on is for --format csv; a vtu has particles and elements");
  if (table && request.part.alive && !on_elements(request))
    refuse("--alive leaves out deleted elements; add --on elements or --format vtu");
  if (!table && request.output == kScreen)
    refuse("only CSV can go to standard output; give --output a file name");
}

// Block names may hold what file names should not.
std::string as_file_name(std::string text) {
  for (char& c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!plain && c != '-' && c != '_') c = '_';
  }
  return text;
}

// "case.exo" -> "case.12.csv", "case.plate.12.elements.csv"
std::string output_of(const ExportRequest& request, const std::string& format, std::int64_t frame) {
  if (!request.output.empty()) return request.output;
  std::string ending = "." + std::to_string(frame + 1);
  if (!request.part.block.empty()) ending.insert(0, "." + as_file_name(request.part.block));
  if (on_elements(request)) ending += ".elements";
  return fs::path(request.result).replace_extension().string() + ending + "." + format;
}

// What stands at the output's name and must not be lost. The file under construction (new_file.hpp)
// ends in .part.
void check_output(const std::string& output, const std::string& result) {
  std::error_code error;
  const std::string part = fs::weakly_canonical(output, error).string() + ".part";
  if (fs::equivalent(output, result, error) || fs::equivalent(part, result, error))
    throw DeckError("--output \"" + output +
                    "\" would overwrite the result itself; choose another name");
  const fs::path ending = fs::path(output).extension();
  if (fs::is_regular_file(output, error) && ending != ".csv" && ending != ".vtu")
    throw DeckError("--output \"" + output +
                    "\" exists and is not a .csv or .vtu file; remove it first, or choose another "
                    "name");
}

// A table has the fields of particles, or those of elements.
void check_fields(const ExportRequest& request, const io::StoredResults& results) {
  for (const std::string& name : request.part.fields) {
    const ExportFields found = chosen_fields(results, {name});
    if (on_elements(request) && found.element.empty())
      throw DeckError("field \"" + name + "\" is one of particles; leave out --on elements");
    if (!on_elements(request) && found.nodal.empty())
      throw DeckError("field \"" + name + "\" is one of elements; add --on elements");
  }
}

void write_table(const ExportData& data, bool elements, const TextSink& sink) {
  if (elements) {
    write_element_table(data, sink);
  } else {
    write_particle_table(data, sink);
  }
}

void write_table_file(const ExportData& data, bool elements, const std::string& path) {
  io::NewFile file(path);
  io::create_empty_file(file.temporary_path());
  write_table(data, elements,
              [&](std::string_view text) { io::append_to_file(file.temporary_path(), text); });
  io::sync_file(file.temporary_path());
  file.commit();
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string summary(const ExportRequest& request, const std::string& format, const ExportData& data,
                    const std::string& output) {
  std::string text = request.result + ": frame " + std::to_string(data.frame + 1) + " of " +
                     std::to_string(data.results.times.size()) + ", time " + real_text(data.time);
  if (request.part.time) text += " (nearest to " + real_text(*request.part.time) + ")";
  text += ": ";
  if (!on_elements(request)) text += counted(data.particles.size(), "particle");
  if (format == "vtu") text += " and ";
  if (format == "vtu" || on_elements(request)) text += counted(data.elements.size(), "element");
  return text + " to " + (output == kScreen ? "standard output" : output) + "\n";
}

}  // namespace

std::string export_result(const ExportRequest& request, const TextSink& screen) {
  const std::string format = format_of(request);
  check_options(request, format);
  existing_file(request.result, "the result");
  const ExportData data = read_export_data(request.result, request.part);
  if (format == "csv") check_fields(request, data.results);
  const std::string output = output_of(request, format, data.frame);
  if (output == kScreen) {
    write_table(data, on_elements(request), screen);
  } else {
    check_output(output, request.result);
    if (format == "csv") {
      write_table_file(data, on_elements(request), output);
    } else {
      const bool reference = request.configuration == "reference";
      io::write_vtu(
          output, export_grid(data, reference ? Configuration::reference : Configuration::current));
    }
  }
  return summary(request, format, data, output);
}

}  // namespace cleave::driver
