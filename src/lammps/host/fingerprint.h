// SPDX-License-Identifier: GPL-2.0-or-later
// A number that tells whether anything of a set of values has changed: FNV-1a in 64 bits (Fowler, Noll and Vo,
// draft-eastlake-fnv). Two sets that differ have the same number by chance only, once in 2^64.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace Shearbox {

class Fingerprint {
public:
  template <class Value> Fingerprint &add(Value value) {
    static_assert(std::is_arithmetic_v<Value>);
    if constexpr (std::is_floating_point_v<Value>)
      value += Value(0); // -0 and 0 are the same
    unsigned char bytes[sizeof(Value)];
    memcpy(bytes, &value, sizeof(Value));
    for (const unsigned char byte : bytes)
      add_byte(byte);
    return *this;
  }
  Fingerprint &add(const std::string &text) {
    for (const char c : text)
      add_byte(static_cast<unsigned char>(c));
    return *this;
  }

  std::uint64_t value() const { return state; }

private:
  void add_byte(unsigned char byte) { state = (state ^ byte) * 0x100000001b3; }

  std::uint64_t state = 0xcbf29ce484222325;
};

} // namespace Shearbox
