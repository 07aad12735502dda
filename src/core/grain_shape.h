// SPDX-License-Identifier: GPL-2.0-or-later
// A rigid grain made of discs: where the discs are relative to the centre of mass, and area, inertia and surface of
// their union.
//
// Everything follows from the boundary of the union, which consists of arcs, by Green's theorem:
//   area     = 1/2 integral of x dy - y dx
//   centre_x = 1/2 integral of x^2 dy / area,   centre_y = -1/2 integral of y^2 dx / area
//   polar second moment = 1/3 integral of x^3 dy - y^3 dx
// Each integrand is a polynomial in cos and sin of the arc's angle, so the result is exact to round-off, and overlaps
// count once.
//
// A template may also be a piece of a straight wall (wall_line.h).
#pragma once

#include "outline.h"
#include "wall_line.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cdem {

class GrainShape {
public:
  struct Member {
    double x, y, r;
  };

  static constexpr std::size_t MOST_DISCS = 1000;

  // The discs may be in any unit and at any position. Throws std::invalid_argument, which says what is wrong with them.
  explicit GrainShape(const std::vector<Member> &given) : members(given) {
    check();
    bring_near();
    shift_to_centre();
    scale_to_unit_radius();
    const Moments m = moments();
    unit_area = m.area;
    unit_inertia = m.polar / m.area;
    if (members.size() == 1) { // the same without round-off
      members = {{0, 0, 1}};
      unit_area = M_PI;
      unit_inertia = 0.5;
    }
    survey_surface();
    for (std::size_t k = 0; k < members.size(); k++)
      for (const Arc &arc : exposed(k))
        rim.push_back({members[k].x, members[k].y, members[k].r, arc.from, arc.to});
    for (const Member &d : members)
      furthest = std::max(furthest, std::hypot(d.x, d.y));
  }

  static GrainShape single() { return GrainShape({{0, 0, 1}}); }

  // Three equal discs, each touching the other two.
  static GrainShape triple() {
    const double height = std::sqrt(3.0);
    return GrainShape({{-1, 0, 1}, {1, 0, 1}, {0, height, 1}});
  }

  // A piece of a straight wall along a unit vector. Half its length and the radius of its ends are half of the
  // circumscribed radius. It is always part of a wall, which does not turn.
  static GrainShape line(double ux, double uy) {
    GrainShape piece = single();
    piece.members.front().r = 0.5;
    piece.unit_area = 1 + M_PI / 4;
    piece.unit_inertia = INFINITY;
    piece.direction = {ux, uy};
    return piece;
  }
  bool is_line() const { return direction.has_value(); }
  // Only of a piece of a wall: its axis, when it is scaled to this radius (m).
  WallLine axis(double radius) const { return {direction->x, direction->y, 0.5 * radius}; }

  // Relative to the centre of mass, in units of the circumscribed radius (the largest distance from centre to rim).
  const std::vector<Member> &discs() const { return members; }
  double area() const { return unit_area; } // over radius^2
  const Outline &outline() const { return rim; }
  double inertia() const { return unit_inertia; } // over mass radius^2

  // For the stability limit: how many neighbours of the size of the grain's own discs fit around it (six around a
  // disc); how unevenly their directions phi are distributed, |sum of exp(2 i phi)|; and the sums over them of the
  // squared lever arms of the normal and of the tangential force, over radius^2.
  double neighbours() const { return surface.neighbours; }
  double unevenness() const { return std::hypot(surface.cos2, surface.sin2); }
  double normal_levers() const { return surface.normal; }
  double tangential_levers() const { return surface.tangential; }

  // Largest distance of a disc centre from the centre of mass, over the circumscribed radius.
  double reach() const { return furthest; }

private:
  struct Arc {
    double from, to;
  };
  struct Moments {
    double area, x, y, polar;
  };
  struct Surface {
    double neighbours, cos2, sin2, normal, tangential;
  };

  static constexpr double TOUCHING = 1e-6; // largest gap, over the smaller radius, at which two discs count as joined

  static std::string name(std::size_t k) { return "disc " + std::to_string(k + 1); }

