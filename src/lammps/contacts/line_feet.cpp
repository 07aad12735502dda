// SPDX-License-Identifier: GPL-2.0-or-later
#include "contacts/line_feet.h"

#include "atom.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

namespace {
// Whether a foot is at an end of its piece, where rounding may matter.
bool is_end(double along, const cdem::WallLine &line) { return std::fabs(along) >= (1 - 1e-9) * line.half; }
} // namespace

void LineFeet::take_over(cdem::DiscPairs &pairs) {
  feet.clear();
  first_of_block.assign(1, 0);
  std::vector<int> piece_of_foot;
  for (std::size_t block = 0; block + 1 < pairs.first_segment.size(); block++) {
    pairs.for_each_of_block(int(block), [&](int k) {
      const int a = pairs.a(k), b = pairs.b(k);
      if (!rows.is_line(a) && !rows.is_line(b))
        return;
      const int piece = rows.is_line(a) ? a : b;
      feet.push_back({a + b - piece, piece, k, rows.line(piece), &beside[piece], true});
      piece_of_foot.push_back(piece);
    });
    first_of_block.push_back(int(feet.size()));
  }
  rows.make_feet(piece_of_foot);
  for (std::size_t n = 0; n < feet.size(); n++) {
    const int k = feet[n].pair, row = rows.foot_row(int(n));
    const bool piece_is_a = pairs.a(k) == feet[n].piece;
    pairs.set_discs(k, piece_is_a ? row : feet[n].disc, piece_is_a ? feet[n].disc : row);
  }
}

// Pieces are sorted by their place along the diagonal, which tells apart those of upright and of flat walls alike: only
// few lie so close there that they may meet, so the work grows with the number of pieces, not with its square.
void LineFeet::find_joints() {
  struct Piece {
    double place;
    cdem::WallLine line;
    int row;
  };
  std::vector<Piece> pieces;
  double longest = 0;
  for (int row = 0; row < rows.rows_of(atom->nlocal + atom->nghost); row++)
    if (rows.is_line(row)) {
      pieces.push_back({(rows[row].x + rows[row].y) * M_SQRT1_2, rows.line(row), row});
      longest = std::max(longest, pieces.back().line.half);
    }
  std::sort(pieces.begin(), pieces.end(), [](const Piece &a, const Piece &b) { return a.place < b.place; });

  beside.clear();
  const double far = neighbor->skin; // no further do two rows move towards each other until LAMMPS's next list
  for (auto p = pieces.begin(); p != pieces.end(); ++p)
    for (auto q = p + 1; q != pieces.end() && q->place - p->place < p->line.half + longest + M_SQRT2 * far; ++q)
      if (ends_at(q->row, point_of(p->row, p->line, p->line.half), far) ||
          ends_at(q->row, point_of(p->row, p->line, -p->line.half), far)) {
        beside[p->row].push_back(q->row);
        beside[q->row].push_back(p->row);
      }
}

GrainRows::Vector LineFeet::point_of(int row, const cdem::WallLine &line, double along) const {
  return {rows[row].x + along * line.ux, rows[row].y + along * line.uy};
}

bool LineFeet::ends_at(int row, GrainRows::Vector place, double tolerance) const {
  const auto [ux, uy, half] = rows.line(row);
  const double dx = place.x - rows[row].x, dy = place.y - rows[row].y;
  return std::fabs(std::fabs(dx * ux + dy * uy) - half) < tolerance && std::fabs(dx * uy - dy * ux) < tolerance;
}

void LineFeet::place_all() {
  for (std::size_t block = 0; block + 1 < first_of_block.size(); block++)
    place(int(block));
}

void LineFeet::place(int block) {
  constexpr double FAR = 1e6; // times the distance of the disc from its foot
  for (int n = first_of_block[block]; n < first_of_block[block + 1]; n++) {
    Foot &f = feet[n];
    const cdem::Disc<double> &disc = rows[f.disc], &centre = rows[f.piece];
    const double along = cdem::along_line(disc, centre, f.line);
    cdem::Disc<double> &foot = rows.foot(n) = cdem::foot_at(along, disc, centre, f.line);
    f.acts = acts(f, along);
    if (f.acts)
      continue;
    foot.x = disc.x + FAR * (foot.x - disc.x);
    foot.y = disc.y + FAR * (foot.y - disc.y);
  }
}

void LineFeet::take_over_contacts(int block, cdem::DiscPairs &pairs, double dt) const {
  for (int n = first_of_block[block]; n < first_of_block[block + 1]; n++) {
    const int k = feet[n].pair;
    if (!feet[n].acts)
      pairs.set_es(k, 0);
    else if (pairs.es(k) == ELSEWHERE)
      pairs.set_es(k, overlap_before(pairs, k, dt) > 0 ? cdem::TOUCHING : 0);
  }
}

void LineFeet::remember_elsewhere(int block, cdem::DiscPairs &pairs) const {
  for (int n = first_of_block[block]; n < first_of_block[block + 1]; n++)
    if (!feet[n].acts)
      pairs.set_es(feet[n].pair, ELSEWHERE);
}

// One step ago (m).
double LineFeet::overlap_before(const cdem::DiscPairs &pairs, int k, double dt) const {
  const auto relative = cdem::relative(rows[pairs.a(k)], rows[pairs.b(k)]);
  return cdem::contact_of(relative, cdem::distance_of(relative), pairs.constants(k), dt).before;
}

// At an end where other pieces begin, the closest acts, which two ranks that have the pair tell alike. Around an end
// that is the closest point of several, their distances are equal but for round-off, and the lowest id decides: to
// which part of a wall a round corner belongs must not be a matter of the last digits. Walls may part, or meet, as they
// move.
bool LineFeet::acts(const Foot &f, double along) const {
  constexpr double TOLERANCE = 1e-6; // of half the length: places are rounded
  constexpr double SAME = 1e-10;     // share of the squares of two distances
  if (!is_end(along, f.line))
    return true;
  const cdem::Disc<double> &disc = rows[f.disc];
  const double here = cdem::square_distance(disc, rows[f.piece], f.line);
  const GrainRows::Vector end = point_of(f.piece, f.line, std::copysign(f.line.half, along));
  return std::none_of(f.beside->begin(), f.beside->end(), [&](int other) {
    if (!ends_at(other, end, TOLERANCE * f.line.half))
      return false;
    const cdem::WallLine line = rows.line(other);
    if (!is_end(cdem::along_line(disc, rows[other], line), line))
      return true;
    const double there = cdem::square_distance(disc, rows[other], line);
    if (std::fabs(here - there) > SAME * (here + there))
      return there < here;
    return atom->tag[rows.grain(other)] < atom->tag[rows.grain(f.piece)];
  });
}
