// SPDX-License-Identifier: GPL-2.0-or-later
// A contact that sticks without a tangential spring remembers the smallest denormal number, a marked 0 (lanes.h). The
// processor may be told to take such numbers for 0, as any library does as it is loaded that was linked with
// -ffast-math: then the contact would be a new one in every step, and its dashpots too strong by half.
#pragma once

#include <cfenv>
#include <limits>

namespace cdem {

// Has denormal numbers counted as what they are, and says whether they were not.
inline bool keep_denormals() {
  volatile double least = std::numeric_limits<double>::denorm_min(), normal = std::numeric_limits<double>::min();
  const volatile double half = 0.5 * normal;
  if (least != 0 && half != 0)
    return false;
  std::fesetenv(FE_DFL_ENV);
  return true;
}

} // namespace cdem
