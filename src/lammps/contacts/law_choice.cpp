// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/law_choice.h"

#include "host/packed_state.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fmt/format.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

using namespace LAMMPS_NS;

namespace {

constexpr int VERSION = 1; // of the text in restart files

std::string joined(const std::vector<std::string> &words, const char *between) {
  std::string all;
  for (const std::string &word : words)
    all += (all.empty() ? "" : between) + word;
  return all;
}

// Names of all parameters, in the order of Coefficients::given: those of the contact law itself by name, others as
// addition.name.
std::vector<std::string> parameter_names() {
  std::vector<std::string> names;
  for (const auto &[group, parameters] : cdem::parameter_groups())
    for (const cdem::Parameter &p : parameters)
      names.push_back(group.empty() ? p.name : group + "." + p.name);
  return names;
}

std::vector<std::string> addition_names() {
  std::vector<std::string> names;
  for (const auto &group : cdem::parameter_groups())
    if (!group.name.empty())
      names.push_back(group.name);
  return names;
}

// The place of a law in accumulation_names(); -1 if there is none of this name.
int index_of_accumulation(const std::string &name) {
  const std::vector<std::string> all = cdem::accumulation_names();
  const auto found = std::find(all.begin(), all.end(), name);
  return found == all.end() ? -1 : int(found - all.begin());
}

// The bit of an addition in ContactRules::additions; 0 if there is none of this name.
unsigned bit_of_addition(const std::string &name) {
  const std::vector<std::string> all = addition_names();
  const auto found = std::find(all.begin(), all.end(), name);
  return found == all.end() ? 0 : 1u << (found - all.begin());
}

} // namespace

LawChoice::LawChoice(LAMMPS *lmp) : Pointers(lmp), instructions(cdem::instruction_sets().front()) {}

void LawChoice::read_style(int narg, char **arg) {
  bool law_given = false;
  instructions = cdem::instruction_sets().front();
  rules.limit_damping = false;
  const std::vector<std::string> laws = cdem::accumulation_names();
  for (int k = 0; k < narg; k += 2) {
    const std::string key = arg[k], value = k + 1 < narg ? arg[k + 1] : "nothing";
    if (key == "law") {
      rules.accumulation = index_of_accumulation(value);
      if (rules.accumulation < 0)
        error->all(FLERR, "Pair style cdem: law {}: must be {}", value, joined(laws, " or "));
      law_given = true;
    } else if (key == "limit_damping") {
      if (value != "yes" && value != "no")
        error->all(FLERR, "Pair style cdem: limit_damping {}: must be yes or no", value);
      rules.limit_damping = value == "yes";
    } else if (key == "instructions") {
      const std::vector<std::string> known = cdem::instruction_sets();
      if (std::find(known.begin(), known.end(), value) == known.end())
        error->all(FLERR, "Pair style cdem: instructions {}: this machine has {}", value, joined(known, ", "));
      instructions = value;
    } else {
      error->all(FLERR, "Pair style cdem: unknown keyword {}; allowed: law, limit_damping, instructions", key);
    }
  }
  if (!law_given)
    error->all(FLERR, "Pair style cdem: 'law {}' must be given", joined(laws, "' or 'law "));
}

cdem::Coefficients LawChoice::read_coefficients(int narg, char **arg) {
  const auto &own = cdem::parameter_groups().front().parameters;
  if (narg < int(own.size()))
    error->all(FLERR, "Pair coeff cdem has {} arguments; needed: I J kn ks hn hs phi", narg + 2);
  std::vector<double> given(parameter_names().size(), 0);
  for (std::size_t p = 0; p < own.size(); p++)
    given[p] = read_parameter(own[p], arg[p]);
  std::vector<std::string> seen;
  for (int iarg = int(own.size()); iarg < narg;) {
    const std::string name = arg[iarg++];
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      error->all(FLERR, "Pair coeff cdem: {} is given twice", name);
    seen.push_back(name);
    read_addition(name, narg, arg, iarg, given);
  }
  return cdem::Coefficients(given);
}

void LawChoice::read_addition(const std::string &name, int narg, char **arg, int &iarg, std::vector<double> &given) {
  if (!bit_of_addition(name))
    error->all(FLERR, "Pair coeff cdem: {} after kn ks hn hs phi: must be {}", name, joined(addition_names(), " or "));
  rules.additions |= bit_of_addition(name);
  std::size_t place = 0;
  for (const auto &[group, parameters] : cdem::parameter_groups())
    for (const cdem::Parameter &p : parameters) {
      if (group == name) {
        if (iarg == narg)
          error->all(FLERR, "Pair coeff cdem: {}: {} ({}) is missing", name, p.name, p.unit);
        given[place] = read_parameter(p, arg[iarg++]);
      }
      place++;
    }
}

