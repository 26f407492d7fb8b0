// SPDX-License-Identifier: Apache-2.0
#include "lightwell/cli/manual.h"

namespace lightwell {
namespace {

// Text as roff shows it letter by letter: no hyphen becomes a dash, no line a request.
std::string literal(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    begins_line = c == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + literal(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + literal(text) + "\\fR"; }

// "-o, --output FILE", or "scene" of a positional one.
std::string names_of(const CLI::Option& option) {
  if (!option.nonpositional()) return slanted(option.get_name());
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "" : ", ") + bold("-" + name);
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "" : ", ") + bold("--" + name);
  if (!option.get_type_name().empty() && option.get_items_expected_max() > 0)
    names += " " + slanted(option.get_type_name());
  return names;
}

std::string entry(const CLI::Option& option) {
  std::string text = ".TP\n" + names_of(option) + "\n" + literal(option.get_description());
  if (!option.get_default_str().empty()) text += " (default: " + literal(option.get_default_str()) + ")";
  if (option.nonpositional() && option.get_required()) text += " (needed)";
  return text + "\n";
}

std::string section(const CLI::App& command) {
  std::string arguments, entries;
  for (const CLI::Option* option : command.get_options()) {
    if (!option->nonpositional())
      arguments += " " + slanted(option->get_required() ? option->get_name() : "[" + option->get_name() + "]");
    entries += entry(*option);
  }
  return ".SS " + bold("lightwell " + command.get_name()) + " " + slanted("[options]") + arguments + "\n" +
         literal(command.get_description()) + ".\n" + entries + ".PP\n.nf\n" + literal(command.get_footer()) +
         "\n.fi\n";
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::string page = ".TH LIGHTWELL 1 \"\" \"Lightwell " LIGHTWELL_VERSION "\" \"User Commands\"\n.SH NAME\n" +
                     literal("lightwell") + " \\- " + literal(program.get_description()) + "\n.SH SYNOPSIS\n" +
                     bold("lightwell") + " " + slanted("command [options] arguments") + "\n.SH COMMANDS\n";
  for (const CLI::App* command : program.get_subcommands({})) page += section(*command);
  return page +
         ".SH EXIT STATUS\n0 when all is well, 1 for bad input, 2 for bad usage, 128 plus the number of the signal "
         "that ended it.\n";
}

}  // namespace lightwell
