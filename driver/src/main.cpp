// The program `cleave`: the grammar of its command line, and the one place where errors become exit
// codes: 0 done, 1 the run failed, 2 bad input, 3 stopped on request with a checkpoint written.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <iostream>

#include "cleave/cleave.h"
#include "command/checkpoint_text.hpp"
#include "command/deck_path.hpp"
#include "command/export.hpp"
#include "command/info.hpp"
#include "command/keys.hpp"
#include "command/tables.hpp"
#include "command/verify.hpp"
#include "deck/nearest_name.hpp"
#include "io/error.hpp"
#include "io/namelist.hpp"
#include "run/point.hpp"
#include "run/run.hpp"
#include "run/sample.hpp"
#include "run/wall_time.hpp"

namespace {

using namespace cleave::driver;

enum ExitCode { kDone = 0, kRunFailed = 1, kBadInput = 2 };

// What the words of the command line said.
struct Words {
  std::string deck_to_run, deck, checkpoint, topic, table, file, format = "text";
  bool verify = false, deck_only = false, restart_keys = false;
  RunOptions run;
  ExportRequest to_export;
  PointRequest point;
  SampleRequest sample;
};

int print(const std::string& text) {
  std::cout << text;
  return kDone;
}

TextFormat format_of(const Words& words) {
  return words.format == "markdown" ? TextFormat::markdown : TextFormat::text;
}

void add_run_options(CLI::App& app, Words& words) {
  app.add_option("--threads", words.run.threads,
                 "threads of the kernels; results do not depend on it")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  app.add_flag("--quiet", words.run.quiet, "no progress lines");
}

void add_wall_limit(CLI::App& app, Words& words) {
  const auto take = [&words](const std::string& text) {
    words.run.wall_limit = parse_wall_time(text);
    if (!words.run.wall_limit)
      throw CLI::ValidationError("--wall-limit: \"" + text +
                                 "\" is no wall time; allowed are seconds, as 86000, and hours, "
                                 "minutes and seconds, as 23:50:00");
  };
  app.add_option_function<std::string>(
         "--wall-limit", take,
         "write a checkpoint and stop with exit code 3 before this wall time has passed "
         "(s or H:MM:SS), instead of wall_limit of the deck; 0: none")
      ->type_name("TIME");
}

using Action = std::function<int()>;

// Adds `name`; its action is what main does when the command is given.
CLI::App& add_command(CLI::App& app, Action& chosen, const std::string& name,
                      const std::string& description, Action action) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.callback([&chosen, action = std::move(action)] { chosen = action; });
  return command;
}

void add_deck_commands(CLI::App& app, Words& words, Action& chosen) {
  CLI::App& check = add_command(
      app, chosen, "check", "read everything, print memory, step and estimated time, and stop",
      [&words] { return check_deck(read_deck(existing_file(words.deck, "the deck")), words.run); });
  check.add_option("DECK", words.deck, "deck (Fortran namelist)")->required();
  add_run_options(check, words);

  CLI::App& restart = add_command(
      app, chosen, "restart",
      "continue from a checkpoint, or from the newest good one of a directory", [&words] {
        const std::string from = existing_path(words.checkpoint, "the checkpoint");
        return restart_run(from, words.deck.empty() ? "" : existing_file(words.deck, "the deck"),
                           words.run);
      });
  restart.add_option("CHECKPOINT", words.checkpoint, "checkpoint or directory")->required();
  restart
      .add_option("--deck", words.deck,
                  "go on with this deck; what it may change: cleave keys --restart")
      ->type_name("DECK");
  add_run_options(restart, words);
  add_wall_limit(restart, words);
}

void add_listing_commands(CLI::App& app, Words& words, Action& chosen) {
  CLI::App& keys =
      add_command(app, chosen, "keys", "print the groups and keys of a deck", [&words] {
        if (words.restart_keys) return print(restart_listing(format_of(words)));
        if (words.format == "names") return print(key_names());
        return print(keys_listing(words.topic, format_of(words)));
      });
  keys.add_option("GROUP.KEY", words.topic, "only this group, or this key of it");
  keys.add_flag("--restart", words.restart_keys, "those that a restart may change");
  keys.add_option("--format", words.format, "text, markdown or names")
      ->check(CLI::IsMember({"text", "markdown", "names"}))
      ->type_name("FORMAT");

  CLI::App& tables = add_command(app, chosen, "tables", "print a table of the library", [&words] {
    return print(table_listing(words.table, format_of(words)));
  });
  tables.add_option("TABLE", words.table, listed(listed_tables()))->required();
  tables.add_option("--format", words.format, "text or markdown")
      ->check(CLI::IsMember({"text", "markdown"}))
      ->type_name("FORMAT");
}

