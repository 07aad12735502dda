// SPDX-License-Identifier: GPL-2.0-or-later
#include "law_table.h"

#include "laws.h"

#include <algorithm>
#include <cmath>

namespace cdem {

namespace {

constexpr double DEGREE = M_PI / 180;
enum Own { KN, KS, HN, HS, PHI, OWN }; // the contact law's own parameters
const std::vector<Parameter> OWN_PARAMETERS = {
    {"kn", "N/m", false}, {"ks", "N/m"}, {"hn", "1"}, {"hs", "1"}, {"phi", "degrees", true, 90}};

constexpr Remembered TANGENTIAL_SPRING{"es", "N"};

// Calls visit(addition, index of its first parameter, of its first constant) for the additions in use.
template <class Visit> void for_each_addition(const ContactRules &rules, Visit visit) {
  int constant = 0, parameter = OWN;
  unsigned bit = 1;
  auto step = [&](auto addition) {
    if (rules.additions & bit) {
      visit(addition, parameter, constant);
      constant += addition.CONSTANTS;
    }
    parameter += int(addition.PARAMETERS.size());
    bit <<= 1;
  };
  std::apply([&](auto... addition) { (step(addition), ...); }, Additions());
}

} // namespace

std::vector<std::string> accumulation_names() {
  std::vector<std::string> names;
  std::apply([&](auto... accumulation) { (names.push_back(accumulation.NAME), ...); }, Accumulations());
  return names;
}

std::vector<std::string> all_remembered() {
  std::vector<std::string> names{TANGENTIAL_SPRING.name};
  auto add = [&](const auto &remembered) {
    for (const Remembered &r : remembered)
      names.push_back(r.name);
  };
  std::apply([&](auto... accumulation) { (add(accumulation.REMEMBERS), ...); }, Accumulations());
  std::apply([&](auto... addition) { (add(addition.REMEMBERS), ...); }, Additions());
  return names;
}

const std::vector<ParameterGroup> &parameter_groups() {
  static const std::vector<ParameterGroup> groups = [] {
    std::vector<ParameterGroup> all{{"", OWN_PARAMETERS}};
    auto add = [&](auto addition) {
      all.push_back({addition.NAME, {addition.PARAMETERS.begin(), addition.PARAMETERS.end()}});
    };
    std::apply([&](auto... addition) { (add(addition), ...); }, Additions());
    return all;
  }();
  return groups;
}

Coefficients::Coefficients(std::vector<double> values)
    : given(std::move(values)),
      material(cdem::material(given[KN], given[KS], given[HN], given[HS], std::tan(given[PHI] * DEGREE))) {}

LawTable::LawTable(const ContactRules &r) : rules(r), names{TANGENTIAL_SPRING} {
  with_law(rules, [this](auto law) { counts = {law.CONSTANTS, law.BOOKS}; });
  int place = 0;
  auto add = [this](const auto &remembered) { names.insert(names.end(), remembered.begin(), remembered.end()); };
  auto add_if_in_use = [&](auto accumulation) {
    if (place++ == rules.accumulation)
      add(accumulation.REMEMBERS);
  };
  std::apply([&](auto... accumulation) { (add_if_in_use(accumulation), ...); }, Accumulations());
  for_each_addition(rules, [&](auto addition, int, int) { add(addition.REMEMBERS); });
}

void LawTable::set_constants(const Coefficients &c, const TwoGrains &grains, double *constants) const {
  for_each_addition(rules, [&](auto addition, int parameter, int constant) {
    addition.set_constants(&c.given[parameter], c.material, grains, constants + constant);
  });
}

Resistance LawTable::added_resistance(const double *constants) const {
  Resistance sum;
  for_each_addition(rules, [&](auto addition, int, int constant) { addition.resist(constants + constant, sum); });
  return sum;
}

Resistance LawTable::added_resistance(const Coefficients &c, const TwoGrains &grains) const {
  std::array<double, MOST_NUMBERS> constants;
  set_constants(c, grains, constants.data());
  return added_resistance(constants.data());
}

LawTable::Energy LawTable::energy(const Material &m, const double *constants, const double *remembered,
                                  double overlap) const {
  return with_law(rules, [&](auto law) { return law.template energy<Energy>(m, constants, remembered, overlap); });
}

double LawTable::finish_books(const Contact<double> &c, double dt, double *dashpots) const {
  return with_law(rules, [&](auto law) {
    typename decltype(law)::template Books<double> books{0, 0, dashpots[0], dashpots[1]};
    std::copy_n(dashpots + 2, law.BOOKS, books.more.begin());
    law.finish_books(c, dt, books);
    std::fill_n(dashpots, 2 + law.BOOKS, 0.0);
    return books.dashpots;
  });
}

} // namespace cdem
