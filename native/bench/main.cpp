// SPDX-License-Identifier: GPL-3.0-or-later
//
// meander_bench: times the flow on generated surfaces and on a folder of models, through the C API
// of a library chosen at run time. docs/performance.md says how to read what it prints.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "cancel.h"
#include "library.h"
#include "report.h"

namespace meander::bench {
namespace {

constexpr const char* kUsage =
    "meander_bench [options]\n"
    "\n"
    "  --group G       models, generated, mesh, scaling, threads or cancel; may be given again\n"
    "                  (default: models and generated)\n"
    "  --case NAME     only this surface; may be given again\n"
    "  --preset P      only even, only paper or, in the groups models and cancel, only finest\n"
    "  --threads T     threads of the flow (default: the machine's); selects in the groups threads and cancel\n"
    "  --models DIR    folder of OBJ models; without it generated surfaces alone\n"
    "  --repeat N      runs of every case, each in a process of its own (default: 1)\n"
    "  --iterations N  iteration limit instead of the preset's\n"
    "  --cancels N     of every call in the group cancel (default: 200)\n"
    "  --most-nodes N  leave out cases of the group scaling with more nodes than this\n"
    "  --library PATH  the library to measure (default: the one of the same build)\n"
    "  --table         an aligned table instead of JSON lines; --both for JSON and a table on "
    "stderr\n"
    "  --list          only name the cases: group, case, preset, threads\n";

struct Arguments {
  std::vector<std::string> groups, names;
  std::string preset, models, library;
  uint32_t threads = 0, repeat = 1, iterations = 0, cancels = 200;
  double most_nodes = 0;
  bool table = false, both = false, list = false;
};

uint32_t positive(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (end == text.c_str() || *end != 0 || value < 1 || value > 1000000000) {
    throw std::runtime_error(option + " wants a positive number, not \"" + text + "\"");
  }
  return static_cast<uint32_t>(value);
}

Arguments parse(int count, char** values) {
  Arguments given;
  for (int i = 1; i < count; ++i) {
    const std::string option = values[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= count) throw std::runtime_error(option + " wants a value");
      return values[++i];
    };
    if (option == "--group")
      given.groups.push_back(value());
    else if (option == "--case")
      given.names.push_back(value());
    else if (option == "--preset")
      given.preset = value();
    else if (option == "--threads")
      given.threads = positive(option, value());
    else if (option == "--models")
      given.models = value();
    else if (option == "--repeat")
      given.repeat = positive(option, value());
    else if (option == "--iterations")
      given.iterations = positive(option, value());
    else if (option == "--cancels")
      given.cancels = positive(option, value());
    else if (option == "--most-nodes")
      given.most_nodes = positive(option, value());
    else if (option == "--library")
      given.library = value();
    else if (option == "--table")
      given.table = true;
    else if (option == "--both")
      given.both = true;
    else if (option == "--list")
      given.list = true;
    else if (option == "--help") {
      std::fputs(kUsage, stdout);
      std::exit(0);
    } else
      throw std::runtime_error("unknown option " + option + "; see --help");
  }
  return given;
}

bool contains(const std::vector<std::string>& list, const std::string& text) {
  for (const std::string& item : list) {
    if (item == text) return true;
  }
  return false;
}

std::vector<Case> chosen_cases(const Arguments& given) {
  const uint32_t threads =
      given.threads ? given.threads : std::max(1u, std::thread::hardware_concurrency());
  std::vector<Case> chosen;
  for (const Case& c : all_cases(given.models, threads)) {
    const bool in_group = given.groups.empty() ? c.group == "models" || c.group == "generated"
                                               : contains(given.groups, c.group);
    if (!in_group || (!given.names.empty() && !contains(given.names, c.name)) ||
        (!given.preset.empty() && c.preset != given.preset) ||
        (given.threads && c.threads != given.threads) ||
        (given.most_nodes > 0 && c.nodes > given.most_nodes)) {
      continue;
    }
    chosen.push_back(c);
  }
  if (chosen.empty())
    throw std::runtime_error("no case fits; --list names them, --models DIR adds models");
  return chosen;
}

int run(int count, char** values) {
  const Arguments given = parse(count, values);
  const std::vector<Case> cases = chosen_cases(given);
  if (given.list) {
    for (const Case& c : cases) {
      std::printf("%s %s %s %u\n", c.group.c_str(), c.name.c_str(), c.preset.c_str(), c.threads);
    }
    return 0;
  }
  const std::string library = given.library.empty() ? library_of_this_build() : given.library;
  std::FILE* table = given.table ? stdout : (given.both ? stderr : nullptr);
  if (table) print_table_heading(table);
  std::vector<Row> rows;
  bool failed = false;
  for (const Case& c : cases) {
    if (c.group == "cancel") {
      print_cancels(library, c, given.cancels);
      continue;
    }
    Row row{c, {}};
    for (uint32_t k = 0; k < given.repeat; ++k) {
      row.repeats.push_back(measure_apart(library, c, given.iterations));
      failed = failed || row.repeats.back().error[0] != 0;
    }
    if (table) print_table_line(table, row);
    if (!given.table) print_json(row);
    rows.push_back(std::move(row));
  }
  print_scaling_fit(rows);
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace meander::bench

int main(int count, char** values) {
  try {
    return meander::bench::run(count, values);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "meander_bench: %s\n", e.what());
    return 2;
  }
}