int info(const Words& words) {
  if (words.deck_only) return print(checkpoint_deck(existing_file(words.file, "the checkpoint")));
  const std::string path = existing_path(words.file, "the file");
  const bool directory = std::filesystem::is_directory(path);
  if (!directory && !words.verify) return print(file_description(path));
  const auto say = [](const std::string& line) { std::cerr << line << '\n'; };
  const Verification found = directory ? verify_directory(path, say) : verify_file(path, say);
  print(found.text);
  return found.good || !words.verify ? kDone : kRunFailed;
}

void add_file_commands(CLI::App& app, Words& words, Action& chosen) {
  CLI::App& command =
      add_command(app, chosen, "info",
                  "describe a checkpoint or result file, or list the checkpoints of a directory",
                  [&words] { return info(words); });
  command.add_option("FILE", words.file, "checkpoint, results, history or directory")->required();
  command.add_flag("--verify", words.verify,
                   "verify all checksums; exit code 1 if something is broken");
  command.add_flag("--deck", words.deck_only, "print the deck that a checkpoint carries");

  CLI::App& parse = add_command(app, chosen, "parse", "print any namelist file as JSON", [&words] {
    const std::string path = existing_file(words.file, "the file");
    return print(cleave::io::namelist::to_json(cleave::io::namelist::read(path)) + "\n");
  });
  parse.add_option("FILE", words.file, "namelist file")->required();
}

int export_to_file(const ExportRequest& request) {
  const bool on_screen = request.output == "-";
  const std::string done = export_result(request, [](std::string_view text) { std::cout << text; });
  (on_screen ? std::cerr : std::cout) << done;
  return kDone;
}

