#include "cli/usage.hpp"

#include "cli/commands.hpp"
#include "util/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bristle::cli {
namespace {

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

}  // namespace

std::string first_steps() {
  const std::string mine = new_experiment_path("mine");
  return fmt::format(
      "To start:\n"
      "  bristle new mine{:<26} write an experiment, {}\n"
      "  bristle run {:<30} compute it: results/mine.h5\n"
      "  bristle info {:<29} print what the result contains\n"
      "`bristle --help` lists all commands.\n",
      "", mine, mine, "results/mine.h5");
}

std::string command_line_mistake(const CLI::App& app, const std::string& description) {
  // The innermost command that the command line names.
  const CLI::App* command = &app;
  std::string call = "bristle", place;
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    call += " " + command->get_name();
    place = call.substr(call.find(' ') + 1) + ": ";
  }
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return fmt::format("{}{}; `{} --help` shows how to call it", place, description, call);
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  const std::string shown = printable(shell_quoted(word));
  if (word.size() > 1 && word.front() == '-')
    return fmt::format("{}unknown option {}{}; `{} --help` lists the options", place, shown,
                       did_you_mean(word, options_of(*command)), call);
  const std::vector<std::string> commands = commands_of(*command);
  if (commands.empty())
    return fmt::format("{}unexpected argument {}; `{} --help` shows how to call it", place, shown, call);
  if (word == "plot") return place + "figures are drawn by scripts/plot, or by bristle-plot once installed";
  return fmt::format("{}unknown command {}{}; known: {}", place, shown, did_you_mean(word, commands),
                     fmt::join(commands, ", "));
}

}  // namespace bristle::cli
