// SPDX-License-Identifier: GPL-2.0-or-later
// Sums over all ranks, with the same bits for any number of them.
#pragma once

#include "core/exact_sum.h"

#include <mpi.h>

namespace Shearbox {

// Replaces `count` sums of this rank's terms by those of all ranks, in one message. All ranks must call it.
inline void add_ranks(cdem::ExactSum::Words *sums, int count, MPI_Comm world) {
  constexpr int PER_SUM = std::tuple_size_v<cdem::ExactSum::Words>;
  MPI_Allreduce(MPI_IN_PLACE, sums, PER_SUM * count, MPI_INT64_T, MPI_SUM, world);
}

inline double over_ranks(const cdem::ExactSum &mine, MPI_Comm world) {
  cdem::ExactSum::Words words = mine.words();
  add_ranks(&words, 1, world);
  return cdem::ExactSum(words).value();
}

} // namespace Shearbox