void add_export_command(CLI::App& app, Words& words, Action& chosen) {
  ExportRequest& request = words.to_export;
  CLI::App& command =
      add_command(app, chosen, "export", "write one frame of a result as CSV or VTK grid",
                  [&request] { return export_to_file(request); });
  command.add_option("RESULT", request.result, "results of a run (NAME.exo)")->required();
  command
      .add_option("--step", request.part.step,
                  "frame: last (default), first, or its number from 1 as `cleave info` counts")
      ->type_name("STEP");
  command.add_option("--time", request.part.time, "the frame nearest to this time")
      ->type_name("TIME");
  command.add_option("--fields", request.part.fields, "only these fields or components: a,b,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command.add_option("--block", request.part.block, "only this body")->type_name("NAME");
  command.add_flag("--alive", request.part.alive, "without deleted elements");
  command.add_option("--on", request.on, "lines of a CSV: particles (default) or elements")
      ->check(CLI::IsMember({"particles", "elements"}))
      ->type_name("WHAT");
  command
      .add_option("--configuration", request.configuration,
                  "positions of a grid: current (default) or reference")
      ->check(CLI::IsMember({"current", "reference"}))
      ->type_name("WHICH");
  command.add_option("--format", request.format, "csv or vtu; default: as the output's name ends")
      ->check(CLI::IsMember({"csv", "vtu"}))
      ->type_name("FORMAT");
  command
      .add_option("--output", request.output,
                  "file to write, or - for a CSV on the screen; default: beside the result")
      ->type_name("FILE");
}

void add_sample_command(CLI::App& app, Words& words, Action& chosen) {
  SampleRequest& request = words.sample;
  CLI::App& command = add_command(
      app, chosen, "sample", "fields of a checkpoint at given points, as CSV", [&request] {
        sample_checkpoint(request, [](std::string_view text) { std::cout << text; });
        return int{kDone};
      });
  command.add_option("CHECKPOINT", request.checkpoint, "checkpoint or directory")->required();
  command.add_option("--at", request.points, "CSV with columns X, Y (and Z): reference positions")
      ->required()
      ->type_name("FILE");
  command.add_option("--fields", request.fields, "fields, stored or derived: a,b,...")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command.add_option("--body", request.body, "body; default: the only one")->type_name("NAME");
}

void add_point_command(CLI::App& app, Words& words, Action& chosen) {
  PointRequest& request = words.point;
  CLI::App& command = add_command(
      app, chosen, "point", "follow a deformation with one material point, as CSV", [&request] {
        follow_path(request, [](std::string_view text) { std::cout << text; });
        return int{kDone};
      });
  command.add_option("LAW", request.law, "law, as in `cleave tables materials`")->required();
  command.add_option("PROPERTIES", request.properties, "NAME=VALUE of every property");
  command
      .add_option("--path", request.path,
                  "CSV with columns time and F_xx, F_xy, ... (or H_xx, ...: F - I, for small "
                  "strains); what is missing is that of no deformation")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--kinematics", request.kinematics, "3d (default), plane_strain, plane_stress")
      ->check(CLI::IsMember({"3d", "plane_strain", "plane_stress"}))
      ->type_name("WHICH");
  command.add_option("--steps", request.steps, "equal steps between two rows of the path")
      ->check(CLI::Range(1, 1000000000))
      ->type_name("N");
  command.add_option("--length", request.length, "size of the particle, for shock viscosity")
      ->type_name("LENGTH");
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

// Wrong usage: what CLI11 says, and the nearest command or option to what was written.
int refuse_usage(const CLI::App& app, const Words& words, const std::string& why) {
  std::cerr << "cleave: " << why << '\n';
  const CLI::App* used = &app;
  if (!app.get_subcommands().empty()) used = app.get_subcommands().front();
  std::vector<std::string> options;
  for (const CLI::Option* option : used->get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (const std::string& word : app.remaining(true)) {
    const std::string nearest = nearest_name(word.substr(0, word.find('=')), options);
    if (word.starts_with("--") && !nearest.empty())
      std::cerr << "Did you mean " << nearest << "?\n";
  }
  const std::string command = nearest_name(words.deck_to_run, command_names(app));
  if (used == &app && !command.empty())
    std::cerr << "Did you mean \"cleave " << command << " ...\"?\n";
  std::cerr << "Usage: cleave DECK | cleave " << listed(command_names(app))
            << " ...; more with cleave --help\n";
  return kBadInput;
}

int run_words(const CLI::App& app, const Words& words) {
  const std::string& deck = words.deck_to_run;
  if (deck.empty()) return refuse_usage(app, words, "no deck and no command is given.");
  if (!std::filesystem::exists(deck) && !nearest_name(deck, command_names(app)).empty())
    return refuse_usage(app, words, "\"" + deck + "\" is neither a command nor a file.");
  return run_deck(read_deck(existing_file(deck, "the deck")), words.run);
}

int run_command_line(int argc, char** argv) {
  Words words;
  Action chosen;
  CLI::App app(
      "Cleave simulates impact and dynamic fracture of solids with particle methods.\n"
      "`cleave DECK` runs a deck.",
      "cleave");
  app.set_version_flag("--version",
                       std::string("cleave ") + cleave_version() + CLEAVE_VERSION_NOTE);
  app.require_subcommand(0, 1);
  app.add_option("DECK", words.deck_to_run, "deck to run (Fortran namelist)");
  add_run_options(app, words);
  add_wall_limit(app, words);
  add_deck_commands(app, words, chosen);
  add_listing_commands(app, words, chosen);
  add_file_commands(app, words, chosen);
  add_export_command(app, words, chosen);
  add_point_command(app, words, chosen);
  add_sample_command(app, words, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return refuse_usage(app, words, error.what());
  }
  if (!chosen) return run_words(app, words);
  if (!words.deck_to_run.empty())
    return refuse_usage(app, words, "\"" + words.deck_to_run + "\" stands before the command.");
  return chosen();
}

int report(int code, const std::string& message) {
  std::cerr << "cleave: " << message << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_command_line(argc, argv);
  } catch (const DeckError& error) {
    return report(kBadInput, error.what());
  } catch (const cleave::io::Error& error) {
    return report(kBadInput, error.what());
  } catch (const RunError& error) {
    return report(kRunFailed, error.what());
  } catch (const std::bad_alloc&) {
    return report(kRunFailed, "out of memory. `cleave check DECK` says how much a run needs.");
  } catch (const std::exception& error) {
    return report(kRunFailed,
                  std::string("an error inside the program; please report it: ") + error.what());
  }
}