double LawChoice::read_parameter(const cdem::Parameter &p, const char *word) const {
  const double value = utils::numeric(FLERR, word, false, lmp);
  if (!std::isfinite(value) || value < 0)
    error->all(FLERR, "Pair coeff cdem: {} = {} must be a number, not negative", p.name, word);
  if (value == 0 && !p.zero_allowed)
    error->all(FLERR, "Pair coeff cdem: {} = 0 must be positive", p.name);
  if (value >= p.below)
    error->all(FLERR, "Pair coeff cdem: {} = {} {} must be below {}", p.name, value, p.unit, p.below);
  return value;
}

void LawChoice::forget_coefficients() {
  const int n = atom->ntypes + 1;
  rules.additions = 0;
  coefficients.assign(n, std::vector<cdem::Coefficients>(n));
}

std::string LawChoice::text(int **is_set) const {
  std::vector<std::string> in_use;
  for (const std::string &name : addition_names())
    if (rules.additions & bit_of_addition(name))
      in_use.push_back(name);
  std::string text = fmt::format("law {}\nlimit_damping {}\nadditions {}\nparameters {}\n",
                                 cdem::accumulation_names()[rules.accumulation], int(rules.limit_damping),
                                 joined(in_use, " "), joined(parameter_names(), " "));
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (is_set[i][j]) {
        text += fmt::format("pair {} {}", i, j);
        for (double value : coefficients[i][j].given)
          text += fmt::format(" {:a}", value);
        text += '\n';
      }
  return text;
}

void LawChoice::write(FILE *file, int **is_set) const {
  const std::string all = text(is_set);
  const Shearbox::StateHead head{Shearbox::StateHead::MARK, VERSION, int(all.size())};
  fwrite(&head, sizeof(head), 1, file);
  fwrite(all.data(), 1, all.size(), file);
}

void LawChoice::read(FILE *file, int **is_set) {
  Shearbox::StateHead head{0, 0, 0};
  if (comm->me == 0)
    utils::sfread(FLERR, &head, sizeof(head), 1, file, nullptr, error);
  MPI_Bcast(&head, sizeof(head), MPI_BYTE, 0, world);
  if (head.mark != Shearbox::StateHead::MARK)
    refuse_file("its contact law has no version");
  if (head.version != VERSION || head.length < 0)
    refuse_file(fmt::format("its contact law is of version {}, {} is needed", head.version, VERSION));
  std::string all(head.length, ' ');
  if (comm->me == 0)
    utils::sfread(FLERR, all.data(), 1, all.size(), file, nullptr, error);
  MPI_Bcast(all.data(), head.length, MPI_CHAR, 0, world);
  forget_coefficients();
  take_text(all, is_set);
}

void LawChoice::refuse_file(const std::string &why) const {
  const std::string message = "Pair style cdem: the restart file is of another version of Shearbox: " + why;
  error->all(FLERR, message);
}

void LawChoice::take_text(const std::string &all, int **is_set) {
  const std::vector<std::string> known = parameter_names();
  std::vector<std::size_t> place; // index in `known` of each parameter in the file
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, word;
    words >> key;
    if (key == "law") {
      words >> word;
      rules.accumulation = index_of_accumulation(word);
      if (rules.accumulation < 0)
        refuse_file("it has law " + word);
    } else if (key == "limit_damping") {
      words >> rules.limit_damping;
    } else if (key == "additions") {
      while (words >> word) {
        rules.additions |= bit_of_addition(word);
        if (!bit_of_addition(word))
          refuse_file("it has an addition " + word);
      }
    } else if (key == "parameters") {
      while (words >> word) {
        place.push_back(std::find(known.begin(), known.end(), word) - known.begin());
        if (place.back() == known.size())
          refuse_file("it has a parameter " + word);
      }
    } else {
      int i = 0, j = 0;
      words >> i >> j;
      std::vector<double> given(known.size(), 0);
      for (std::size_t p : place) {
        words >> word;
        given[p] = std::strtod(word.c_str(), nullptr);
      }
      coefficients[i][j] = coefficients[j][i] = cdem::Coefficients(given);
      is_set[i][j] = 1;
    }
  }
}
