// SPDX-License-Identifier: GPL-2.0-or-later
// Chooses the time step of fix cdem/integrate, or checks the one that was given, against the stability limits of
// core/stability.h and core/contact_network.h; see fix_cdem_integrate.h.
#pragma once

#include "host/deck_words.h"
#include "motion/contact_limit.h"

#include "pointers.h"

namespace LAMMPS_NS {

class Fix;

class StepChoice : protected Pointers {
public:
  // `fix` sends the weights of ContactLimit to ghosts.
  StepChoice(LAMMPS *, Fix *fix);

  static constexpr const char *WORDS = "dt check|any|auto [MAX]|contacts [MAX]";

  // Reads what follows the word dt.
  void parse(Shearbox::DeckWords &);

  // An error if the present step is beyond what the rule allows, whoever has set it.
  void check() const;
  // When a run is prepared: computes the limit of the present scene, and chooses or checks the step by it.
  void init();
  // When grains have come into a run: whether they lower the limit, which is none without grains.
  bool sees_smaller_grains();
  // Whether that of `dt contacts` has yet to be chosen: not if that was done in an earlier run.
  bool is_to_be_chosen() const { return rule == Rule::contacts && kept_step == 0; }
  // When contacts are known: chooses it.
  void choose_by_contacts();
  void begin_run() { warned = false; }
  // Warns, once a run, if the step is beyond the limit of the present contacts.
  void compare_with_contacts();

  double scene_limit() const { return limit; }
  // Share of half a step by which the dashpots' velocity can be carried forward with the present step.
  double prediction_weight() const;

  ContactLimit contacts;
  double kept_step = 0; // what `dt contacts` has chosen (s), 0: nothing yet; in restart files

private:
  enum class Rule { check, any, automatic, contacts };

  template <class Value> double scene_minimum(Value) const;
  bool chooses() const { return rule == Rule::automatic || rule == Rule::contacts; }
  void apply();
  void refuse_beyond_limit() const;
  double at_most_max(double step) const;
  void set_step(double step);

  Rule rule = Rule::check;
  double max_step;
  double limit = 0;    // of the worst packing (s)
  bigint known = 0;    // number of grains and walls for which that is
  double chosen = 0;   // by this (s)
  bool warned = false; // in this run
};

} // namespace LAMMPS_NS
