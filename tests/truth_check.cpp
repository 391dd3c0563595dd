// SPDX-License-Identifier: BSD-3-Clause
//
// truth_check TABLE.csv: measures every law that the table's columns name and prints one line per law.
//   rows     rows of the table that ask the law for something inside its domain
//   solved   an answer: a value, or its absence: the opening is closed, there is no bridge
//   refused  the law refused, failed or gave no value
//   wrong    status differs from the table, a refusal inside the law's stated domain, or an error above
//            stated_accuracy · condition beyond the printed digits of the table; stderr names these rows. The condition
//            is that of support/condition.hpp for openings and of truth_check/bridge.cpp for bridges. Approximations
//            are held to the relative error of the force, on the table's rows and on a map of errors over their domain,
//            whose points are rows too; fits of the rupture gap likewise; a table of bridges to its error in its
//            largest force; a resistance to the relative error of each mode, in the unit that its law names
//   max_rel_err, p99_rel_err     relative error of the main results, as it stands
//   max_rel_err_per_condition    what stated_accuracy promises: the error beyond the table's digits over the condition
//   table_digits                 relative half unit of the table's last digit, the worst of the rows; only where the
//                                digits and not the law limit what can be seen
//   ns_per_call                  over the rows that are not wrong
//   outside                      rows that the law says it does not cover, which are not among its rows
// and further numbers of a family: of bridges under each control, of each mode of a resistance.
// Exit: 0 when nothing is wrong, 1 when something is, 2 when the table is not known.
#include "truth_check/tables.hpp"

#include <cstdio>
#include <exception>

namespace {

std::vector<truth_check::known_table> known_tables() {
  std::vector<truth_check::known_table> all;
  for (const auto& family :
       {truth_check::entry_tables(), truth_check::bridge_tables(), truth_check::lubrication_tables()}) {
    all.insert(all.end(), family.begin(), family.end());
  }
  return all;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: truth_check TABLE.csv\n");
    return 2;
  }
  try {
    const csv_table table(arguments[1]);
    for (const auto& known : known_tables()) {
      if (known.recognise(table)) {
        std::size_t wrong = 0;
        for (const auto& report : known.measure(table)) {
          wrong += print(report);
        }
        return wrong == 0 ? 0 : 1;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "truth_check: %s\n", error.what());
    return 2;
  }
  std::fprintf(stderr, "truth_check: %s is not a table that any law here knows; known are\n", arguments[1]);
  for (const auto& known : known_tables()) {
    std::fprintf(stderr, "  %s\n", known.name.c_str());
  }
  return 2;
}
