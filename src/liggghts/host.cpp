// SPDX-License-Identifier: GPL-2.0-or-later
#include "liggghts/host.h"

#include "comm.h"
#include "error.h"
#include "input.h"

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace Liggghts {

namespace {

// Names a private member: the arguments of an explicit instantiation are not checked for access (C++17, 17.7.2 (12)).
template <class Tag, typename Tag::Member member> struct Reach {
  friend typename Tag::Member member_of(Tag) { return member; }
};
struct FixTag {
  using Member = std::map<std::string, FixCreator> *LAMMPS_NS::Modify::*;
  friend Member member_of(FixTag);
};
struct CommandTag {
  using Member = std::map<std::string, CommandCreator> *LAMMPS_NS::Input::*;
  friend Member member_of(CommandTag);
};
template struct Reach<FixTag, &LAMMPS_NS::Modify::fix_map>;
template struct Reach<CommandTag, &LAMMPS_NS::Input::command_map>;

bool is_number(const std::string &word) {
  char *end;
  std::strtod(word.c_str(), &end);
  return !word.empty() && *end == 0;
}

} // namespace

std::map<std::string, FixCreator> &fix_styles(LAMMPS *lmp) { return *(lmp->modify->*member_of(FixTag())); }
std::map<std::string, CommandCreator> &commands(LAMMPS *lmp) { return *(lmp->input->*member_of(CommandTag())); }

void stop(LAMMPS *lmp, const std::string &message) {
  lmp->error->all(FLERR, message.c_str());
  std::abort(); // never reached: the line above ends the program
}

void tell(LAMMPS *lmp, const std::string &line) {
  if (lmp->comm->me != 0)
    return;
  for (std::FILE *file : {lmp->screen, lmp->logfile})
    if (file)
      std::fprintf(file, "%s\n", line.c_str());
}

std::string Words::word(const char *what) {
  if (done())
    stop(lmp, who, ": ", what, " is missing");
  return given[next++];
}

bool Words::number_follows() const { return !done() && is_number(given[next]); }

double Words::number(const char *what) {
  const std::string text = word(what);
  const double value = std::atof(text.c_str());
  if (!is_number(text) || !std::isfinite(value))
    stop(lmp, who, ": ", what, " is ", text, ", must be a finite number");
  return value;
}

double Words::positive(const char *what) {
  const double value = number(what);
  if (!(value > 0))
    stop(lmp, who, ": ", what, " ", value, ": must be positive");
  return value;
}

double Words::not_negative(const char *what) {
  const double value = number(what);
  if (!(value >= 0))
    stop(lmp, who, ": ", what, " ", value, ": must be 0 or more");
  return value;
}

int Words::count(const char *what) {
  const double value = number(what);
  if (!(value >= 1 && value <= 2147483647 && value == std::floor(value)))
    stop(lmp, who, ": ", what, " ", value, ": must be a whole number from 1 on");
  return int(value);
}

void Words::keyword(const char *expected) {
  const std::string found = word(expected);
  if (found != expected)
    stop(lmp, who, ": ", found, " where ", expected, " should be");
}

double over_ranks(LAMMPS *lmp, const cdem::ExactSum &mine) {
  cdem::ExactSum::Words words = mine.words();
  MPI_Allreduce(MPI_IN_PLACE, words.data(), int(words.size()), MPI_INT64_T, MPI_SUM, lmp->world);
  return cdem::ExactSum(words).value();
}

double smallest_of_ranks(LAMMPS *lmp, double mine) {
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MIN, lmp->world);
  return mine;
}

} // namespace Liggghts