  void check() const {
    if (members.empty())
      throw std::invalid_argument("it has no discs");
    if (members.size() > MOST_DISCS)
      throw std::invalid_argument("it has " + std::to_string(members.size()) + " discs, at most " +
                                  std::to_string(MOST_DISCS) + " are allowed");
    for (std::size_t k = 0; k < members.size(); k++) {
      const Member &d = members[k];
      if (!std::isfinite(d.x) || !std::isfinite(d.y) || !std::isfinite(d.r))
        throw std::invalid_argument(name(k) + " has a coordinate or radius that is not a finite number");
      if (!(d.r > 0)) {
        std::ostringstream what;
        what << name(k) << " has radius " << d.r << ", must be positive";
        throw std::invalid_argument(what.str());
      }
      for (std::size_t l = 0; l < members.size(); l++)
        if (l != k && lies_inside(d, members[l]))
          throw std::invalid_argument(name(k) + " is a duplicate of, or lies inside, " + name(l));
      for (std::size_t l = 0; l < k; l++)
        if (hardly_differs(d, members[l]))
          throw std::invalid_argument(name(k) + " nearly coincides with " + name(l) +
                                      ": distance of centres and "
                                      "difference of radii must add up to 2 % of the smaller radius");
    }
    check_connected();
  }

  static bool lies_inside(const Member &inner, const Member &outer) {
    return std::hypot(inner.x - outer.x, inner.y - outer.y) + inner.r <= outer.r * (1 + 1e-12);
  }

  // Discs of two grains that overlap by delta touch within sqrt(2 (r1 + r2) delta) of the point that is closest. Two
  // discs of a grain that are both within it act as one of twice the stiffness, which the stability limit does not
  // know.
  static bool hardly_differs(const Member &a, const Member &b) {
    constexpr double LEAST = 0.02; // of the radius: overlaps of 1e-4 radii
    return std::hypot(a.x - b.x, a.y - b.y) + std::fabs(a.r - b.r) < LEAST * std::min(a.r, b.r);
  }

  static bool joined(const Member &a, const Member &b) {
    return std::hypot(a.x - b.x, a.y - b.y) <= a.r + b.r + TOUCHING * std::min(a.r, b.r);
  }

  void check_connected() const {
    std::vector<bool> reached(members.size(), false);
    std::vector<std::size_t> open{0};
    reached[0] = true;
    while (!open.empty()) {
      const std::size_t k = open.back();
      open.pop_back();
      for (std::size_t l = 0; l < members.size(); l++)
        if (!reached[l] && joined(members[k], members[l])) {
          reached[l] = true;
          open.push_back(l);
        }
    }
    const auto apart = std::find(reached.begin(), reached.end(), false);
    if (apart != reached.end())
      throw std::invalid_argument(name(apart - reached.begin()) + " is disconnected from disc 1");
  }

  // The arcs of disc k, as angles, that no other disc covers, with all radii larger by `grow`.
  std::vector<Arc> exposed(std::size_t k, double grow = 0) const {
    const Member &d = members[k];
    const double r = d.r + grow;
    std::vector<Arc> covered;
    for (std::size_t l = 0; l < members.size(); l++) {
      if (l == k)
        continue;
      const double dx = members[l].x - d.x, dy = members[l].y - d.y, distance = std::hypot(dx, dy),
                   other = members[l].r + grow;
      if (distance >= r + other)
        continue;
      const double middle = std::atan2(dy, dx);
      const double half = std::acos((distance * distance + r * r - other * other) / (2 * distance * r));
      add_within_turn(covered, middle - half, middle + half);
    }
    std::sort(covered.begin(), covered.end(), [](const Arc &a, const Arc &b) { return a.from < b.from; });
    std::vector<Arc> free;
    double at = -M_PI;
    for (const Arc &c : covered) {
      if (c.from > at)
        free.push_back({at, c.from});
      at = std::max(at, c.to);
    }
    if (at < M_PI)
      free.push_back({at, M_PI});
    if (free.size() > 1 && free.front().from == -M_PI && free.back().to == M_PI) { // one arc, cut at +-pi
      free.back().to = free.front().to + 2 * M_PI;
      free.erase(free.begin());
    }
    return free;
  }

  // Adds an arc, cut in two at +-pi if it passes that angle.
  static void add_within_turn(std::vector<Arc> &arcs, double from, double to) {
    if (from < -M_PI) {
      arcs.push_back({from + 2 * M_PI, M_PI});
      from = -M_PI;
    }
    if (to > M_PI) {
      arcs.push_back({-M_PI, to - 2 * M_PI});
      to = M_PI;
    }
    arcs.push_back({from, to});
  }

  // Integrals of cos^n over an arc, n = 1 ... 4. Those of sin^n are the same for the arc turned back by pi/2.
  struct Powers {
    double c1, c2, c3, c4;

    Powers(double from, double to) {
      auto difference = [=](auto f) { return f(to) - f(from); };
      c1 = difference([](double t) { return std::sin(t); });
      c2 = difference([](double t) { return t / 2 + std::sin(2 * t) / 4; });
      c3 = difference([](double t) { return std::sin(t) - std::pow(std::sin(t), 3) / 3; });
      c4 = difference([](double t) { return 3 * t / 8 + std::sin(2 * t) / 4 + std::sin(4 * t) / 32; });
    }
  };

