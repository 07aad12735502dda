// SPDX-License-Identifier: GPL-2.0-or-later
// Which pairs act on which disc, in an order that depends on the ids of the partners alone.
#pragma once

#include "disc_pairs.h"

#include <algorithm>
#include <vector>

namespace cdem {

struct DiscForce {
  double fx, fy, torque;
};

class ForceSums {
public:
  // Discs 0 ... n-1 are summed. before(k, l) orders two pairs of one disc by the disc on the other side.
  template <class Before> void build(const DiscPairs &pairs, int n, Before before) {
    as_a.build(pairs.a, n);
    as_b.build(pairs.b, n);
    for (int d = 0; d < n; d++) {
      std::sort(as_a.begin(d), as_a.end(d), [&](int k, int l) { return before(pairs.b[k], pairs.b[l]); });
      std::sort(as_b.begin(d), as_b.end(d), [&](int k, int l) { return before(pairs.a[k], pairs.a[l]); });
    }
  }

  // Calls visit(k) for every pair k of a disc.
  template <class Visit> void for_each(int disc, Visit visit) const {
    std::for_each(as_b.begin(disc), as_b.end(disc), visit);
    std::for_each(as_a.begin(disc), as_a.end(disc), visit);
  }

  DiscForce operator()(const DiscPairs &pairs, int disc) const {
    DiscForce sum{0, 0, 0};
    for (auto k = as_b.begin(disc); k != as_b.end(disc); ++k) {
      sum.fx -= pairs.force[*k].fx;
      sum.fy -= pairs.force[*k].fy;
      sum.torque += pairs.force[*k].torque_b;
    }
    for (auto k = as_a.begin(disc); k != as_a.end(disc); ++k) {
      sum.fx += pairs.force[*k].fx;
      sum.fy += pairs.force[*k].fy;
      sum.torque += pairs.force[*k].torque_a;
    }
    return sum;
  }

private:
  // The pairs of each disc in one of the two roles, one disc after the other.
  struct Role {
    std::vector<int> first, pairs;

    int *begin(int d) { return pairs.data() + first[d]; }
    int *end(int d) { return pairs.data() + first[d + 1]; }
    const int *begin(int d) const { return pairs.data() + first[d]; }
    const int *end(int d) const { return pairs.data() + first[d + 1]; }

    void build(const std::vector<int> &disc_of_pair, int n) {
      first.assign(n + 1, 0);
      for (int d : disc_of_pair)
        if (d < n)
          first[d + 1]++;
      for (int d = 0; d < n; d++)
        first[d + 1] += first[d];
      pairs.resize(first[n]);
      std::vector<int> next(first.begin(), first.end() - 1);
      for (int k = 0; k < int(disc_of_pair.size()); k++)
        if (disc_of_pair[k] < n)
          pairs[next[disc_of_pair[k]]++] = k;
    }
  };

  Role as_a, as_b;
};

} // namespace cdem
