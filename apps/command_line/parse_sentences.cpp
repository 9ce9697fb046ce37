// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/parse_sentences.h"

#include "command_line/did_you_mean.h"
#include "report/text.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

/** \brief All names of options as they are typed: "--output", "-o". */
std::vector<std::string> namesOf(const CLI::App& cli) {
  std::vector<std::string> names;
  for (const CLI::Option* option : cli.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
    for (const std::string& name : option->get_snames())
      names.push_back("-" + name);
  }
  return names;
}

bool isName(const std::string& word, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

/** \brief The option that a message of the parser is about, nullptr if it is about
 * none. \param[in] message starts with the option's name */
const CLI::Option* optionOf(const std::string& message, const CLI::App& cli) {
  const CLI::Option* found = nullptr;
  for (const CLI::Option* option : cli.get_options()) {
    const std::string name = option->get_name();
    if (message.compare(0, name.size(), name) != 0 || message.size() == name.size())
      continue;
    const char next = message[name.size()];
    if ((next == ':' || next == ' ') &&
        (found == nullptr || name.size() > found->get_name().size()))
      found = option;
  }
  return found;
}

std::string nameOf(const CLI::Option& option) {
  return option.get_positional() ? option.get_single_name() : option.get_name();
}

/** \brief What kind of value an option takes: "FILE", "X,Y,W,H", "a number". */
std::string kindOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string kind = type.substr(0, type.find(':'));
  return kind == "INT" || kind == "UINT" || kind == "FLOAT" ? "a number"
         : kind == "TEXT"                                   ? "a value"
                                                            : kind;
}

/** \brief What the user wrote for an option, up to the next option. */
std::string given(const CLI::Option& option, const std::vector<std::string>& names) {
  std::string values;
  for (const std::string& value : option.results()) {
    if (isName(value, names))
      break;
    values += (values.empty() ? "" : ",") + value;
  }
  return values;
}

/** \brief "--roi wants X,Y,W,H, 4 values, not '1,2,3'". */
std::string wrongCount(const CLI::Option& option, const CLI::App& cli) {
  const int count = option.get_items_expected_min();
  const std::vector<std::string> names = namesOf(cli);
  const std::string values = given(option, names);
  if (count == option.get_items_expected_max() && count <= 1 &&
      option.results().size() > 1)
    return nameOf(option) + " is given " + std::to_string(option.results().size()) +
           " times; give it once";
  std::string sentence = nameOf(option) + " wants " + kindOf(option);
  if (count > 1)
    sentence += " (" + std::to_string(count) + " values)";
  return sentence +
         (values.empty() ? ", but nothing follows it" : ", not " + app::quoted(values));
}

/** \brief Whether another option's name stands among an option's several values. */
bool endsEarly(const CLI::Option& option, const CLI::App& cli) {
  const std::vector<std::string> names = namesOf(cli);
  return option.get_items_expected_min() > 1 &&
         std::any_of(
             option.results().begin(),
             option.results().end(),
             [&names](const std::string& value) { return isName(value, names); });
}

/** \brief An argument that no option and no place takes. */
std::string unknownArgument(const std::vector<std::string>& extras,
                            const CLI::App& cli) {
  for (std::string extra : extras)
    if (extra.size() > 1 && extra[0] == '-') {
      extra = extra.substr(0, extra.find('='));
      return "there is no option " + app::quoted(extra) +
             didYouMean(extra, namesOf(cli));
    }
  return app::quoted(extras.empty() ? std::string() : extras.front()) +
         " is one argument too many";
}

/** \brief What follows a mark in a message. */
std::string behind(const std::string& message, const std::string& mark) {
  const std::size_t at = message.find(mark);
  return at == std::string::npos ? message : message.substr(at + mark.size());
}

std::string missing(const std::string& message, const CLI::App& cli) {
  const std::vector<std::string> extras = cli.remaining();
  if (std::any_of(extras.begin(), extras.end(), [](const std::string& extra) {
        return extra.size() > 1 && extra[0] == '-';
      }))
    return unknownArgument(extras, cli); // what is missing may be behind a misspelt one
  const CLI::Option* option = optionOf(message, cli);
  if (option == nullptr)
    return "something is missing";
  std::string wanted = option->get_description();
  wanted = wanted.substr(0, wanted.find_first_of(";("));
  return (option->get_positional() ? kindOf(*option)
                                   : option->get_name() + " " + kindOf(*option)) +
         " is missing (" + wanted + ")";
}

} // namespace

std::string sentenceFor(const CLI::ParseError& error, const CLI::App& cli) {
  const std::string message = error.what();
  const auto is = [&error](auto* kind) {
    return dynamic_cast<decltype(kind)>(&error) != nullptr;
  };
  if (is(static_cast<const CLI::ExtrasError*>(nullptr)))
    return unknownArgument(cli.remaining(), cli);
  if (is(static_cast<const CLI::RequiredError*>(nullptr)))
    return missing(message, cli);
  if (is(static_cast<const CLI::ConfigError*>(nullptr))) {
    if (message.find("not allowed in a") != std::string::npos)
      return "the --config file has " +
             app::quoted(message.substr(0, message.find(':'))) +
             ", which belongs on the command line";
    const std::string key = behind(message, "parse ");
    const std::size_t section = key.find(".++"); // where CLI11 begins one
    if (section != std::string::npos)
      return "the --config file has a section " +
             app::quoted("[" + key.substr(0, section) + "]") +
             "; options stand without one";
    return "the --config file has " + app::quoted(key) +
           ", but there is no such option" + didYouMean(key, namesOf(cli));
  }
  if (is(static_cast<const CLI::FileError*>(nullptr)))
    return "the --config file cannot be read; check its name";
  const bool conversion = is(static_cast<const CLI::ConversionError*>(nullptr));
  const CLI::Option* option =
      optionOf(conversion ? behind(message, "Could not convert: ") : message, cli);
  if (option == nullptr)
    return "a value is not of the kind that its option wants";
  if (conversion || is(static_cast<const CLI::ArgumentMismatch*>(nullptr)) ||
      endsEarly(*option, cli))
    return wrongCount(*option, cli);
  // our own checks read on from the name
  const std::string text = behind(message, option->get_name() + ": ");
  return nameOf(*option) + (text.compare(0, 6, "wants ") == 0 ? " " : ": ") + text;
}

void checkValues(CLI::App& cli) {
  const std::vector<std::string> names = namesOf(cli);
  for (CLI::Option* option : cli.get_options()) {
    if (option->get_items_expected_max() == 0) { // a flag
      option->check(CLI::Validator(
          [](std::string& value) {
            return value == "true" || value == "false"
                       ? std::string()
                       : "wants no value, but " + app::quoted(value) + " is given";
          },
          ""));
      continue;
    }
    const std::string kind = kindOf(*option);
    const bool names_file = kind == "FILE" || kind == "DIR";
    option->check(CLI::Validator(
        [names, kind, names_file](std::string& value) {
          if (names_file && value.empty()) // such as a variable of the shell
            return "wants " + kind + ", not an empty name";
          return isName(value, names)
                     ? "wants " + kind + ", but " + app::quoted(value) + " follows it"
                     : std::string();
        },
        ""));
    if (option->get_items_expected_max() < CLI::detail::expected_max_vector_size)
      option->allow_extra_args(false);
  }
}

} // namespace pcl_sq::app
