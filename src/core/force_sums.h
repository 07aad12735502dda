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
    as_a.build(pairs, pairs.a, n);
    as_b.build(pairs, pairs.b, n);
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

  // First the forces of the pairs in which it is disc b, then those in which it is disc a.
  DiscForce operator()(const DiscPairs &pairs, int disc) const {
    const Forces<double> b = as_b.sum(pairs, disc), a = as_a.sum(pairs, disc);
    return {a.fx - b.fx, a.fy - b.fy, a.torque_a + b.torque_b};
  }

  double bytes() const { return as_a.bytes() + as_b.bytes(); }

private:
  // The pairs of each disc in one of the two roles, one disc after the other.
  struct Role {
    std::vector<int> first, pairs;

    int *begin(int d) { return pairs.data() + first[d]; }
    int *end(int d) { return pairs.data() + first[d + 1]; }
    const int *begin(int d) const { return pairs.data() + first[d]; }
    const int *end(int d) const { return pairs.data() + first[d + 1]; }

    // A row of forces is summed as two vectors; the two sums that a role has no use for come along.
    Forces<double> sum(const DiscPairs &p, int d) const {
      using Two = double __attribute__((vector_size(2 * sizeof(double)), may_alias));
      const auto *const halves = reinterpret_cast<const Two *>(p.force.data());
      Two force{}, torque{};
      for (const int *k = begin(d), *last = end(d); k != last; ++k) {
        force += halves[2 * *k];
        torque += halves[2 * *k + 1];
      }
      return {force[0], force[1], torque[0], torque[1]};
    }

    void build(const DiscPairs &p, const Column<int> &disc_of_pair, int n) {
      first.assign(n + 1, 0);
      p.for_each([&](int k, const Material &) {
        if (disc_of_pair[k] < n)
          first[disc_of_pair[k] + 1]++;
      });
      for (int d = 0; d < n; d++)
        first[d + 1] += first[d];
      pairs.resize(first[n]);
      next.assign(first.begin(), first.end() - 1);
      p.for_each([&](int k, const Material &) {
        if (disc_of_pair[k] < n)
          pairs[next[disc_of_pair[k]]++] = k;
      });
    }

    double bytes() const { return double(first.capacity() + pairs.capacity() + next.capacity()) * sizeof(int); }

    std::vector<int> next; // of build()
  };

  Role as_a, as_b;
};

} // namespace cdem