  static Moments arc_moments(const Member &d, const Arc &arc) {
    const Powers c(arc.from, arc.to), s(arc.from - M_PI / 2, arc.to - M_PI / 2);
    const double r = d.r, r2 = r * r, r3 = r2 * r, r4 = r2 * r2;
    auto first = [=](double at, const Powers &p) { return at * r * p.c1 + r2 * p.c2; };
    auto second = [=](double at, const Powers &p) { return at * at * r * p.c1 + 2 * at * r2 * p.c2 + r3 * p.c3; };
    auto third = [=](double at, const Powers &p) {
      return at * at * at * r * p.c1 + 3 * at * at * r2 * p.c2 + 3 * at * r3 * p.c3 + r4 * p.c4;
    };
    return {(first(d.x, c) + first(d.y, s)) / 2, second(d.x, c) / 2, second(d.y, s) / 2,
            (third(d.x, c) + third(d.y, s)) / 3};
  }

  Moments moments() const {
    Moments sum{0, 0, 0, 0};
    for (std::size_t k = 0; k < members.size(); k++)
      for (const Arc &arc : exposed(k)) {
        const Moments m = arc_moments(members[k], arc);
        sum.area += m.area;
        sum.x += m.x;
        sum.y += m.y;
        sum.polar += m.polar;
      }
    return sum;
  }

  // Takes the first disc as origin and the largest radius as unit: otherwise the moments of a template far from the
  // origin would lose digits.
  void bring_near() {
    const Member origin = members.front();
    double unit = 0;
    for (const Member &d : members)
      unit = std::max(unit, d.r);
    for (Member &d : members)
      d = {(d.x - origin.x) / unit, (d.y - origin.y) / unit, d.r / unit};
  }

  void shift_to_centre() {
    const Moments m = moments();
    for (Member &d : members) {
      d.x -= m.x / m.area;
      d.y -= m.y / m.area;
    }
  }

  void scale_to_unit_radius() {
    double radius = 0;
    for (const Member &d : members)
      radius = std::max(radius, std::hypot(d.x, d.y) + d.r);
    for (Member &d : members)
      d = {d.x / radius, d.y / radius, d.r / radius};
  }

  // Neighbours are of a disc's own size, with centres where no other disc is in the way, and at least 60 degrees apart:
  // six around a full turn; on an arc, one more than there are gaps of 60 degrees. Lever arms: |o x n| of the normal
  // force, o.n + r of the tangential force, where o is the offset of the disc and n the direction of the neighbour.
  void survey_surface() {
    surface = {0, 0, 0, 0, 0};
    for (std::size_t k = 0; k < members.size(); k++) {
      const Member &d = members[k];
      const double offset = std::hypot(d.x, d.y), towards = std::atan2(d.y, d.x);
      for (const Arc &arc : exposed(k, d.r)) {
        const Neighbours n(arc);
        const double along = n.cosine(1, towards), twice = n.cosine(2, towards);
        surface.neighbours += n.count;
        surface.cos2 += n.cosine(2, 0);
        surface.sin2 += n.cosine(2, M_PI / 4);
        surface.normal += offset * offset * (n.count - twice) / 2;
        surface.tangential += d.r * d.r * n.count + 2 * d.r * offset * along + offset * offset * (n.count + twice) / 2;
      }
    }
  }

  // Neighbours 60 degrees apart, from one end of an arc to the other; around a full turn one less, since its ends
  // coincide. If their number is not an integer, sums over them are taken over an even distribution, which gives the
  // same sums for integers.
  struct Neighbours {
    double from, to, count;

    explicit Neighbours(const Arc &arc) {
      const double margin = arc.to - arc.from < 2 * M_PI ? M_PI / 6 : 0;
      from = arc.from - margin;
      to = arc.to + margin;
      count = 3 / M_PI * (to - from);
    }

    // Sum over the neighbours of cos(n (phi - zero)). In the integral over the arc each neighbour is spread over 60
    // degrees, which weakens the cosine by a known factor.
    double cosine(int n, double zero) const {
      const double weakened = std::sin(n * M_PI / 6) / (n * M_PI / 6);
      return 3 / M_PI * (std::sin(n * (to - zero)) - std::sin(n * (from - zero))) / n / weakened;
    }
  };

  struct Direction {
    double x, y;
  };

  std::vector<Member> members;
  std::optional<Direction> direction; // of a piece of a wall
  double unit_area, unit_inertia, furthest = 0;
  Outline rim;
  Surface surface;
};

} // namespace cdem
